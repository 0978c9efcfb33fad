// A camera plugin as others write them: derived from the whole camera plugin of gazebo_plugins.
#include <gazebo_plugins/gazebo_ros_camera.h>

namespace gazebo
{

class RosCameraUser : public GazeboRosCamera
{
public:
  void Load(sensors::SensorPtr parent, sdf::ElementPtr sdf) override
  {
    GazeboRosCamera::Load(parent, sdf);
    ROS_INFO("camera user: /fleet/front has a node");
  }
};

GZ_REGISTER_SENSOR_PLUGIN(RosCameraUser)

}  // namespace gazebo
