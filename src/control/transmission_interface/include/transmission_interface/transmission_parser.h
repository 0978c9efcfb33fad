// <transmission> elements of a robot's description.
#pragma once

#include <string>
#include <vector>

#include <ros/console.h>
#include <tinyxml.h>
#include <transmission_interface/transmission_info.h>

namespace transmission_interface
{

/// Those that cannot be used are left out one by one, each with a line that says why.
class TransmissionParser
{
public:
  /// \param[out] transmissions are added to it \return false: the text is no XML
  static bool parse(const std::string& urdf_string, std::vector<TransmissionInfo>& transmissions);

protected:
  static bool parseJoints(TiXmlElement* trans_it, std::vector<JointInfo>& joints);
  static bool parseActuators(TiXmlElement* trans_it, std::vector<ActuatorInfo>& actuators);
};

}  // namespace transmission_interface
