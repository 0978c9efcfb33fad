#include <transmission_interface/transmission_parser.h>

#include <sstream>

namespace transmission_interface
{
namespace
{

std::string trimmed(const char* text)
{
  const std::string whole = text ? text : "";
  const std::size_t first = whole.find_first_not_of(" \t\r\n");
  return first == std::string::npos ? "" : whole.substr(first, whole.find_last_not_of(" \t\r\n") - first + 1);
}

std::string text_of(TiXmlElement* parent, const char* tag)
{
  TiXmlElement* element = parent->FirstChildElement(tag);
  return element ? trimmed(element->GetText()) : "";
}

std::string name_of(TiXmlElement* element)
{
  const char* name = element->Attribute("name");
  return name ? name : "";
}

std::vector<std::string> interfaces_of(TiXmlElement* element)
{
  std::vector<std::string> interfaces;
  for (TiXmlElement* one = element->FirstChildElement("hardwareInterface"); one;
       one = one->NextSiblingElement("hardwareInterface"))
  {
    const std::string text = trimmed(one->GetText());
    if (!text.empty())
      interfaces.push_back(text);
  }
  return interfaces;
}

std::string written(TiXmlElement* element)
{
  std::stringstream stream;
  stream << *element;
  return stream.str();
}

}  // namespace

bool TransmissionParser::parse(const std::string& urdf, std::vector<TransmissionInfo>& transmissions)
{
  TiXmlDocument document;
  if (!document.Parse(urdf.c_str()) && document.Error())
  {
    ROS_ERROR("Can't parse transmissions. Invalid robot description: %s", document.ErrorDesc());
    return false;
  }
  TiXmlElement* root = document.RootElement();
  for (TiXmlElement* element = root ? root->FirstChildElement("transmission") : nullptr; element;
       element = element->NextSiblingElement("transmission"))
  {
    TransmissionInfo info;
    info.name_ = name_of(element);
    info.type_ = text_of(element, "type");
    const char* problem = nullptr;
    if (info.name_.empty())
      problem = "it has no name";
    else if (info.type_.empty())
      problem = "it has no <type>, e.g. transmission_interface/SimpleTransmission";
    else if (!parseJoints(element, info.joints_))
      problem = "it has no usable <joint>";
    else if (!parseActuators(element, info.actuators_))
      problem = "it has no <actuator name=\"...\">";
    if (problem)
      ROS_ERROR("transmission '%s' is left out: %s", info.name_.c_str(), problem);
    else
      transmissions.push_back(info);
  }
  return root;
}

bool TransmissionParser::parseJoints(TiXmlElement* transmission, std::vector<JointInfo>& joints)
{
  for (TiXmlElement* element = transmission->FirstChildElement("joint"); element;
       element = element->NextSiblingElement("joint"))
  {
    if (!element->Attribute("name"))
    {
      ROS_ERROR("a <joint> of a transmission has no name attribute");
      return false;
    }
    JointInfo joint;
    joint.name_ = name_of(element);
    joint.hardware_interfaces_ = interfaces_of(element);
    joint.role_ = text_of(element, "role");
    joint.xml_element_ = written(element);
    if (joint.name_.empty() || joint.hardware_interfaces_.empty())
      ROS_ERROR(
          "joint '%s' of a transmission is left out: it needs a name and a <hardwareInterface>, which belongs into <joint>",
          joint.name_.c_str());
    else
      joints.push_back(joint);
  }
  return !joints.empty();
}

bool TransmissionParser::parseActuators(TiXmlElement* transmission, std::vector<ActuatorInfo>& actuators)
{
  for (TiXmlElement* element = transmission->FirstChildElement("actuator"); element;
       element = element->NextSiblingElement("actuator"))
  {
    ActuatorInfo actuator;
    actuator.name_ = name_of(element);
    actuator.hardware_interfaces_ = interfaces_of(element);
    actuator.xml_element_ = written(element);
    if (!element->Attribute("name"))
    {
      ROS_ERROR("an <actuator> of a transmission has no name attribute");
      return false;
    }
    if (actuator.name_.empty())
      ROS_ERROR("an <actuator> of a transmission is left out: its name is empty");
    else
      actuators.push_back(actuator);
  }
  return !actuators.empty();
}

}  // namespace transmission_interface
