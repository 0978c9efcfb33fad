// Two actuators and two joints.
#pragma once

#include <vector>

#include <transmission_interface/internal/law_transmission.h>

namespace transmission_interface
{

/// The joints move with the sum and the difference of the actuators.
class DifferentialTransmission : public internal::LawTransmissionOfTwo
{
public:
  // \throws TransmissionInterfaceException not two numbers each, a reduction of 0, or a number that is not finite

  DifferentialTransmission(const std::vector<double>& actuator_reduction, const std::vector<double>& joint_reduction,
                           const std::vector<double>& joint_offset)
    : DifferentialTransmission(actuator_reduction, joint_reduction, false, joint_offset)
  {
  }
  DifferentialTransmission(const std::vector<double>& actuator_reduction, const std::vector<double>& joint_reduction,
                           bool ignore_transmission_for_absolute_encoders = false,
                           const std::vector<double>& joint_offset = std::vector<double>(2, 0.0))
    : DifferentialTransmission(TransmissionLaw(Coupling::Differential, actuator_reduction, joint_reduction, joint_offset,
                                               ignore_transmission_for_absolute_encoders))
  {
  }
  explicit DifferentialTransmission(const TransmissionLaw& law) : LawTransmissionOfTwo(law) {}
};

}  // namespace transmission_interface
