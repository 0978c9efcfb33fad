// Position and velocity commands for joints.
#pragma once

#include <string>

#include <hardware_interface/internal/hardware_resource_manager.h>
#include <hardware_interface/joint_state_interface.h>

namespace hardware_interface
{

/// State of a joint, and pointers to a position and a velocity command.
class PosVelJointHandle : public JointStateHandle
{
public:
  PosVelJointHandle() = default;

  /// \throws HardwareInterfaceException a pointer is null.
  PosVelJointHandle(const JointStateHandle& state, double* cmd_pos, double* cmd_vel)
    : JointStateHandle(state)
    , cmd_pos_(internal::required(cmd_pos, state.getName(), "Command position"))
    , cmd_vel_(internal::required(cmd_vel, state.getName(), "Command velocity"))
  {
  }

  void setCommand(double position, double velocity)
  {
    setCommandPosition(position);
    setCommandVelocity(velocity);
  }
  void setCommandPosition(double position) { *internal::filled(cmd_pos_, getName()) = position; }
  void setCommandVelocity(double velocity) { *internal::filled(cmd_vel_, getName()) = velocity; }
  double getCommandPosition() const { return *internal::filled(cmd_pos_, getName()); }
  double getCommandVelocity() const { return *internal::filled(cmd_vel_, getName()); }
  const double* getCommandPositionPtr() const { return cmd_pos_; }
  const double* getCommandVelocityPtr() const { return cmd_vel_; }

private:
  double* cmd_pos_ = nullptr;
  double* cmd_vel_ = nullptr;
};

/// Taking a handle claims the joint.
class PosVelJointInterface : public HardwareResourceManager<PosVelJointHandle, ClaimResources>
{
};

}  // namespace hardware_interface
