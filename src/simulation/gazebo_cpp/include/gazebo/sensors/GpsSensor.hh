#pragma once
#include <mutex>

#include <ignition/math/Angle.hh>
#include <ignition/math/Vector3.hh>

#include <gazebo/sensors/Sensor.hh>

namespace gazebo
{
namespace sensors
{

/// Place on the earth, by the world's <spherical_coordinates>.
class GAZEBO_VISIBLE GpsSensor : public Sensor
{
public:
  GpsSensor();
  ~GpsSensor() override;
  void Load(const std::string& world) override;
  using Sensor::Load;
  ignition::math::Angle Longitude() const;
  ignition::math::Angle Latitude() const;
  double Altitude() const;  // m
  ignition::math::Vector3d VelocityENU() const;
  double VelocityEast() const { return VelocityENU().X(); }
  double VelocityNorth() const { return VelocityENU().Y(); }
  double VelocityUp() const { return VelocityENU().Z(); }

protected:
  bool UpdateImpl(bool force) override;

private:
  mutable std::mutex mutex_;
  msgs::GPS message_;
};

}  // namespace sensors
}  // namespace gazebo
