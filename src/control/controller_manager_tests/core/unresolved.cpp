// A library that was linked without what it calls.
#include <controller_interface/controller.h>
#include <hardware_interface/joint_state_interface.h>
#include <pluginlib/class_list_macros.hpp>

namespace controller_manager_tests
{

double not_linked(double number);

class CompiledUnresolved : public controller_interface::Controller<hardware_interface::JointStateInterface>
{
public:
  void update(const ros::Time& time, const ros::Duration&) override { not_linked(time.toSec()); }
};

}  // namespace controller_manager_tests

PLUGINLIB_EXPORT_CLASS(controller_manager_tests::CompiledUnresolved, controller_interface::ControllerBase)
