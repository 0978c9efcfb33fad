// How the drives of joints control them.
#pragma once

#include <string>

#include <hardware_interface/internal/hardware_resource_manager.h>

namespace hardware_interface
{

enum class JointCommandModes
{
  BEGIN = -1,
  MODE_POSITION = 0,
  MODE_VELOCITY = 1,
  MODE_EFFORT = 2,
  NOMODE = 3,
  EMERGENCY_STOP = 4,
  SWITCHING = 5,
  ERROR = 6
};

/// Points to the mode of one drive.
class JointModeHandle
{
public:
  JointModeHandle() = default;

  /// \throws HardwareInterfaceException the pointer is null.
  JointModeHandle(std::string name, JointCommandModes* mode) : name_(name), mode_(internal::required(mode, name, "Mode")) {}

  std::string getName() const { return name_; }
  void setMode(JointCommandModes mode) { *internal::filled(mode_, name_) = mode; }
  JointCommandModes getMode() const { return *internal::filled(mode_, name_); }
  const JointCommandModes* getModePtr() const { return mode_; }

  /// A word for messages.
  std::string getModeName(JointCommandModes mode) const
  {
    static const char* const words[] = { "not_operational", "position",       "velocity",  "effort",
                                         "other",           "emergency_stop", "switching", "error" };
    const int index = static_cast<int>(mode) + 1;
    return index >= 0 && index < 8 ? words[index] : "unknown";
  }

private:
  std::string name_;
  JointCommandModes* mode_ = nullptr;
};

/// Taking a handle claims nothing.
class JointModeInterface : public HardwareResourceManager<JointModeHandle>
{
};

}  // namespace hardware_interface
