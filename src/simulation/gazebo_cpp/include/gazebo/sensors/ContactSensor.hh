#pragma once
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include <gazebo/physics/Contact.hh>
#include <gazebo/sensors/Sensor.hh>

namespace gazebo
{
namespace sensors
{

/// Contacts of the collisions that <contact> names, in the step of the measurement.
class GAZEBO_VISIBLE ContactSensor : public Sensor
{
public:
  ContactSensor();
  ~ContactSensor() override;
  void Load(const std::string& world) override;
  using Sensor::Load;
  msgs::Contacts Contacts() const;
  std::map<std::string, physics::Contact> Contacts(const std::string& collision);  // by the other one's scoped name
  unsigned int GetCollisionCount() const { return static_cast<unsigned int>(collisions_.size()); }
  std::string GetCollisionName(unsigned int index) const { return index < collisions_.size() ? collisions_[index] : ""; }
  unsigned int GetCollisionContactCount(const std::string& collision) const;

protected:
  bool UpdateImpl(bool force) override;

private:
  std::vector<std::string> collisions_;  // scoped
  mutable std::mutex mutex_;
  msgs::Contacts contacts_;
};

}  // namespace sensors
}  // namespace gazebo
