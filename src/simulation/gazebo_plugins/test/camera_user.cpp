// A camera plugin as others write them: derived from Gazebo's own and from what gazebo_plugins has for it.
#include <gazebo/plugins/CameraPlugin.hh>
#include <gazebo_plugins/GazeboRosOpenniKinectConfig.h>
#include <gazebo_plugins/gazebo_ros_camera_utils.h>

namespace gazebo
{

class CameraUser : public CameraPlugin, GazeboRosCameraUtils
{
public:
  void Load(sensors::SensorPtr parent, sdf::ElementPtr sdf) override
  {
    CameraPlugin::Load(parent, sdf);
    parentSensor_ = parentSensor, camera_ = camera;
    width_ = width, height_ = height, depth_ = depth, format_ = format;
    loaded_ = OnLoad([this] { ROS_INFO("camera user: %s has a node", rosnode_->getNamespace().c_str()); });
    GazeboRosCameraUtils::Load(parent, sdf);
  }

  void OnNewFrame(const unsigned char* image, unsigned int, unsigned int, unsigned int, const std::string&) override
  {
    common::Time time = parentSensor->LastMeasurementTime();
    if (!parentSensor->IsActive() || *image_connect_count_ <= 0)
      return;
    PutCameraData(image, time);
    PublishCameraInfo(time);
  }

private:
  event::ConnectionPtr loaded_;
};

GZ_REGISTER_SENSOR_PLUGIN(CameraUser)

}  // namespace gazebo
