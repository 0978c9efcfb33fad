// Positions passed on to several joints, for use inside of controllers in C++.
#pragma once

#include <vector>

#include <forward_command_controller/forward_joint_group_command_controller.h>

namespace position_controllers
{

typedef forward_command_controller::ForwardJointGroupCommandController<hardware_interface::PositionJointInterface>
    JointGroupPositionController;

}  // namespace position_controllers

template <>
inline void position_controllers::JointGroupPositionController::starting(const ros::Time& /*time*/)
{
  std::vector<double> here;
  for (hardware_interface::JointHandle& joint : joints_)
    here.push_back(joint.getPosition());
  commands_buffer_.initRT(here);
}
