// One actuator and one joint.
#pragma once

#include <transmission_interface/internal/law_transmission.h>

namespace transmission_interface
{

/// joint = actuator / reduction + offset
class SimpleTransmission : public internal::LawTransmission
{
public:
  /// \throws TransmissionInterfaceException a reduction of 0, or a number that is not finite
  SimpleTransmission(const double reduction, const double joint_offset = 0.0)
    : SimpleTransmission(TransmissionLaw(Coupling::Simple, { reduction }, { 1.0 }, { joint_offset }))
  {
  }
  explicit SimpleTransmission(const TransmissionLaw& law) : LawTransmission(law) {}
  double getActuatorReduction() const { return law_.n[0]; }
  double getJointOffset() const { return law_.offset[0]; }
};

}  // namespace transmission_interface
