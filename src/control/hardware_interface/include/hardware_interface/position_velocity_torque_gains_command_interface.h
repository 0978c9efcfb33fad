// Commands for joints whose drive closes the loop: set points, feed-forward effort and gains.
#pragma once

#include <hardware_interface/posvel_command_interface.h>

namespace hardware_interface
{

/// State of a joint, and pointers to position, velocity and effort commands and to the gains of the drive.
class PositionVelocityTorqueGainsJointHandle : public PosVelJointHandle
{
public:
  PositionVelocityTorqueGainsJointHandle() = default;

  /// \throws HardwareInterfaceException a pointer is null.
  PositionVelocityTorqueGainsJointHandle(const JointStateHandle& state, double* cmd_pos, double* cmd_vel, double* cmd_eff,
                                         double* cmd_kp, double* cmd_kd)
    : PosVelJointHandle(state, cmd_pos, cmd_vel)
    , cmd_eff_(internal::required(cmd_eff, state.getName(), "Command effort"))
    , cmd_kp_(internal::required(cmd_kp, state.getName(), "Command position gain"))
    , cmd_kd_(internal::required(cmd_kd, state.getName(), "Command derivative gain"))
  {
  }

  void setCommand(double position, double velocity, double effort, double kp, double kd)
  {
    PosVelJointHandle::setCommand(position, velocity);
    setCommandEffort(effort);
    setCommandKp(kp);
    setCommandKd(kd);
  }
  void setCommandEffort(double effort) { *internal::filled(cmd_eff_, getName()) = effort; }
  void setCommandKp(double kp) { *internal::filled(cmd_kp_, getName()) = kp; }
  void setCommandKd(double kd) { *internal::filled(cmd_kd_, getName()) = kd; }
  double getCommandEffort() const { return *internal::filled(cmd_eff_, getName()); }
  double getCommandKp() const { return *internal::filled(cmd_kp_, getName()); }
  double getCommandKd() const { return *internal::filled(cmd_kd_, getName()); }
  const double* getCommandEffortPtr() const { return cmd_eff_; }
  const double* getCommandKpPtr() const { return cmd_kp_; }
  const double* getCommandKdPtr() const { return cmd_kd_; }

private:
  double* cmd_eff_ = nullptr;
  double* cmd_kp_ = nullptr;
  double* cmd_kd_ = nullptr;
};

/// Taking a handle claims the joint.
class PositionVelocityTorqueGainsJointInterface
  : public HardwareResourceManager<PositionVelocityTorqueGainsJointHandle, ClaimResources>
{
};

}  // namespace hardware_interface
