// The plugin of gazebo_ros_control as others derive from it: it says when its robot is there, and under which names.
#include <gazebo_ros_control/gazebo_ros_control_plugin.h>

namespace gazebo_ros_control_test
{

class ChattyPlugin : public gazebo_ros_control::GazeboRosControlPlugin
{
public:
  void Load(gazebo::physics::ModelPtr model, sdf::ElementPtr sdf) override
  {
    GazeboRosControlPlugin::Load(model, sdf);
    if (controller_manager_)
      ROS_INFO("chatty: %s of %s has %zu transmissions, %g s", robot_hw_sim_type_str_.c_str(), model_nh_.getNamespace().c_str(),
               transmissions_.size(), control_period_.toSec());
  }
};

GZ_REGISTER_MODEL_PLUGIN(ChattyPlugin)

}  // namespace gazebo_ros_control_test
