// What lies between actuators and joints.
#pragma once

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <vector>

namespace transmission_interface
{

/// Where the numbers of actuators are, in the transmission's order; a vector may be empty where there are none.
struct ActuatorData
{
  std::vector<double*> position;
  std::vector<double*> velocity;
  std::vector<double*> effort;
  std::vector<double*> absolute_position;
  std::vector<double*> torque_sensor;
};

/// Likewise of joints.
struct JointData
{
  std::vector<double*> position;
  std::vector<double*> velocity;
  std::vector<double*> effort;
  std::vector<double*> absolute_position;
  std::vector<double*> torque_sensor;
};

/// Maps between both sides, in SI units.
class Transmission
{
public:
  virtual ~Transmission() = default;

  virtual void actuatorToJointEffort(const ActuatorData& act_data, JointData& jnt_data) = 0;
  virtual void actuatorToJointVelocity(const ActuatorData& act_data, JointData& jnt_data) = 0;
  virtual void actuatorToJointPosition(const ActuatorData& act_data, JointData& jnt_data) = 0;
  virtual void actuatorToJointAbsolutePosition(const ActuatorData& /*act_data*/, JointData& /*jnt_data*/)
  {
    throw std::runtime_error("transmission does not support actuator to joint absolute position");
  }
  virtual void actuatorToJointTorqueSensor(const ActuatorData& /*act_data*/, JointData& /*jnt_data*/)
  {
    throw std::runtime_error("transmission does not support actuator to joint torque sensor");
  }
  virtual bool hasActuatorToJointAbsolutePosition() const { return false; }
  virtual bool hasActuatorToJointTorqueSensor() const { return false; }

  virtual void jointToActuatorEffort(const JointData& jnt_data, ActuatorData& act_data) = 0;
  virtual void jointToActuatorVelocity(const JointData& jnt_data, ActuatorData& act_data) = 0;
  virtual void jointToActuatorPosition(const JointData& jnt_data, ActuatorData& act_data) = 0;

  virtual std::size_t numActuators() const = 0;
  virtual std::size_t numJoints() const = 0;
};

typedef std::shared_ptr<Transmission> TransmissionSharedPtr;

}  // namespace transmission_interface
