// Velocities passed on to a joint, for use inside of controllers in C++.
#pragma once

#include <forward_command_controller/forward_command_controller.h>

namespace velocity_controllers
{

typedef forward_command_controller::ForwardCommandController<hardware_interface::VelocityJointInterface>
    JointVelocityController;

}  // namespace velocity_controllers

template <>
inline void velocity_controllers::JointVelocityController::starting(const ros::Time& /*time*/)
{
  command_buffer_.initRT(0.0);
}
