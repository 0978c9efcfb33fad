// The law as one of upstream's transmissions.
#pragma once

#include <vector>

#include <transmission_interface/transmission.h>
#include <transmission_interface/transmission_law.h>

namespace transmission_interface
{
namespace internal
{

class LawTransmission : public Transmission
{
public:
  explicit LawTransmission(const TransmissionLaw& law) : law_(law) {}

  void actuatorToJointEffort(const ActuatorData& act_data, JointData& jnt_data) override
  {
    bring(act_data.effort, &TransmissionLaw::effort_to_joint, jnt_data.effort);
  }
  void actuatorToJointVelocity(const ActuatorData& act_data, JointData& jnt_data) override
  {
    bring(act_data.velocity, &TransmissionLaw::velocity_to_joint, jnt_data.velocity);
  }
  void actuatorToJointPosition(const ActuatorData& act_data, JointData& jnt_data) override
  {
    bring(act_data.position, &TransmissionLaw::position_to_joint, jnt_data.position);
  }
  void actuatorToJointAbsolutePosition(const ActuatorData& act_data, JointData& jnt_data) override
  {
    bring(act_data.absolute_position, &TransmissionLaw::absolute_to_joint, jnt_data.absolute_position);
  }
  void actuatorToJointTorqueSensor(const ActuatorData& act_data, JointData& jnt_data) override
  {
    bring(act_data.torque_sensor, &TransmissionLaw::effort_to_joint, jnt_data.torque_sensor);
  }
  bool hasActuatorToJointAbsolutePosition() const override { return true; }
  bool hasActuatorToJointTorqueSensor() const override { return true; }

  void jointToActuatorEffort(const JointData& jnt_data, ActuatorData& act_data) override
  {
    bring(jnt_data.effort, &TransmissionLaw::effort_to_actuator, act_data.effort);
  }
  void jointToActuatorVelocity(const JointData& jnt_data, ActuatorData& act_data) override
  {
    bring(jnt_data.velocity, &TransmissionLaw::velocity_to_actuator, act_data.velocity);
  }
  void jointToActuatorPosition(const JointData& jnt_data, ActuatorData& act_data) override
  {
    bring(jnt_data.position, &TransmissionLaw::position_to_actuator, act_data.position);
  }

  std::size_t numActuators() const override { return law_.size(); }
  std::size_t numJoints() const override { return law_.size(); }

protected:
  const TransmissionLaw law_;

private:
  typedef TransmissionLaw::Values Values;

  void bring(const std::vector<double*>& from, Values (TransmissionLaw::*way)(const Values&) const,
             const std::vector<double*>& to) const
  {
    Values values{ { 0.0, 0.0 } };
    for (std::size_t i = 0; i < law_.size(); ++i)
      values[i] = *from.at(i);
    values = (law_.*way)(values);
    for (std::size_t i = 0; i < law_.size(); ++i)
      *to.at(i) = values[i];
  }
};

/// Two actuators and two joints.
class LawTransmissionOfTwo : public LawTransmission
{
public:
  using LawTransmission::LawTransmission;
  const std::vector<double>& getActuatorReduction() const { return law_.n; }
  const std::vector<double>& getJointReduction() const { return law_.m; }
  const std::vector<double>& getJointOffset() const { return law_.offset; }
};

}  // namespace internal
}  // namespace transmission_interface
