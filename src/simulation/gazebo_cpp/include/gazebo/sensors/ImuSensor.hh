#pragma once
#include <mutex>

#include <ignition/math/Quaternion.hh>
#include <ignition/math/Vector3.hh>

#include <gazebo/sensors/Sensor.hh>

namespace gazebo
{
namespace sensors
{

/// Rates (rad/s) and acceleration with the reaction to gravity (m/s^2) in the sensor's axes; orientation against a reference.
class GAZEBO_VISIBLE ImuSensor : public Sensor
{
public:
  ImuSensor();
  ~ImuSensor() override;
  void Load(const std::string& world) override;
  using Sensor::Load;
  msgs::IMU ImuMessage() const;
  ignition::math::Vector3d AngularVelocity(bool noise_free = false) const;
  ignition::math::Vector3d LinearAcceleration(bool noise_free = false) const;
  ignition::math::Quaterniond Orientation() const;
  void SetReferencePose();  // its orientation is the reference from now on
  void SetWorldToReferenceOrientation(const ignition::math::Quaterniond& orientation) { q_WR_ = orientation; }

protected:
  bool UpdateImpl(bool force) override;

private:
  mutable std::mutex mutex_;
  msgs::IMU message_;
  ignition::math::Vector3d rates_, acceleration_, last_velocity_;
  ignition::math::Quaterniond q_WR_;
  bool moved_ = false;
};

}  // namespace sensors
}  // namespace gazebo
