#pragma once
#include <string>

#include <gazebo/common/Plugin.hh>
#include <gazebo/sensors/GpuRaySensor.hh>

namespace gazebo
{

/// To be derived from: OnNewLaserFrame() is called at each scan, with range (m), intensity and 0 of each ray.
class GAZEBO_VISIBLE GpuRayPlugin : public SensorPlugin
{
public:
  void Load(sensors::SensorPtr sensor, sdf::ElementPtr sdf) override;
  virtual void OnNewLaserFrame(const float* data, unsigned int width, unsigned int height, unsigned int depth,
                               const std::string& format);

protected:
  unsigned int width = 0, height = 0, depth = 0;
  std::string format;
  sensors::GpuRaySensorPtr parentSensor;

private:
  event::ConnectionPtr connection_;
};

}  // namespace gazebo
