#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include <sdf/sdf.hh>

#include <gazebo/common/CommonTypes.hh>
#include <gazebo/util/system.hh>

namespace gazebo
{
namespace common
{

/// The battery of a link: V, and W that consumers take. In each step a function says its new voltage; without one it stays.
class GAZEBO_VISIBLE Battery : public std::enable_shared_from_this<Battery>
{
public:
  using PowerLoad_M = std::map<uint32_t, double>;
  using Law = std::function<double(const BatteryPtr&)>;

  virtual ~Battery() = default;
  virtual void Load(sdf::ElementPtr sdf);  // <battery>
  virtual void Init() { ResetVoltage(), loads_.clear(), next_ = 0; }
  virtual void ResetVoltage() { voltage_ = first_; }
  virtual void UpdateParameters(const sdf::ElementPtr sdf) { Load(sdf); }
  std::string Name() const { return name_; }
  double Voltage() const { return voltage_; }
  uint32_t AddConsumer();
  bool RemoveConsumer(uint32_t consumer) { return loads_.erase(consumer) > 0; }
  bool SetPowerLoad(uint32_t consumer, double load);
  bool PowerLoad(uint32_t consumer, double& load) const;
  const PowerLoad_M& PowerLoads() const { return loads_; }
  void SetUpdateFunc(Law law);  // what throws is not called again
  void Update();

private:
  bool known(uint32_t consumer) const;
  std::string name_;
  double first_ = 0, voltage_ = 0;
  uint32_t next_ = 0;
  PowerLoad_M loads_;
  Law law_;
  const char* owner_ = nullptr;  // the plugin that gave it
};

}  // namespace common
}  // namespace gazebo
