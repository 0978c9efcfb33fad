// Makes transmissions of what a robot's description says; base of plugins for types of one's own.
#pragma once

#include <memory>
#include <sstream>
#include <string>

#include <ros/console.h>
#include <tinyxml.h>
#include <transmission_interface/robot_transmissions.h>
#include <transmission_interface/transmission.h>
#include <transmission_interface/transmission_info.h>
#include <transmission_interface/transmission_law.h>

namespace transmission_interface
{

/// Exported for the package transmission_interface under transmission_interface::TransmissionLoader; its look-up name is the <type>.
class TransmissionLoader
{
public:
  virtual ~TransmissionLoader() = default;

  /// \return null: it cannot be made, the log says why
  virtual TransmissionSharedPtr load(const TransmissionInfo& transmission_info) = 0;

protected:
  static bool checkActuatorDimension(const TransmissionInfo& info, const unsigned int expected)
  {
    return hasCount(info, "actuators", info.actuators_.size(), expected);
  }
  static bool checkJointDimension(const TransmissionInfo& info, const unsigned int expected)
  {
    return hasCount(info, "joints", info.joints_.size(), expected);
  }

  static TiXmlElement loadXmlElement(const std::string& text)
  {
    TiXmlElement element("");
    std::stringstream(text) >> element;
    return element;
  }

  enum ParseStatus
  {
    SUCCESS,
    NO_DATA,  // it is not there; an error only where it is required
    BAD_TYPE  // no number
  };

  // Numbers and words of an <actuator> or <joint>.

  static ParseStatus getActuatorReduction(const TiXmlElement& parent, const std::string& actuator,
                                          const std::string& transmission, bool required, double& reduction)
  {
    return number(parent, "mechanicalReduction", "actuator '" + actuator, transmission, required, reduction);
  }
  static ParseStatus getJointReduction(const TiXmlElement& parent, const std::string& joint, const std::string& transmission,
                                       bool required, double& reduction)
  {
    return number(parent, "mechanicalReduction", "joint '" + joint, transmission, required, reduction);
  }
  static ParseStatus getJointOffset(const TiXmlElement& parent, const std::string& joint, const std::string& transmission,
                                    bool required, double& offset)
  {
    return number(parent, "offset", "joint '" + joint, transmission, required, offset);
  }
  static ParseStatus getActuatorRole(const TiXmlElement& parent, const std::string& actuator, const std::string& transmission,
                                     bool required, std::string& role)
  {
    return text(parent, "role", "actuator '" + actuator, transmission, required, role);
  }
  static ParseStatus getJointRole(const TiXmlElement& parent, const std::string& joint, const std::string& transmission,
                                  bool required, std::string& role)
  {
    return text(parent, "role", "joint '" + joint, transmission, required, role);
  }

private:
  static bool hasCount(const TransmissionInfo& info, const char* what, std::size_t has, unsigned int expected)
  {
    if (has != expected)
      ROS_ERROR_STREAM("Invalid description for transmission '" << info.name_ << "' of type '" << info.type_ << "'. Expected "
                                                                << expected << " " << what << ", got " << has << ".");
    return has == expected;
  }

  static ParseStatus text(const TiXmlElement& parent, const char* tag, const std::string& whose,
                          const std::string& transmission, bool required, std::string& result)
  {
    const TiXmlElement* element = parent.FirstChildElement(tag);
    if (element && element->GetText())
      result = element->GetText();
    else if (required)
      ROS_ERROR_STREAM("transmission '" << transmission << "', " << whose << "': it needs <" << tag << ">");
    return element && element->GetText() ? SUCCESS : NO_DATA;
  }

  static ParseStatus number(const TiXmlElement& parent, const char* tag, const std::string& whose,
                            const std::string& transmission, bool required, double& result)
  {
    std::string written;
    if (text(parent, tag, whose, transmission, required, written) != SUCCESS)
      return NO_DATA;
    if (internal::number_of(written, result))
      return SUCCESS;
    ROS_ERROR_STREAM("transmission '" << transmission << "', " << whose << "': <" << tag << ">" << written << "</" << tag
                                      << "> is no number");
    return BAD_TYPE;
  }
};

typedef std::shared_ptr<TransmissionLoader> TransmissionLoaderSharedPtr;

}  // namespace transmission_interface
