#pragma once
#include <mutex>
#include <string>
#include <vector>

#include <ignition/math/Angle.hh>

#include <gazebo/physics/MultiRayShape.hh>
#include <gazebo/sensors/Sensor.hh>
#include <gazebo/transport/TransportTypes.hh>

namespace gazebo
{
namespace sensors
{

/// <ray>: distances to what the world's models collide with. Beyond the far limit +inf, up to the near one -inf.
class GAZEBO_VISIBLE RaySensor : public Sensor
{
public:
  RaySensor();
  ~RaySensor() override;
  void Load(const std::string& world) override;
  using Sensor::Load;
  bool IsActive() const override;
  ignition::math::Angle AngleMin() const { return scan_.angle_min(); }
  ignition::math::Angle AngleMax() const { return scan_.angle_max(); }
  double AngleResolution() const { return scan_.angle_step(); }
  ignition::math::Angle VerticalAngleMin() const { return scan_.vertical_angle_min(); }
  ignition::math::Angle VerticalAngleMax() const { return scan_.vertical_angle_max(); }
  double VerticalAngleResolution() const { return scan_.vertical_angle_step(); }
  double RangeMin() const { return scan_.range_min(); }
  double RangeMax() const { return scan_.range_max(); }
  double RangeResolution() const { return range_resolution_; }
  int RayCount() const { return shape_->GetSampleCount(); }
  int VerticalRayCount() const { return shape_->GetVerticalSampleCount(); }
  int RangeCount() const { return static_cast<int>(scan_.count()); }
  int VerticalRangeCount() const { return static_cast<int>(scan_.vertical_count()); }
  double RangeCountRatio() const { return static_cast<double>(RayCount()) / RangeCount(); }
  double Range(unsigned int index) const;
  void Ranges(std::vector<double>& ranges) const;
  double Retro(unsigned int index) const;
  int Fiducial(unsigned int) const { return -1; }
  physics::MultiRayShapePtr LaserShape() const { return shape_; }

protected:
  bool UpdateImpl(bool force) override;

  physics::MultiRayShapePtr shape_;
  mutable std::mutex mutex_;
  msgs::LaserScan scan_;
  double range_resolution_ = 0;
};

}  // namespace sensors
}  // namespace gazebo
