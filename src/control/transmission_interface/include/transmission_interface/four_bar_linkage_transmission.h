// Two actuators and two joints.
#pragma once

#include <vector>

#include <transmission_interface/internal/two_by_two_transmission.h>

namespace transmission_interface
{

/// The first actuator moves the first joint, and the second one along with it.
class FourBarLinkageTransmission : public internal::TwoByTwoTransmission
{
public:
  /// \throws TransmissionInterfaceException not two numbers each, or a reduction of 0
  FourBarLinkageTransmission(const std::vector<double>& actuator_reduction, const std::vector<double>& joint_reduction,
                             const std::vector<double>& joint_offset = std::vector<double>(2, 0.0))
    : TwoByTwoTransmission(actuator_reduction, joint_reduction, joint_offset)
  {
  }

private:
  Two toJoint(const Two& a) const override
  {
    const double first = a[0] / (joint_[0] * actuator_[0]);
    return Two{ { first, (a[1] / actuator_[1] - first) / joint_[1] } };
  }
  Two effortToJoint(const Two& a) const override
  {
    return Two{ { joint_[0] * a[0] * actuator_[0], joint_[1] * (a[1] * actuator_[1] - a[0] * actuator_[0] * joint_[0]) } };
  }
  Two toActuator(const Two& j) const override
  {
    return Two{ { j[0] * joint_[0] * actuator_[0], (j[0] + j[1] * joint_[1]) * actuator_[1] } };
  }
  Two effortToActuator(const Two& j) const override
  {
    return Two{ { j[0] / (actuator_[0] * joint_[0]), (j[0] + j[1] / joint_[1]) / actuator_[1] } };
  }
};

}  // namespace transmission_interface
