#pragma once
#include <memory>
#include <vector>

#include <gazebo/util/system.hh>

namespace gazebo
{
namespace sensors
{
#define GZ_SENSOR(name) \
  class name; \
  typedef std::shared_ptr<name> name##Ptr; \
  typedef std::vector<name##Ptr> name##_V;
GZ_SENSOR(Sensor)
GZ_SENSOR(RaySensor)
GZ_SENSOR(CameraSensor)
GZ_SENSOR(MultiCameraSensor)
GZ_SENSOR(DepthCameraSensor)
GZ_SENSOR(ContactSensor)
GZ_SENSOR(ImuSensor)
GZ_SENSOR(GpuRaySensor)
GZ_SENSOR(GpsSensor)
GZ_SENSOR(SonarSensor)
GZ_SENSOR(ForceTorqueSensor)
GZ_SENSOR(AltimeterSensor)
GZ_SENSOR(MagnetometerSensor)
GZ_SENSOR(LogicalCameraSensor)
GZ_SENSOR(RFIDSensor)
GZ_SENSOR(RFIDTag)
GZ_SENSOR(WirelessReceiver)
GZ_SENSOR(WirelessTransmitter)
GZ_SENSOR(Noise)
#undef GZ_SENSOR
}  // namespace sensors
}  // namespace gazebo
