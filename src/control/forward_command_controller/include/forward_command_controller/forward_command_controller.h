// Commands passed on to one joint: a base for controllers in C++.
#pragma once

#include <string>

#include <controller_interface/controller.h>
#include <hardware_interface/joint_command_interface.h>
#include <realtime_tools/realtime_buffer.h>
#include <ros/node_handle.h>
#include <std_msgs/Float64.h>

namespace forward_command_controller
{

/// Parameter joint; topic command (std_msgs/Float64). What starting() commands is for the deriving class to say.
template <class T>
class ForwardCommandController : public controller_interface::Controller<T>
{
public:
  ~ForwardCommandController() override { sub_command_.shutdown(); }

  bool init(T* hw, ros::NodeHandle& n) override
  {
    std::string name;
    if (!n.getParam("joint", name))
    {
      ROS_ERROR("No joint given (namespace: %s)", n.getNamespace().c_str());
      return false;
    }
    joint_ = hw->getHandle(name);
    sub_command_ = n.subscribe<std_msgs::Float64>("command", 1, &ForwardCommandController::commandCB, this);
    return true;
  }

  void starting(const ros::Time& time) override;
  void update(const ros::Time& /*time*/, const ros::Duration& /*period*/) override
  {
    joint_.setCommand(*command_buffer_.readFromRT());
  }

  hardware_interface::JointHandle joint_;
  realtime_tools::RealtimeBuffer<double> command_buffer_;

private:
  void commandCB(const std_msgs::Float64ConstPtr& msg) { command_buffer_.writeFromNonRT(msg->data); }

  ros::Subscriber sub_command_;
};

}  // namespace forward_command_controller
