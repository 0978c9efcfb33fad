// Two actuators and two joints.
#pragma once

#include <vector>

#include <transmission_interface/internal/two_by_two_transmission.h>

namespace transmission_interface
{

/// The joints move with the sum and the difference of the actuators.
class DifferentialTransmission : public internal::TwoByTwoTransmission
{
public:
  /// \throws TransmissionInterfaceException not two numbers each, or a reduction of 0
  DifferentialTransmission(const std::vector<double>& actuator_reduction, const std::vector<double>& joint_reduction,
                           const std::vector<double>& joint_offset = std::vector<double>(2, 0.0),
                           bool ignore_transmission_for_absolute_encoders = false)
    : TwoByTwoTransmission(actuator_reduction, joint_reduction, joint_offset)
    , ignore_(ignore_transmission_for_absolute_encoders)
  {
  }

private:
  // a: actuators, j: joints, x, y: what is in between
  Two toJoint(const Two& a) const override
  {
    const double x = a[0] / actuator_[0], y = a[1] / actuator_[1];
    return Two{ { (x + y) / (2.0 * joint_[0]), (x - y) / (2.0 * joint_[1]) } };
  }
  Two effortToJoint(const Two& a) const override
  {
    const double x = a[0] * actuator_[0], y = a[1] * actuator_[1];
    return Two{ { joint_[0] * (x + y), joint_[1] * (x - y) } };
  }
  Two toActuator(const Two& j) const override
  {
    const double x = j[0] * joint_[0], y = j[1] * joint_[1];
    return Two{ { (x + y) * actuator_[0], (x - y) * actuator_[1] } };
  }
  Two effortToActuator(const Two& j) const override
  {
    const double x = j[0] / joint_[0], y = j[1] / joint_[1];
    return Two{ { (x + y) / (2.0 * actuator_[0]), (x - y) / (2.0 * actuator_[1]) } };
  }
  Two absoluteToJoint(const Two& a) const override
  {
    return ignore_ ? Two{ { a[1], a[0] } } : TwoByTwoTransmission::absoluteToJoint(a);
  }

  bool ignore_;  // absolute encoders sit on the joints, crosswise
};

}  // namespace transmission_interface
