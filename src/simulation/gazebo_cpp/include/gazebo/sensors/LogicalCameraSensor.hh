#pragma once
#include <mutex>
#include <string>

#include <ignition/math/Angle.hh>

#include <gazebo/sensors/Sensor.hh>

namespace gazebo
{
namespace sensors
{

/// <logical_camera>: names and poses (in the sensor's frame) of the other models whose boxes reach into what a camera there would see.
class GAZEBO_VISIBLE LogicalCameraSensor : public Sensor
{
public:
  LogicalCameraSensor();
  ~LogicalCameraSensor() override;
  void Load(const std::string& world) override;
  using Sensor::Load;
  double Near() const { return near_; }
  double Far() const { return far_; }
  ignition::math::Angle HorizontalFOV() const { return fov_; }
  double AspectRatio() const { return aspect_; }
  msgs::LogicalCameraImage Image() const;

protected:
  bool UpdateImpl(bool force) override;

private:
  double near_ = 0, far_ = 1, fov_ = 1.05, aspect_ = 1.33;
  mutable std::mutex mutex_;
  msgs::LogicalCameraImage message_;
};

}  // namespace sensors
}  // namespace gazebo
