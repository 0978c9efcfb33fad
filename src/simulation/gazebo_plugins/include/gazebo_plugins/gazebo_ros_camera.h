// Gazebo's camera plugin with ROS topics as a class to be derived from. What a description calls libgazebo_ros_camera.so is not made of
// it: that is gazebo_plugins.sensors.camera.
#pragma once
#include <string>

#include <gazebo/plugins/CameraPlugin.hh>
#include <gazebo_plugins/gazebo_ros_camera_utils.h>
#include <ros/ros.h>

namespace gazebo
{

class GazeboRosCamera : public CameraPlugin, GazeboRosCameraUtils
{
public:
  void Load(sensors::SensorPtr parent, sdf::ElementPtr sdf) override
  {
    if (!ros::isInitialized())
    {
      ROS_FATAL_NAMED("camera",
                      "there is no ROS node in this simulator: start it with roslaunch, or rosrun gazebo_ros gzserver");
      return;
    }
    CameraPlugin::Load(parent, sdf);
    parentSensor_ = parentSensor, camera_ = camera;
    width_ = width, height_ = height, depth_ = depth, format_ = format;
    GazeboRosCameraUtils::Load(parent, sdf);
  }

protected:
  /// Publishes the picture, not more often than <updateRate>, while somebody listens.
  void OnNewFrame(const unsigned char* image, unsigned int, unsigned int, unsigned int, const std::string&) override
  {
    if (*image_connect_count_ <= 0)
      return;
    if (!parentSensor->IsActive())
    {
      parentSensor->SetActive(true);
      return;
    }
    common::Time time = parentSensor->LastMeasurementTime();
    if (time < last_update_time_)  // the simulation was reset
      last_update_time_ = time;
    if (time - last_update_time_ < update_period_)
      return;
    PutCameraData(image, time);
    PublishCameraInfo(time);
    last_update_time_ = time;
  }
};

}  // namespace gazebo
