// Handles that bring numbers through a transmission once in a cycle, and collections of them.
#pragma once

#include <string>
#include <vector>

#include <hardware_interface/internal/resource_manager.h>
#include <transmission_interface/transmission.h>
#include <transmission_interface/transmission_interface_exception.h>

namespace transmission_interface
{

/// A transmission with the numbers on its two sides.
class TransmissionHandle
{
public:
  std::string getName() const { return name_; }

protected:
  /// \throws TransmissionInterfaceException there is no transmission, nothing to do, a size that does not fit, or a null pointer
  TransmissionHandle(const std::string& name, Transmission* transmission, const ActuatorData& actuator_data,
                     const JointData& joint_data)
    : name_(name)
    , transmission_(transmission)
    , actuator_data_(actuator_data)
    , joint_data_(joint_data)
  {
    if (!transmission_)
      throw TransmissionInterfaceException("Unspecified transmission.");
    const ActuatorData& a = actuator_data;
    const JointData& j = joint_data;
    if (a.position.empty() && a.velocity.empty() && a.effort.empty() && j.position.empty() && j.velocity.empty() &&
        j.effort.empty())
      throw TransmissionInterfaceException("All data vectors are empty. Transmission instance can't do anything!.");
    check("Actuator position", a.position, transmission_->numActuators());
    check("Actuator velocity", a.velocity, transmission_->numActuators());
    check("Actuator effort", a.effort, transmission_->numActuators());
    check("Actuator absolute position", a.absolute_position, transmission_->numActuators());
    check("Actuator torque sensor", a.torque_sensor, transmission_->numActuators());
    check("Joint position", j.position, transmission_->numJoints());
    check("Joint velocity", j.velocity, transmission_->numJoints());
    check("Joint effort", j.effort, transmission_->numJoints());
    check("Joint absolute position", j.absolute_position, transmission_->numJoints());
    check("Joint torque sensor", j.torque_sensor, transmission_->numJoints());
  }

  std::string name_;
  Transmission* transmission_;
  ActuatorData actuator_data_;
  JointData joint_data_;

private:
  static void check(const std::string& what, const std::vector<double*>& data, std::size_t size)
  {
    if (!data.empty() && data.size() != size)
      throw TransmissionInterfaceException(what + " data size does not match transmission.");
    for (const double* pointer : data)
      if (!pointer)
        throw TransmissionInterfaceException(what + " data contains null pointers.");
  }
};

/// All that is measured, from the actuators to the joints.
class ActuatorToJointStateHandle : public TransmissionHandle
{
public:
  ActuatorToJointStateHandle(const std::string& name, Transmission* transmission, const ActuatorData& actuator_data,
                             const JointData& joint_data)
    : TransmissionHandle(name, transmission, actuator_data, joint_data)
  {
  }

  void propagate()
  {
    transmission_->actuatorToJointPosition(actuator_data_, joint_data_);
    transmission_->actuatorToJointVelocity(actuator_data_, joint_data_);
    transmission_->actuatorToJointEffort(actuator_data_, joint_data_);
    if (!actuator_data_.absolute_position.empty() && transmission_->hasActuatorToJointAbsolutePosition())
      transmission_->actuatorToJointAbsolutePosition(actuator_data_, joint_data_);
    if (!actuator_data_.torque_sensor.empty() && transmission_->hasActuatorToJointTorqueSensor())
      transmission_->actuatorToJointTorqueSensor(actuator_data_, joint_data_);
  }
};

/// All that is measured, from the joints to the actuators.
class JointToActuatorStateHandle : public TransmissionHandle
{
public:
  JointToActuatorStateHandle(const std::string& name, Transmission* transmission, const ActuatorData& actuator_data,
                             const JointData& joint_data)
    : TransmissionHandle(name, transmission, actuator_data, joint_data)
  {
  }

