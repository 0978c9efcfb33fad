// Two actuators and two joints.
#pragma once

#include <vector>

#include <transmission_interface/internal/law_transmission.h>

namespace transmission_interface
{

/// The first actuator moves the first joint, and the second one along with it.
class FourBarLinkageTransmission : public internal::LawTransmissionOfTwo
{
public:
  /// \throws TransmissionInterfaceException not two numbers each, a reduction of 0, or a number that is not finite
  FourBarLinkageTransmission(const std::vector<double>& actuator_reduction, const std::vector<double>& joint_reduction,
                             const std::vector<double>& joint_offset = std::vector<double>(2, 0.0))
    : FourBarLinkageTransmission(TransmissionLaw(Coupling::FourBar, actuator_reduction, joint_reduction, joint_offset))
  {
  }
  explicit FourBarLinkageTransmission(const TransmissionLaw& law) : LawTransmissionOfTwo(law) {}
};

}  // namespace transmission_interface
