// PID, with gains from parameters that can be changed while it runs.
#pragma once

#include <memory>
#include <string>

#include <boost/shared_ptr.hpp>
#include <boost/thread/recursive_mutex.hpp>
#include <control_msgs/PidState.h>
#include <control_toolbox/ParametersConfig.h>
#include <control_toolbox/pid_law.h>
#include <dynamic_reconfigure/server.h>
#include <realtime_tools/realtime_buffer.h>
#include <realtime_tools/realtime_publisher.h>
#include <ros/ros.h>

class TiXmlElement;

namespace control_toolbox
{

/// command = p * error + i * integral(error) + d * d(error)/dt with error = target - measured; pid_law.h has the law.
///
/// Without antiwindup only the integral term is clamped, while the integral itself goes on growing; with it the integral stops where
/// its term meets the clamp. i_max and i_min bound the integral *term*; both 0 switch the integral part off.
///
/// computeCommand() is for the control loop: gains come through a buffer that it does not wait for, and the state is published where
/// no other thread holds the message. Everything else belongs outside of it.
class Pid
{
public:
  struct Gains
  {
    Gains() = default;
    Gains(double p, double i, double d, double i_max, double i_min, bool antiwindup = false)
      : p_gain_(p)
      , i_gain_(i)
      , d_gain_(d)
      , i_max_(i_max)
      , i_min_(i_min)
      , antiwindup_(antiwindup)
    {
    }

    double p_gain_ = 0.0;
    double i_gain_ = 0.0;
    double d_gain_ = 0.0;
    double i_max_ = 0.0;
    double i_min_ = 0.0;
    bool antiwindup_ = false;
  };

  Pid(double p = 0.0, double i = 0.0, double d = 0.0, double i_max = 0.0, double i_min = -0.0, bool antiwindup = false);
  /// A copy has the gains; its past is empty and it has no dynamic_reconfigure server.
  Pid(const Pid& source);
  ~Pid();
  Pid& operator=(const Pid& source);

  void initPid(double p, double i, double d, double i_max, double i_min, bool antiwindup = false);
  /// With a dynamic_reconfigure server in the namespace "pid".
  void initPid(double p, double i, double d, double i_max, double i_min, const ros::NodeHandle& node);
  void initPid(double p, double i, double d, double i_max, double i_min, bool antiwindup, const ros::NodeHandle& node);

  /// Read p (required), i, d, i_clamp, i_clamp_min, i_clamp_max, antiwindup and publish_state in a namespace, and offer the gains
  /// there by dynamic_reconfigure. \param quiet say nothing if there is no p \return false without p
  bool initParam(const std::string& prefix, const bool quiet = false);
  bool init(const ros::NodeHandle& n, const bool quiet = false);
  /// Attributes p, i, d, iClamp, antiwindup.
  bool initXml(TiXmlElement* config);
  void initDynamicReconfig(ros::NodeHandle& node);

  /// Forget the past: the last error counts as 0.
  void reset();
  /// Forget the past; the first step uses the derivative \p d_error.
  void reset(double d_error, double i_error);

  void getGains(double& p, double& i, double& d, double& i_max, double& i_min);
  void getGains(double& p, double& i, double& d, double& i_max, double& i_min, bool& antiwindup);
  Gains getGains();
  void setGains(double p, double i, double d, double i_max, double i_min, bool antiwindup = false);
  void setGains(const Gains& gains);

  /// Tell clients of dynamic_reconfigure what the gains are.
  void updateDynamicReconfig();
  void updateDynamicReconfig(Gains gains_config);
  void updateDynamicReconfig(control_toolbox::ParametersConfig config);
  void dynamicReconfigCallback(control_toolbox::ParametersConfig& config, uint32_t level);

  /// One step. \param error target - measured \param dt since the last step
  /// \return the command; 0, with nothing integrated, for dt 0 or an error that is not finite
  double computeCommand(double error, ros::Duration dt);
  double computeCommand(double error, double error_dot, ros::Duration dt);

  /// As computeCommand, with error = measured - target.
  ROS_DEPRECATED double updatePid(double p_error, ros::Duration dt);
  ROS_DEPRECATED double updatePid(double error, double error_dot, ros::Duration dt);

  void setCurrentCmd(double cmd);
  double getCurrentCmd();
  void getCurrentPIDErrors(double* pe, double* ie, double* de);
  /// To the log.
  void printValues();

private:
  typedef dynamic_reconfigure::Server<control_toolbox::ParametersConfig> Server;

  double finish(const Gains& gains, ros::Duration dt, bool counted);
  void publish(const Gains& gains, ros::Duration dt);

  realtime_tools::RealtimeBuffer<Gains> gains_;
  boost::shared_ptr<realtime_tools::RealtimePublisher<control_msgs::PidState>> publisher_;
  PidLaw law_;
  boost::recursive_mutex server_mutex_;  // before the server, which uses it to its end
  boost::shared_ptr<Server> server_;
};

}  // namespace control_toolbox
