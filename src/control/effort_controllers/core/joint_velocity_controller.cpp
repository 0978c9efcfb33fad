#include <effort_controllers/joint_velocity_controller.h>

namespace effort_controllers
{

JointVelocityController::~JointVelocityController() { sub_command_.shutdown(); }

bool JointVelocityController::init(hardware_interface::EffortJointInterface* robot, ros::NodeHandle& n)
{
  if (!initJoint(robot, n))
    return false;
  sub_command_ = n.subscribe<std_msgs::Float64>("command", 1, &JointVelocityController::setCommandCB, this);
  return true;
}

bool JointVelocityController::init(hardware_interface::EffortJointInterface* robot, const std::string& joint_name,
                                   const control_toolbox::Pid& pid)
{
  pid_controller_ = pid;
  joint_ = robot->getHandle(joint_name);
  return true;
}

void JointVelocityController::starting(const ros::Time& /*time*/)
{
  command_ = 0.0;
  pid_controller_.reset();
}

void JointVelocityController::update(const ros::Time& time, const ros::Duration& period)
{
  const double velocity = joint_.getVelocity(), target = command_, error = target - velocity;
  const double effort = pid_controller_.computeCommand(error, period);
  joint_.setCommand(effort);
  publishState(time, period, target, velocity, 0.0, error, effort);
}

void JointVelocityController::setCommand(double cmd) { command_ = cmd; }

void JointVelocityController::getCommand(double& cmd) { cmd = command_; }

void JointVelocityController::setCommandCB(const std_msgs::Float64ConstPtr& msg) { command_ = msg->data; }

}  // namespace effort_controllers
