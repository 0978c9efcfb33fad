// One actuator and one joint.
#pragma once

#include <cassert>

#include <transmission_interface/transmission.h>
#include <transmission_interface/transmission_interface_exception.h>

namespace transmission_interface
{

/// joint = actuator / reduction + offset
class SimpleTransmission : public Transmission
{
public:
  /// \throws TransmissionInterfaceException a reduction of 0
  explicit SimpleTransmission(const double reduction, const double joint_offset = 0.0)
    : reduction_(reduction)
    , offset_(joint_offset)
  {
    if (reduction_ == 0.0)
      throw TransmissionInterfaceException("Transmission reduction ratio cannot be zero.");
  }

  void actuatorToJointEffort(const ActuatorData& act_data, JointData& jnt_data) override
  {
    *jnt_data.effort.at(0) = *act_data.effort.at(0) * reduction_;
  }
  void actuatorToJointVelocity(const ActuatorData& act_data, JointData& jnt_data) override
  {
    *jnt_data.velocity.at(0) = *act_data.velocity.at(0) / reduction_;
  }
  void actuatorToJointPosition(const ActuatorData& act_data, JointData& jnt_data) override
  {
    *jnt_data.position.at(0) = *act_data.position.at(0) / reduction_ + offset_;
  }
  void actuatorToJointAbsolutePosition(const ActuatorData& act_data, JointData& jnt_data) override
  {
    *jnt_data.absolute_position.at(0) = *act_data.absolute_position.at(0) / reduction_ + offset_;
  }
  void actuatorToJointTorqueSensor(const ActuatorData& act_data, JointData& jnt_data) override
  {
    *jnt_data.torque_sensor.at(0) = *act_data.torque_sensor.at(0) * reduction_;
  }
  bool hasActuatorToJointAbsolutePosition() const override { return true; }
  bool hasActuatorToJointTorqueSensor() const override { return true; }

  void jointToActuatorEffort(const JointData& jnt_data, ActuatorData& act_data) override
  {
    *act_data.effort.at(0) = *jnt_data.effort.at(0) / reduction_;
  }
  void jointToActuatorVelocity(const JointData& jnt_data, ActuatorData& act_data) override
  {
    *act_data.velocity.at(0) = *jnt_data.velocity.at(0) * reduction_;
  }
  void jointToActuatorPosition(const JointData& jnt_data, ActuatorData& act_data) override
  {
    *act_data.position.at(0) = (*jnt_data.position.at(0) - offset_) * reduction_;
  }

  std::size_t numActuators() const override { return 1; }
  std::size_t numJoints() const override { return 1; }
  double getActuatorReduction() const { return reduction_; }
  double getJointOffset() const { return offset_; }

private:
  double reduction_, offset_;
};

}  // namespace transmission_interface
