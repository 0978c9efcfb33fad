#include <effort_controllers/pid_of_a_joint.h>

namespace effort_controllers
{

void PidOfAJoint::getGains(double& p, double& i, double& d, double& i_max, double& i_min)
{
  pid_controller_.getGains(p, i, d, i_max, i_min);
}

void PidOfAJoint::getGains(double& p, double& i, double& d, double& i_max, double& i_min, bool& antiwindup)
{
  pid_controller_.getGains(p, i, d, i_max, i_min, antiwindup);
}

void PidOfAJoint::setGains(const double& p, const double& i, const double& d, const double& i_max, const double& i_min,
                           const bool& antiwindup)
{
  pid_controller_.setGains(p, i, d, i_max, i_min, antiwindup);
}

void PidOfAJoint::printDebug() { pid_controller_.printValues(); }

std::string PidOfAJoint::getJointName() { return joint_.getName(); }

bool PidOfAJoint::initJoint(hardware_interface::EffortJointInterface* robot, ros::NodeHandle& n)
{
  std::string name;
  if (!n.getParam("joint", name))
  {
    ROS_ERROR("No joint given (namespace: %s)", n.getNamespace().c_str());
    return false;
  }
  joint_ = robot->getHandle(name);
  if (!pid_controller_.init(ros::NodeHandle(n, "pid")))
    return false;
  controller_state_publisher_.reset(new realtime_tools::RealtimePublisher<control_msgs::JointControllerState>(n, "state", 1));
  return true;
}

void PidOfAJoint::publishState(const ros::Time& time, const ros::Duration& period, double set_point, double value,
                               double value_dot, double error, double command)
{
  if (loop_count_++ % 10 != 0 || !controller_state_publisher_ || !controller_state_publisher_->trylock())
    return;
  control_msgs::JointControllerState& state = controller_state_publisher_->msg_;
  state.header.stamp = time;
  state.set_point = set_point;
  state.process_value = value;
  state.process_value_dot = value_dot;
  state.error = error;
  state.time_step = period.toSec();
  state.command = command;
  double i_min;
  bool antiwindup;
  pid_controller_.getGains(state.p, state.i, state.d, state.i_clamp, i_min, antiwindup);
  state.antiwindup = antiwindup;
  controller_state_publisher_->unlockAndPublish();
}

}  // namespace effort_controllers
