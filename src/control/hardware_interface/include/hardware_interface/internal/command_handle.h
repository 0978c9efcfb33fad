// What the command handles of joints and of actuators have in common.
#pragma once

#include <hardware_interface/internal/hardware_resource_manager.h>

namespace hardware_interface
{
namespace internal
{

/// A state and a pointer to a command, which the robot owns and reads.
template <class State>
class CommandHandle : public State
{
public:
  CommandHandle() = default;

  /// \throws HardwareInterfaceException the pointer is null.
  CommandHandle(const State& state, double* cmd) : State(state), cmd_(required(cmd, state.getName(), "Command")) {}

  void setCommand(double command) { *filled(cmd_, this->getName()) = command; }
  double getCommand() const { return *filled(cmd_, this->getName()); }
  const double* getCommandPtr() const { return cmd_; }

private:
  double* cmd_ = nullptr;
};

}  // namespace internal
}  // namespace hardware_interface
