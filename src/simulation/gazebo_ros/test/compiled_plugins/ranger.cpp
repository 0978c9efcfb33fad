// A plugin of a depth camera, derived from Gazebo's own: publishes some of the distances, or of the points, and of the picture's colours.
#include <gazebo/gazebo.hh>
#include <gazebo/plugins/DepthCameraPlugin.hh>
#include <ros/ros.h>
#include <std_msgs/Float64MultiArray.h>

namespace gazebo
{

class Ranger : public DepthCameraPlugin
{
public:
  void Load(sensors::SensorPtr sensor, sdf::ElementPtr sdf) override
  {
    DepthCameraPlugin::Load(sensor, sdf);
    frames_ = nh_.advertise<std_msgs::Float64MultiArray>("range/" + sensor->Name(), 1000, true);
  }

  void OnNewDepthFrame(const float* depths, unsigned int w, unsigned int h, unsigned int, const std::string&) override
  {
    told_ = { 1, depths[h / 2 * w + w / 2], depths[h / 2 * w], depths[0], depths == depthCamera->DepthData() ? 1.0 : 0.0 };
  }

  void OnNewRGBPointCloud(const float* points, unsigned int w, unsigned int h, unsigned int, const std::string&) override
  {
    const float* const middle = points + 4 * (h / 2 * w + w / 2);
    const auto* const colour = reinterpret_cast<const unsigned char*>(middle + 3);
    told_ = { 4, middle[0], middle[1], middle[2], 1.0 * colour[0], 1.0 * colour[1], 1.0 * colour[2] };
  }

  void OnNewImageFrame(const unsigned char* image, unsigned int w, unsigned int h, unsigned int d, const std::string&) override
  {
    std_msgs::Float64MultiArray message;
    message.data.push_back(parentSensor->LastUpdateTime().Double());
    message.data.insert(message.data.end(), told_.begin(), told_.end());
    for (unsigned int k = 0; k < d; ++k)
      message.data.push_back(image[(h / 2 * w + w / 2) * d + k]);
    frames_.publish(message);
  }

private:
  ros::NodeHandle nh_;
  ros::Publisher frames_;
  std::vector<double> told_;
};

GZ_REGISTER_SENSOR_PLUGIN(Ranger)

}  // namespace gazebo
