// Inertial measurement units.
#pragma once

#include <string>

#include <hardware_interface/internal/hardware_resource_manager.h>

namespace hardware_interface
{

/// Points to the measurements of one unit; a null pointer stands for what it does not measure.
class ImuSensorHandle
{
public:
  /// Covariances are nine numbers, row by row.
  struct Data
  {
    Data()
      : orientation(nullptr)
      , orientation_covariance(nullptr)
      , angular_velocity(nullptr)
      , angular_velocity_covariance(nullptr)
      , linear_acceleration(nullptr)
      , linear_acceleration_covariance(nullptr)
    {
    }

    std::string name;      ///< of the sensor
    std::string frame_id;  ///< tf frame of the measurements
    double* orientation;   ///< x y z w
    double* orientation_covariance;
    double* angular_velocity;  ///< rad/s
    double* angular_velocity_covariance;
    double* linear_acceleration;  ///< m/s^2
    double* linear_acceleration_covariance;
  };

  ImuSensorHandle(const Data& data = Data())
    : name_(data.name)
    , frame_id_(data.frame_id)
    , orientation_(data.orientation)
    , orientation_covariance_(data.orientation_covariance)
    , angular_velocity_(data.angular_velocity)
    , angular_velocity_covariance_(data.angular_velocity_covariance)
    , linear_acceleration_(data.linear_acceleration)
    , linear_acceleration_covariance_(data.linear_acceleration_covariance)
  {
  }

  ImuSensorHandle(const std::string& name, const std::string& frame_id, const double* orientation,
                  const double* orientation_covariance, const double* angular_velocity,
                  const double* angular_velocity_covariance, const double* linear_acceleration,
                  const double* linear_acceleration_covariance)
    : name_(name)
    , frame_id_(frame_id)
    , orientation_(orientation)
    , orientation_covariance_(orientation_covariance)
    , angular_velocity_(angular_velocity)
    , angular_velocity_covariance_(angular_velocity_covariance)
    , linear_acceleration_(linear_acceleration)
    , linear_acceleration_covariance_(linear_acceleration_covariance)
  {
  }

  std::string getName() const { return name_; }
  std::string getFrameId() const { return frame_id_; }
  const double* getOrientation() const { return orientation_; }
  const double* getOrientationCovariance() const { return orientation_covariance_; }
  const double* getAngularVelocity() const { return angular_velocity_; }
  const double* getAngularVelocityCovariance() const { return angular_velocity_covariance_; }
  const double* getLinearAcceleration() const { return linear_acceleration_; }
  const double* getLinearAccelerationCovariance() const { return linear_acceleration_covariance_; }

private:
  std::string name_;
  std::string frame_id_;
  const double* orientation_;
  const double* orientation_covariance_;
  const double* angular_velocity_;
  const double* angular_velocity_covariance_;
  const double* linear_acceleration_;
  const double* linear_acceleration_covariance_;
};

/// Taking a handle claims nothing.
class ImuSensorInterface : public HardwareResourceManager<ImuSensorHandle>
{
};

}  // namespace hardware_interface
