// A hardware interface of a third party, and a controller's way to it.
#pragma once

#include <string>

#include <hardware_interface/internal/hardware_resource_manager.h>

namespace controller_manager_tests
{

class LampHandle
{
public:
  LampHandle() = default;
  LampHandle(const std::string& name, double* brightness) : name_(name), brightness_(brightness) {}
  std::string getName() const { return name_; }
  void shine(double brightness) { *brightness_ = brightness; }

private:
  std::string name_;
  double* brightness_ = nullptr;
};

class LampInterface : public hardware_interface::HardwareResourceManager<LampHandle, hardware_interface::ClaimResources>
{
};

}  // namespace controller_manager_tests
