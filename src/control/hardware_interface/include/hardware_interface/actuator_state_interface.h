// Measured state of actuators.
#pragma once

#include <hardware_interface/internal/hardware_resource_manager.h>
#include <hardware_interface/internal/state_handle.h>

namespace hardware_interface
{

/// Points to the state of one actuator.
class ActuatorStateHandle : public internal::StateHandle
{
public:
  using internal::StateHandle::StateHandle;
};

/// States of all actuators of a robot; taking a handle claims nothing.
class ActuatorStateInterface : public HardwareResourceManager<ActuatorStateHandle>
{
};

}  // namespace hardware_interface
