// Efforts passed on to a joint, for use inside of controllers in C++.
#pragma once

#include <forward_command_controller/forward_command_controller.h>

namespace effort_controllers
{

typedef forward_command_controller::ForwardCommandController<hardware_interface::EffortJointInterface> JointEffortController;

}  // namespace effort_controllers

template <>
inline void effort_controllers::JointEffortController::starting(const ros::Time& /*time*/)
{
  command_buffer_.initRT(0.0);
}
