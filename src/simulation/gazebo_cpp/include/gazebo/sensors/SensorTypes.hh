#pragma once
#include <memory>
#include <vector>

#include <gazebo/util/system.hh>

namespace gazebo
{
namespace sensors
{
#define GZ_SENSOR(name)                    \
  class name;                              \
  typedef std::shared_ptr<name> name##Ptr; \
  typedef std::vector<name##Ptr> name##_V;
GZ_SENSOR(Sensor)
GZ_SENSOR(RaySensor)
GZ_SENSOR(CameraSensor)
GZ_SENSOR(MultiCameraSensor)
GZ_SENSOR(DepthCameraSensor)
GZ_SENSOR(WideAngleCameraSensor)
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
GZ_SENSOR(GaussianNoiseModel)
#undef GZ_SENSOR

enum SensorCategory
{
  IMAGE = 0,
  RAY = 1,
  OTHER = 2,
  CATEGORY_COUNT = 3
};

/// Which value of a sensor a noise is for.
enum SensorNoiseType
{
  SENSOR_NOISE_TYPE_BEGIN = 0,
  NO_NOISE = SENSOR_NOISE_TYPE_BEGIN,
  CAMERA_NOISE,
  GPU_RAY_NOISE,
  GPS_POSITION_LATITUDE_NOISE_METERS,
  GPS_POSITION_LONGITUDE_NOISE_METERS,
  GPS_POSITION_ALTITUDE_NOISE_METERS,
  GPS_VELOCITY_LATITUDE_NOISE_METERS,
  GPS_VELOCITY_LONGITUDE_NOISE_METERS,
  GPS_VELOCITY_ALTITUDE_NOISE_METERS,
  RAY_NOISE,
  MAGNETOMETER_X_NOISE_TESLA,
  MAGNETOMETER_Y_NOISE_TESLA,
  MAGNETOMETER_Z_NOISE_TESLA,
  FORCE_TORQUE_NOISE,
  ALTIMETER_POSITION_NOISE_METERS,
  ALTIMETER_VELOCITY_NOISE_METERS_PER_S,
  IMU_ANGVEL_X_NOISE_RADIANS_PER_S,
  IMU_ANGVEL_Y_NOISE_RADIANS_PER_S,
  IMU_ANGVEL_Z_NOISE_RADIANS_PER_S,
  IMU_LINACC_X_NOISE_METERS_PER_S_SQR,
  IMU_LINACC_Y_NOISE_METERS_PER_S_SQR,
  IMU_LINACC_Z_NOISE_METERS_PER_S_SQR,
  SENSOR_NOISE_TYPE_END
};
}  // namespace sensors
}  // namespace gazebo
