// Positions passed on to a joint, for use inside of controllers in C++.
#pragma once

#include <forward_command_controller/forward_command_controller.h>

namespace position_controllers
{

typedef forward_command_controller::ForwardCommandController<hardware_interface::PositionJointInterface>
    JointPositionController;

}  // namespace position_controllers

template <>
inline void position_controllers::JointPositionController::starting(const ros::Time& /*time*/)
{
  command_buffer_.initRT(joint_.getPosition());
}
