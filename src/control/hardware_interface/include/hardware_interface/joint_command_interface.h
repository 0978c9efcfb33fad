// One command for each joint.
#pragma once

#include <string>

#include <hardware_interface/joint_state_interface.h>
#include <hardware_interface/internal/hardware_resource_manager.h>

namespace hardware_interface
{

/// State of a joint and a pointer to its command, which the robot owns and reads.
class JointHandle : public JointStateHandle
{
public:
  JointHandle() = default;

  /// \throws HardwareInterfaceException the pointer is null.
  JointHandle(const JointStateHandle& state, double* cmd)
    : JointStateHandle(state)
    , cmd_(internal::required(cmd, state.getName(), "Command"))
  {
  }

  void setCommand(double command) { *internal::filled(cmd_, getName()) = command; }
  double getCommand() const { return *internal::filled(cmd_, getName()); }
  const double* getCommandPtr() const { return cmd_; }

private:
  double* cmd_ = nullptr;
};

/// Base of the interfaces with one command for each joint: taking a handle claims it.
class JointCommandInterface : public HardwareResourceManager<JointHandle, ClaimResources>
{
};

/// Commands are efforts, Nm or N.
class EffortJointInterface : public JointCommandInterface
{
};

/// Commands are velocities, rad/s or m/s.
class VelocityJointInterface : public JointCommandInterface
{
};

/// Commands are positions, rad or m.
class PositionJointInterface : public JointCommandInterface
{
};

}  // namespace hardware_interface
