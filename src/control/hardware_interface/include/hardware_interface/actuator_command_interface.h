// One command for each actuator.
#pragma once

#include <hardware_interface/internal/command_handle.h>
#include <hardware_interface/internal/hardware_resource_manager.h>
#include <hardware_interface/actuator_state_interface.h>

namespace hardware_interface
{

/// State of an actuator and a pointer to its command, which the robot owns and reads.
class ActuatorHandle : public internal::CommandHandle<ActuatorStateHandle>
{
public:
  using internal::CommandHandle<ActuatorStateHandle>::CommandHandle;
};

/// Base of the interfaces with one command for each actuator; taking a handle claims nothing.
class ActuatorCommandInterface : public HardwareResourceManager<ActuatorHandle>
{
};

/// Commands are efforts, Nm or N.
class EffortActuatorInterface : public ActuatorCommandInterface
{
};

/// Commands are velocities, rad/s or m/s.
class VelocityActuatorInterface : public ActuatorCommandInterface
{
};

/// Commands are positions, rad or m.
class PositionActuatorInterface : public ActuatorCommandInterface
{
};

}  // namespace hardware_interface
