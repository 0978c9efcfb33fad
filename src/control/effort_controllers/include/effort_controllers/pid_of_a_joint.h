// What the controllers with a PID on one joint have in common.
#pragma once

#include <memory>
#include <string>

#include <control_msgs/JointControllerState.h>
#include <control_toolbox/pid.h>
#include <controller_interface/controller.h>
#include <hardware_interface/joint_command_interface.h>
#include <realtime_tools/realtime_publisher.h>
#include <ros/node_handle.h>
#include <std_msgs/Float64.h>

namespace effort_controllers
{

class PidOfAJoint : public controller_interface::Controller<hardware_interface::EffortJointInterface>
{
public:
  void getGains(double& p, double& i, double& d, double& i_max, double& i_min);
  void getGains(double& p, double& i, double& d, double& i_max, double& i_min, bool& antiwindup);
  void setGains(const double& p, const double& i, const double& d, const double& i_max, const double& i_min,
                const bool& antiwindup = false);
  /// To the log.
  void printDebug();
  std::string getJointName();

  hardware_interface::JointHandle joint_;

protected:
  /// Read the joint and the gains, and advertise the state. \return false: the log says why
  bool initJoint(hardware_interface::EffortJointInterface* robot, ros::NodeHandle& n);
  /// On the topic state, in every tenth cycle.
  void publishState(const ros::Time& time, const ros::Duration& period, double set_point, double value, double value_dot,
                    double error, double command);

  control_toolbox::Pid pid_controller_;
  ros::Subscriber sub_command_;

private:
  int loop_count_ = 0;
  std::unique_ptr<realtime_tools::RealtimePublisher<control_msgs::JointControllerState>> controller_state_publisher_;
};

}  // namespace effort_controllers
