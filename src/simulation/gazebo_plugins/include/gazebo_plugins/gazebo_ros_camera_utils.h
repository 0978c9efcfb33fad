// What camera plugins of others are derived from, beside CameraPlugin or DepthCameraPlugin: image and camera_info on ROS topics while
// somebody listens. Its members are upstream's, as derived classes use them.
#pragma once
#include <string>

#include <boost/bind/bind.hpp>
#include <boost/function.hpp>
#include <boost/shared_ptr.hpp>
#include <boost/thread.hpp>
#include <boost/thread/mutex.hpp>
#include <camera_info_manager/camera_info_manager.h>
#include <dynamic_reconfigure/server.h>
#include <gazebo/common/Time.hh>
#include <gazebo/msgs/MessageTypes.hh>
#include <gazebo/physics/physics.hh>
#include <gazebo/plugins/CameraPlugin.hh>
#include <gazebo/sensors/SensorTypes.hh>
#include <gazebo/transport/TransportTypes.hh>
#include <gazebo_plugins/GazeboRosCameraConfig.h>
#include <gazebo_plugins/gazebo_ros_utils.h>
#include <image_transport/image_transport.h>
#include <ros/advertise_options.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud.h>
#include <sensor_msgs/fill_image.h>
#include <std_msgs/Float64.h>

namespace gazebo
{

class GazeboRosMultiCamera;
class GazeboRosTriggeredMultiCamera;

/// parentSensor_, camera_, width_, height_, depth_ and format_ are set by the derived class before Load().
class GAZEBO_VISIBLE GazeboRosCameraUtils
{
public:
  GazeboRosCameraUtils();
  ~GazeboRosCameraUtils();
  void Load(sensors::SensorPtr parent, sdf::ElementPtr sdf, const std::string& camera_name_suffix = "");
  void Load(sensors::SensorPtr parent, sdf::ElementPtr sdf, const std::string& camera_name_suffix, double hack_baseline);
  event::ConnectionPtr OnLoad(const boost::function<void()>& f);  // called within Load(), when there is a node

protected:
  void PutCameraData(const unsigned char* image);
  void PutCameraData(const unsigned char* image, common::Time& time);
  void PublishCameraInfo();
  void PublishCameraInfo(common::Time& time);
  void PublishCameraInfo(ros::Publisher publisher);
  void ImageConnect();
  void ImageDisconnect();
  void CameraQueueThread();
  void configCallback(gazebo_plugins::GazeboRosCameraConfig& config, uint32_t level);

  boost::shared_ptr<int> image_connect_count_;  // of image and camera_info; shared by the cameras of one sensor
  boost::shared_ptr<boost::mutex> image_connect_count_lock_;
  boost::shared_ptr<bool> was_active_;  // the sensor, before somebody listened

  ros::NodeHandle* rosnode_ = nullptr;
  image_transport::Publisher image_pub_;
  sensor_msgs::Image image_msg_;
  std::string image_topic_name_, camera_info_topic_name_, frame_name_;
  ros::Publisher camera_info_pub_;
  boost::shared_ptr<camera_info_manager::CameraInfoManager> camera_info_manager_;
  double update_rate_ = 0, update_period_ = 0;  // of <updateRate>
  common::Time last_update_time_, last_info_update_time_, sensor_update_time_;

  double cx_prime_ = 0, cx_ = 0, cy_ = 0, focal_length_ = 0, hack_baseline_ = 0;
  double distortion_k1_ = 0, distortion_k2_ = 0, distortion_k3_ = 0, distortion_t1_ = 0, distortion_t2_ = 0;
  bool auto_distortion_ = false, border_crop_ = true;

  boost::mutex lock_;  // of what callbacks of ROS change
  std::string type_;   // encoding
  int skip_ = 0;       // bytes of a pixel
  dynamic_reconfigure::Server<gazebo_plugins::GazeboRosCameraConfig>* dyn_srv_ = nullptr;
  ros::CallbackQueue camera_queue_;
  boost::thread callback_queue_thread_;

  unsigned int width_ = 0, height_ = 0, depth_ = 0;
  std::string format_;
  sensors::SensorPtr parentSensor_;
  rendering::CameraPtr camera_;
  physics::WorldPtr world_, world;
  bool initialized_ = false;

private:
  void readTags(const std::string& camera_name_suffix);
  void advertise();
  void encoding();
  sensor_msgs::CameraInfo info();

  image_transport::ImageTransport* itnode_ = nullptr;
  std::string robot_namespace_, camera_name_, tf_prefix_;
  sdf::ElementPtr sdf;
  event::EventT<void()> load_event_;
  boost::shared_ptr<double> given_baseline_;
  boost::shared_ptr<int> alive_;  // callbacks of ROS hold it
  friend class GazeboRosMultiCamera;
  friend class GazeboRosTriggeredMultiCamera;
};

}  // namespace gazebo
