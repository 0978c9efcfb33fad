// Measured state of joints.
#pragma once

#include <hardware_interface/internal/hardware_resource_manager.h>
#include <hardware_interface/internal/state_handle.h>

namespace hardware_interface
{

/// Points to the state of one joint.
class JointStateHandle : public internal::StateHandle
{
public:
  using internal::StateHandle::StateHandle;
};

/// States of all joints of a robot; taking a handle claims nothing.
class JointStateInterface : public HardwareResourceManager<JointStateHandle>
{
};

}  // namespace hardware_interface
