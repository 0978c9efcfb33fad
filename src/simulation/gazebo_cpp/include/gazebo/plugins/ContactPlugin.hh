#pragma once
#include <gazebo/common/Plugin.hh>
#include <gazebo/sensors/ContactSensor.hh>
#include <gazebo/physics/physics.hh>
#include <gazebo/sensors/sensors.hh>

namespace gazebo
{

/// To be derived from: OnUpdate() is called at each measurement of the contact sensor that it stands in.
class GAZEBO_VISIBLE ContactPlugin : public SensorPlugin
{
public:
  void Load(sensors::SensorPtr sensor, sdf::ElementPtr sdf) override;

protected:
  sensors::ContactSensorPtr parentSensor;

private:
  virtual void OnUpdate() {}
  event::ConnectionPtr connection_;
};

}  // namespace gazebo
