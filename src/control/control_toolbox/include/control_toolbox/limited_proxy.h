// Position control that comes back gently after a large error.
#pragma once

namespace control_toolbox
{

/// A virtual mass, the proxy, is coupled to the joint by a PID spring and goes to the target within its limits. The effort limit bounds
/// the coupling, so that a blocked joint is left by a proxy that waits nearby instead of winding up.
class LimitedProxy
{
public:
  double mass_ = 0.0;  // of the joint, kg or kg m^2
  double Kd_ = 0.0;    // coupling
  double Kp_ = 0.0;
  double Ki_ = 0.0;
  double Ficl_ = 0.0;             // bound of its integral effort
  double effort_limit_ = 0.0;     // N or Nm; 0: none
  double vel_limit_ = 0.0;        // 0: none
  double pos_upper_limit_ = 0.0;  // upstream does not use them either
  double pos_lower_limit_ = 0.0;
  double lambda_proxy_ =
      0.0;  // bandwidth of the approach near the target, 1/s, 2 / dt at most; 0: the proxy is where the target is
  double acc_converge_ = 0.0;  // deceleration that the approach plans with

  /// Put the proxy on the joint.
  void reset(double pos_act, double vel_act);

  /// One step. \param dt s; one that is negative or no number counts as 0 \return effort on the joint
  double update(double pos_des, double vel_des, double acc_des, double pos_act, double vel_act, double dt);

private:
  void follow(double pos_des, double vel_des, double acc_des, double dt);
  double position_ = 0.0, velocity_ = 0.0, acceleration_ = 0.0, position_error_ = 0.0, integral_ = 0.0;
};

}  // namespace control_toolbox
