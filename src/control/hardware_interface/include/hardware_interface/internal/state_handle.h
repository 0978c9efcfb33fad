// What the state handles of joints and of actuators have in common.
#pragma once

#include <stdexcept>
#include <string>

#include <hardware_interface/internal/hardware_resource_manager.h>

namespace hardware_interface
{
namespace internal
{

/// Points to the state of one joint or actuator, which its robot owns and writes. Units: rad or m, rad/s or m/s, Nm or N.
class StateHandle
{
public:
  StateHandle() = default;

  /// \throws HardwareInterfaceException a pointer is null.
  StateHandle(const std::string& name, const double* pos, const double* vel, const double* eff)
    : name_(name)
    , pos_(required(pos, name, "Position"))
    , vel_(required(vel, name, "Velocity"))
    , eff_(required(eff, name, "Effort"))
  {
  }

  /// With the position of an absolute encoder, and a torque sensor's reading.
  StateHandle(const std::string& name, const double* pos, const double* vel, const double* eff, const double* absolute_pos,
              const double* torque_sensor)
    : StateHandle(name, pos, vel, eff)
  {
    absolute_pos_ = required(absolute_pos, name, "Absolute data position");
    torque_sensor_ = required(torque_sensor, name, "Torque sensor");
  }

  StateHandle(const std::string& name, const double* pos, const double* vel, const double* eff, const double* absolute_pos)
    : StateHandle(name, pos, vel, eff)
  {
    absolute_pos_ = required(absolute_pos, name, "Absolute data position");
  }

  /// The last argument only tells this constructor from the one before.
  StateHandle(const std::string& name, const double* pos, const double* vel, const double* eff, const double* torque_sensor,
              bool /*torque sensor*/)
    : StateHandle(name, pos, vel, eff)
  {
    torque_sensor_ = required(torque_sensor, name, "Torque sensor");
  }

  std::string getName() const { return name_; }
  double getPosition() const { return *filled(pos_, name_); }
  double getVelocity() const { return *filled(vel_, name_); }
  double getEffort() const { return *filled(eff_, name_); }

  /// \throws std::runtime_error there is no absolute encoder, see hasAbsolutePosition().
  double getAbsolutePosition() const { return *sensor(absolute_pos_, "absolute position"); }
  /// \throws std::runtime_error there is no torque sensor, see hasTorqueSensor().
  double getTorqueSensor() const { return *sensor(torque_sensor_, "torque"); }

  const double* getPositionPtr() const { return pos_; }
  const double* getVelocityPtr() const { return vel_; }
  const double* getEffortPtr() const { return eff_; }
  const double* getAbsolutePositionPtr() const { return absolute_pos_; }
  const double* getTorqueSensorPtr() const { return torque_sensor_; }
  bool hasAbsolutePosition() const { return absolute_pos_ != nullptr; }
  bool hasTorqueSensor() const { return torque_sensor_ != nullptr; }

private:
  const double* sensor(const double* data, const char* what) const
  {
    if (!data)
      throw std::runtime_error("'" + name_ + "' has no " + what + " sensor");
    return data;
  }

  std::string name_;
  const double* pos_ = nullptr;
  const double* vel_ = nullptr;
  const double* eff_ = nullptr;
  const double* absolute_pos_ = nullptr;
  const double* torque_sensor_ = nullptr;
};

}  // namespace internal
}  // namespace hardware_interface
