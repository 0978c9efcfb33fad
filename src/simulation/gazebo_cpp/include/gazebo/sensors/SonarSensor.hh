#pragma once
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include <gazebo/sensors/Sensor.hh>

namespace gazebo
{
namespace sensors
{

/// <sonar>: how far it is to the nearest thing in a cone (m). Its tip is the sensor, it opens along the sensor's -z up to <radius> at
/// <max>; where nothing is, the range is <max>. Measured along rays through the cone, so what is thinner than their gaps is not seen.
class GAZEBO_VISIBLE SonarSensor : public Sensor
{
public:
  SonarSensor();
  ~SonarSensor() override;
  void Load(const std::string& world) override;
  using Sensor::Load;
  bool IsActive() const override { return Sensor::IsActive() || measured_.ConnectionCount(); }
  double RangeMin() const { return message_.sonar().range_min(); }
  double RangeMax() const { return message_.sonar().range_max(); }
  double Radius() const { return message_.sonar().radius(); }
  double Range() const;
  event::ConnectionPtr ConnectUpdate(std::function<void(msgs::SonarStamped)> subscriber)
  {
    return measured_.Connect(subscriber);
  }

protected:
  bool UpdateImpl(bool force) override;

private:
  std::vector<ignition::math::Vector3d> directions_;  // in the sensor's frame
  mutable std::mutex mutex_;
  msgs::SonarStamped message_;
  event::EventT<void(msgs::SonarStamped)> measured_;
};

}  // namespace sensors
}  // namespace gazebo
