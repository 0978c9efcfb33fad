// Commands passed on to several joints: a base for controllers in C++.
#pragma once

#include <string>
#include <vector>

#include <controller_interface/controller.h>
#include <hardware_interface/joint_command_interface.h>
#include <realtime_tools/realtime_buffer.h>
#include <ros/node_handle.h>
#include <std_msgs/Float64MultiArray.h>

namespace forward_command_controller
{

/// Parameter joints; topic command (std_msgs/Float64MultiArray), one number for each.
template <class T>
class ForwardJointGroupCommandController : public controller_interface::Controller<T>
{
public:
  ~ForwardJointGroupCommandController() override { sub_command_.shutdown(); }

  bool init(T* hw, ros::NodeHandle& n) override
  {
    if (!n.getParam("joints", joint_names_) || joint_names_.empty())
    {
      ROS_ERROR_STREAM("Failed to getParam 'joints' (namespace: " << n.getNamespace()
                                                                  << "): a list of names that is not empty");
      return false;
    }
    n_joints_ = joint_names_.size();
    for (const std::string& name : joint_names_)
      joints_.push_back(hw->getHandle(name));
    commands_buffer_.initRT(std::vector<double>(n_joints_, 0.0));
    sub_command_ = n.subscribe<std_msgs::Float64MultiArray>("command", 1, &ForwardJointGroupCommandController::commandCB, this);
    return true;
  }

  void starting(const ros::Time& time) override;
  void update(const ros::Time& /*time*/, const ros::Duration& /*period*/) override
  {
    const std::vector<double>& commands = *commands_buffer_.readFromRT();
    for (unsigned int i = 0; i < n_joints_; ++i)
      joints_[i].setCommand(commands[i]);
  }

  std::vector<std::string> joint_names_;
  std::vector<hardware_interface::JointHandle> joints_;
  realtime_tools::RealtimeBuffer<std::vector<double>> commands_buffer_;
  unsigned int n_joints_ = 0;

private:
  void commandCB(const std_msgs::Float64MultiArrayConstPtr& msg)
  {
    if (msg->data.size() != n_joints_)
    {
      ROS_ERROR_STREAM("Dimension of command (" << msg->data.size() << ") does not match number of joints (" << n_joints_
                                                << ")! Not executing!");
      return;
    }
    commands_buffer_.writeFromNonRT(msg->data);
  }

  ros::Subscriber sub_command_;
};

}  // namespace forward_command_controller