  void propagate()
  {
    transmission_->jointToActuatorPosition(joint_data_, actuator_data_);
    transmission_->jointToActuatorVelocity(joint_data_, actuator_data_);
    transmission_->jointToActuatorEffort(joint_data_, actuator_data_);
  }
};

class ActuatorToJointPositionHandle : public TransmissionHandle
{
public:
  ActuatorToJointPositionHandle(const std::string& name, Transmission* transmission, const ActuatorData& actuator_data,
                                const JointData& joint_data)
    : TransmissionHandle(name, transmission, actuator_data, joint_data)
  {
  }

  void propagate() { transmission_->actuatorToJointPosition(actuator_data_, joint_data_); }
};

class ActuatorToJointVelocityHandle : public TransmissionHandle
{
public:
  ActuatorToJointVelocityHandle(const std::string& name, Transmission* transmission, const ActuatorData& actuator_data,
                                const JointData& joint_data)
    : TransmissionHandle(name, transmission, actuator_data, joint_data)
  {
  }

  void propagate() { transmission_->actuatorToJointVelocity(actuator_data_, joint_data_); }
};

class ActuatorToJointEffortHandle : public TransmissionHandle
{
public:
  ActuatorToJointEffortHandle(const std::string& name, Transmission* transmission, const ActuatorData& actuator_data,
                              const JointData& joint_data)
    : TransmissionHandle(name, transmission, actuator_data, joint_data)
  {
  }

  void propagate() { transmission_->actuatorToJointEffort(actuator_data_, joint_data_); }
};

class JointToActuatorPositionHandle : public TransmissionHandle
{
public:
  JointToActuatorPositionHandle(const std::string& name, Transmission* transmission, const ActuatorData& actuator_data,
                                const JointData& joint_data)
    : TransmissionHandle(name, transmission, actuator_data, joint_data)
  {
  }

  void propagate() { transmission_->jointToActuatorPosition(joint_data_, actuator_data_); }
};

class JointToActuatorVelocityHandle : public TransmissionHandle
{
public:
  JointToActuatorVelocityHandle(const std::string& name, Transmission* transmission, const ActuatorData& actuator_data,
                                const JointData& joint_data)
    : TransmissionHandle(name, transmission, actuator_data, joint_data)
  {
  }

  void propagate() { transmission_->jointToActuatorVelocity(joint_data_, actuator_data_); }
};

class JointToActuatorEffortHandle : public TransmissionHandle
{
public:
  JointToActuatorEffortHandle(const std::string& name, Transmission* transmission, const ActuatorData& actuator_data,
                              const JointData& joint_data)
    : TransmissionHandle(name, transmission, actuator_data, joint_data)
  {
  }

  void propagate() { transmission_->jointToActuatorEffort(joint_data_, actuator_data_); }
};

/// Handles of one kind, brought through together.
template <class HandleType>
class TransmissionInterface : public hardware_interface::ResourceManager<HandleType>
{
public:
  HandleType getHandle(const std::string& name)
  {
    try
    {
      return this->hardware_interface::ResourceManager<HandleType>::getHandle(name);
    }
    catch (const std::logic_error& error)
    {
      throw TransmissionInterfaceException(error.what());
    }
  }

  void propagate()
  {
    for (auto& entry : this->resource_map_)
      entry.second.propagate();
  }
};

class ActuatorToJointStateInterface : public TransmissionInterface<ActuatorToJointStateHandle>
{
};
class ActuatorToJointPositionInterface : public TransmissionInterface<ActuatorToJointPositionHandle>
{
};
class ActuatorToJointVelocityInterface : public TransmissionInterface<ActuatorToJointVelocityHandle>
{
};
class ActuatorToJointEffortInterface : public TransmissionInterface<ActuatorToJointEffortHandle>
{
};
class JointToActuatorStateInterface : public TransmissionInterface<JointToActuatorStateHandle>
{
};
class JointToActuatorPositionInterface : public TransmissionInterface<JointToActuatorPositionHandle>
{
};
class JointToActuatorVelocityInterface : public TransmissionInterface<JointToActuatorVelocityHandle>
{
};
class JointToActuatorEffortInterface : public TransmissionInterface<JointToActuatorEffortHandle>
{
};

}  // namespace transmission_interface
