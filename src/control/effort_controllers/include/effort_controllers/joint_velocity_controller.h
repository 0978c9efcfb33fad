// A joint's velocity controlled by its effort, for use inside of controllers in C++.
#pragma once

#include <string>

#include <effort_controllers/pid_of_a_joint.h>

namespace effort_controllers
{

/// Parameters joint and pid; topics command (std_msgs/Float64) and state (control_msgs/JointControllerState).
class JointVelocityController : public PidOfAJoint
{
public:
  ~JointVelocityController() override;

  bool init(hardware_interface::EffortJointInterface* robot, ros::NodeHandle& n) override;
  bool init(hardware_interface::EffortJointInterface* robot, const std::string& joint_name, const control_toolbox::Pid& pid);
  void starting(const ros::Time& time) override;
  void update(const ros::Time& time, const ros::Duration& period) override;

  void setCommand(double cmd);
  void getCommand(double& cmd);

  double command_ = 0.0;  ///< rad/s or m/s

private:
  void setCommandCB(const std_msgs::Float64ConstPtr& msg);
};

}  // namespace effort_controllers
