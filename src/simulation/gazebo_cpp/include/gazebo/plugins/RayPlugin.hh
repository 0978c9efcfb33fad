#pragma once
#include <gazebo/common/Plugin.hh>
#include <gazebo/physics/MultiRayShape.hh>
#include <gazebo/sensors/RaySensor.hh>

namespace gazebo
{

/// To be derived from: OnNewLaserScans() is called at each scan of the ray sensor that it stands in.
class GAZEBO_VISIBLE RayPlugin : public SensorPlugin
{
public:
  void Load(sensors::SensorPtr sensor, sdf::ElementPtr sdf) override;
  virtual void OnNewLaserScans() {}

protected:
  physics::WorldPtr world;
  sensors::RaySensorPtr parentSensor;

private:
  event::ConnectionPtr connection_;
};

}  // namespace gazebo
