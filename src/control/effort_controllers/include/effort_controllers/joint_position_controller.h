// A joint's position controlled by its effort, for use inside of controllers in C++.
#pragma once

#include <effort_controllers/pid_of_a_joint.h>
#include <realtime_tools/realtime_buffer.h>
#include <urdf/model.h>

namespace effort_controllers
{

/// Parameters joint and pid, and robot_description; topics command (std_msgs/Float64) and state (control_msgs/JointControllerState).
class JointPositionController : public PidOfAJoint
{
public:
  struct Commands
  {
    double position_ = 0.0;  // rad or m
    double velocity_ = 0.0;  // rad/s or m/s
    bool has_velocity_ = false;
  };

  ~JointPositionController() override;

  bool init(hardware_interface::EffortJointInterface* robot, ros::NodeHandle& n) override;
  void starting(const ros::Time& time) override;
  void update(const ros::Time& time, const ros::Duration& period) override;

  void setCommand(double pos_target);
  void setCommand(double pos_target, double vel_target);
  double getPosition();

  urdf::JointConstSharedPtr joint_urdf_;
  realtime_tools::RealtimeBuffer<Commands> command_;
  Commands command_struct_;

private:
  void setCommandCB(const std_msgs::Float64ConstPtr& msg);
  double limited(double position) const;
};

}  // namespace effort_controllers
