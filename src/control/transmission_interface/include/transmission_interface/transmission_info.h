// What a <transmission> of a robot's description says.
#pragma once

#include <string>
#include <vector>

#include <tinyxml.h>

namespace transmission_interface
{

struct JointInfo
{
  std::string name_;
  std::vector<std::string> hardware_interfaces_;  ///< as written, hardware_interface/EffortJointInterface
  std::string role_;
  std::string xml_element_;  ///< the whole <joint>
};

struct ActuatorInfo
{
  std::string name_;
  std::vector<std::string> hardware_interfaces_;
  std::string xml_element_;
};

struct TransmissionInfo
{
  std::string name_;
  std::string type_;  ///< look-up name, transmission_interface/SimpleTransmission
  std::vector<JointInfo> joints_;
  std::vector<ActuatorInfo> actuators_;
};

}  // namespace transmission_interface
