#pragma once
#include <mutex>

#include <gazebo/sensors/Sensor.hh>

namespace gazebo
{
namespace sensors
{

/// Height (m) above the reference, which is where it was first, and vertical speed.
class GAZEBO_VISIBLE AltimeterSensor : public Sensor
{
public:
  AltimeterSensor();
  ~AltimeterSensor() override;
  void Load(const std::string& world) override;
  using Sensor::Load;
  double Altitude() const;
  double VerticalVelocity() const;
  double ReferenceAltitude() const;
  void SetReferenceAltitude(double altitude);

protected:
  bool UpdateImpl(bool force) override;

private:
  mutable std::mutex mutex_;
  msgs::Altimeter message_;
};

}  // namespace sensors
}  // namespace gazebo
