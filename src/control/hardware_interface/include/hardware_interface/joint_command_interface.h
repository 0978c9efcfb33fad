// One command for each joint.
#pragma once

#include <hardware_interface/internal/command_handle.h>
#include <hardware_interface/internal/hardware_resource_manager.h>
#include <hardware_interface/joint_state_interface.h>

namespace hardware_interface
{

/// State of a joint and a pointer to its command, which the robot owns and reads.
class JointHandle : public internal::CommandHandle<JointStateHandle>
{
public:
  using internal::CommandHandle<JointStateHandle>::CommandHandle;
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
