// Velocities passed on to several joints, for use inside of controllers in C++.
#pragma once

#include <vector>

#include <forward_command_controller/forward_joint_group_command_controller.h>

namespace velocity_controllers
{

typedef forward_command_controller::ForwardJointGroupCommandController<hardware_interface::VelocityJointInterface>
    JointGroupVelocityController;

}  // namespace velocity_controllers

template <>
inline void velocity_controllers::JointGroupVelocityController::starting(const ros::Time& /*time*/)
{
  commands_buffer_.initRT(std::vector<double>(n_joints_, 0.0));
}
