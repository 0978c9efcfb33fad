// Two actuators and two joints, whichever way they are coupled.
#pragma once

#include <array>
#include <vector>

#include <transmission_interface/transmission.h>
#include <transmission_interface/transmission_interface_exception.h>

namespace transmission_interface
{
namespace internal
{

/// What it is coupled by is told by the four functions that a kind of transmission defines.
class TwoByTwoTransmission : public Transmission
{
public:
  /// \throws TransmissionInterfaceException not two numbers each, or a reduction of 0
  TwoByTwoTransmission(const std::vector<double>& actuator_reduction, const std::vector<double>& joint_reduction,
                       const std::vector<double>& joint_offset)
    : actuator_(actuator_reduction)
    , joint_(joint_reduction)
    , offset_(joint_offset)
  {
    if (actuator_.size() != 2 || joint_.size() != 2 || offset_.size() != 2)
      throw TransmissionInterfaceException("Reduction and offset vectors must have size 2.");
    if (actuator_[0] == 0.0 || actuator_[1] == 0.0 || joint_[0] == 0.0 || joint_[1] == 0.0)
      throw TransmissionInterfaceException("Transmission reduction ratios cannot be zero.");
  }

  void actuatorToJointEffort(const ActuatorData& act_data, JointData& jnt_data) override
  {
    put(jnt_data.effort, effortToJoint(get(act_data.effort)));
  }
  void actuatorToJointVelocity(const ActuatorData& act_data, JointData& jnt_data) override
  {
    put(jnt_data.velocity, toJoint(get(act_data.velocity)));
  }
  void actuatorToJointPosition(const ActuatorData& act_data, JointData& jnt_data) override
  {
    put(jnt_data.position, withOffset(toJoint(get(act_data.position)), 1.0));
  }
  void actuatorToJointAbsolutePosition(const ActuatorData& act_data, JointData& jnt_data) override
  {
    put(jnt_data.absolute_position, absoluteToJoint(get(act_data.absolute_position)));
  }
  void actuatorToJointTorqueSensor(const ActuatorData& act_data, JointData& jnt_data) override
  {
    put(jnt_data.torque_sensor, effortToJoint(get(act_data.torque_sensor)));
  }
  bool hasActuatorToJointAbsolutePosition() const override { return true; }
  bool hasActuatorToJointTorqueSensor() const override { return true; }

  void jointToActuatorEffort(const JointData& jnt_data, ActuatorData& act_data) override
  {
    put(act_data.effort, effortToActuator(get(jnt_data.effort)));
  }
  void jointToActuatorVelocity(const JointData& jnt_data, ActuatorData& act_data) override
  {
    put(act_data.velocity, toActuator(get(jnt_data.velocity)));
  }
  void jointToActuatorPosition(const JointData& jnt_data, ActuatorData& act_data) override
  {
    put(act_data.position, toActuator(withOffset(get(jnt_data.position), -1.0)));
  }

  std::size_t numActuators() const override { return 2; }
  std::size_t numJoints() const override { return 2; }
  const std::vector<double>& getActuatorReduction() const { return actuator_; }
  const std::vector<double>& getJointReduction() const { return joint_; }
  const std::vector<double>& getJointOffset() const { return offset_; }

protected:
  typedef std::array<double, 2> Two;

  // a: actuators, j: joints
  virtual Two toJoint(const Two& a) const = 0;
  virtual Two effortToJoint(const Two& a) const = 0;
  virtual Two toActuator(const Two& j) const = 0;
  virtual Two effortToActuator(const Two& j) const = 0;
  virtual Two absoluteToJoint(const Two& a) const { return withOffset(toJoint(a), 1.0); }

  std::vector<double> actuator_, joint_, offset_;

private:
  static Two get(const std::vector<double*>& data) { return Two{ { *data.at(0), *data.at(1) } }; }
  static void put(const std::vector<double*>& data, const Two& values)
  {
    *data.at(0) = values[0];
    *data.at(1) = values[1];
  }
  Two withOffset(const Two& j, double sign) const { return Two{ { j[0] + sign * offset_[0], j[1] + sign * offset_[1] } }; }
};

}  // namespace internal
}  // namespace transmission_interface
