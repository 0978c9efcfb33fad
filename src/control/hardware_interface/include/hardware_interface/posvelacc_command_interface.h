// Position, velocity and acceleration commands for joints.
#pragma once

#include <hardware_interface/posvel_command_interface.h>

namespace hardware_interface
{

/// State of a joint, and pointers to a position, a velocity and an acceleration command.
class PosVelAccJointHandle : public PosVelJointHandle
{
public:
  PosVelAccJointHandle() = default;

  /// \throws HardwareInterfaceException a pointer is null.
  PosVelAccJointHandle(const JointStateHandle& state, double* cmd_pos, double* cmd_vel, double* cmd_acc)
    : PosVelJointHandle(state, cmd_pos, cmd_vel)
    , cmd_acc_(internal::required(cmd_acc, state.getName(), "Command acceleration"))
  {
  }

  void setCommand(double position, double velocity, double acceleration)
  {
    PosVelJointHandle::setCommand(position, velocity);
    setCommandAcceleration(acceleration);
  }
  void setCommandAcceleration(double acceleration) { *internal::filled(cmd_acc_, getName()) = acceleration; }
  double getCommandAcceleration() const { return *internal::filled(cmd_acc_, getName()); }
  const double* getCommandAccelerationPtr() const { return cmd_acc_; }

private:
  double* cmd_acc_ = nullptr;
};

/// Taking a handle claims the joint.
class PosVelAccJointInterface : public HardwareResourceManager<PosVelAccJointHandle, ClaimResources>
{
};

}  // namespace hardware_interface
