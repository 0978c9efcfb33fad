#pragma once
#include <gazebo/common/Plugin.hh>
#include <gazebo/sensors/ImuSensor.hh>
#include <gazebo/physics/physics.hh>
#include <gazebo/sensors/sensors.hh>

namespace gazebo
{

/// To be derived from: OnUpdate() is called at each measurement of the IMU that it stands in.
class GAZEBO_VISIBLE ImuSensorPlugin : public SensorPlugin
{
public:
  void Load(sensors::SensorPtr sensor, sdf::ElementPtr sdf) override;

protected:
  virtual void OnUpdate(sensors::ImuSensorPtr) {}
  sensors::ImuSensorPtr parentSensor;

private:
  event::ConnectionPtr connection_;
};

}  // namespace gazebo
