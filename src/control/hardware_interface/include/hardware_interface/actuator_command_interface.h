// One command for each actuator.
#pragma once

#include <string>

#include <hardware_interface/actuator_state_interface.h>
#include <hardware_interface/internal/hardware_resource_manager.h>

namespace hardware_interface
{

/// State of a actuator and a pointer to its command, which the robot owns and reads.
class ActuatorHandle : public ActuatorStateHandle
{
public:
  ActuatorHandle() = default;

  /// \throws HardwareInterfaceException the pointer is null.
  ActuatorHandle(const ActuatorStateHandle& state, double* cmd)
    : ActuatorStateHandle(state)
    , cmd_(internal::required(cmd, state.getName(), "Command"))
  {
  }

  void setCommand(double command) { *internal::filled(cmd_, getName()) = command; }
  double getCommand() const { return *internal::filled(cmd_, getName()); }
  const double* getCommandPtr() const { return cmd_; }

private:
  double* cmd_ = nullptr;
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
