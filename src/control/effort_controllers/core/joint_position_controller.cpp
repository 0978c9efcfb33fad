#include <effort_controllers/joint_position_controller.h>

#include <algorithm>

#include <angles/angles.h>

namespace effort_controllers
{

JointPositionController::~JointPositionController() { sub_command_.shutdown(); }

bool JointPositionController::init(hardware_interface::EffortJointInterface* robot, ros::NodeHandle& n)
{
  if (!initJoint(robot, n))
    return false;
  urdf::Model model;
  if (!model.initParamWithNodeHandle("robot_description", n))
  {
    ROS_ERROR("Failed to parse urdf file: the parameter robot_description is needed in %s or above", n.getNamespace().c_str());
    return false;
  }
  joint_urdf_ = model.getJoint(joint_.getName());
  if (!joint_urdf_)
  {
    ROS_ERROR("Could not find joint '%s' in urdf", joint_.getName().c_str());
    return false;
  }
  sub_command_ = n.subscribe<std_msgs::Float64>("command", 1, &JointPositionController::setCommandCB, this);
  return true;
}

void JointPositionController::starting(const ros::Time& /*time*/)
{
  command_struct_ = Commands();
  command_struct_.position_ = limited(joint_.getPosition());
  command_.initRT(command_struct_);
  pid_controller_.reset();
}

void JointPositionController::update(const ros::Time& time, const ros::Duration& period)
{
  command_struct_ = *command_.readFromRT();
  const double target = limited(command_struct_.position_), position = joint_.getPosition(), velocity = joint_.getVelocity();
  double error = target - position;
  if (joint_urdf_->type == urdf::Joint::REVOLUTE && joint_urdf_->limits)
    angles::shortest_angular_distance_with_large_limits(position, target, joint_urdf_->limits->lower,
                                                        joint_urdf_->limits->upper, error);
  else if (joint_urdf_->type == urdf::Joint::CONTINUOUS)
    error = angles::shortest_angular_distance(position, target);
  const double effort = command_struct_.has_velocity_
                            ? pid_controller_.computeCommand(error, command_struct_.velocity_ - velocity, period)
                            : pid_controller_.computeCommand(error, period);
  joint_.setCommand(effort);
  publishState(time, period, target, position, velocity, error, effort);
}

void JointPositionController::setCommand(double pos_target)
{
  Commands commands;
  commands.position_ = pos_target;
  command_.writeFromNonRT(commands);
}

void JointPositionController::setCommand(double pos_target, double vel_target)
{
  Commands commands;
  commands.position_ = pos_target;
  commands.velocity_ = vel_target;
  commands.has_velocity_ = true;
  command_.writeFromNonRT(commands);
}

double JointPositionController::getPosition() { return joint_.getPosition(); }

void JointPositionController::setCommandCB(const std_msgs::Float64ConstPtr& msg) { setCommand(msg->data); }

double JointPositionController::limited(double position) const
{
  const bool bounded = joint_urdf_->type == urdf::Joint::REVOLUTE || joint_urdf_->type == urdf::Joint::PRISMATIC;
  if (!bounded || !joint_urdf_->limits)
    return position;
  return std::min(std::max(position, joint_urdf_->limits->lower), joint_urdf_->limits->upper);
}

}  // namespace effort_controllers
