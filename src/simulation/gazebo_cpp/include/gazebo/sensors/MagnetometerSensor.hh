#pragma once
#include <mutex>

#include <ignition/math/Vector3.hh>

#include <gazebo/sensors/Sensor.hh>

namespace gazebo
{
namespace sensors
{

/// The world's magnetic field in the sensor's axes, T.
class GAZEBO_VISIBLE MagnetometerSensor : public Sensor
{
public:
  MagnetometerSensor();
  ~MagnetometerSensor() override;
  void Load(const std::string& world) override;
  using Sensor::Load;
  ignition::math::Vector3d MagneticField() const;

protected:
  bool UpdateImpl(bool force) override;

private:
  mutable std::mutex mutex_;
  msgs::Magnetometer message_;
};

}  // namespace sensors
}  // namespace gazebo
