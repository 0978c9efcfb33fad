#pragma once
#include <functional>
#include <memory>
#include <vector>

#include <ignition/math/Angle.hh>

#include <gazebo/physics/Shape.hh>

namespace gazebo
{
namespace physics
{

/// A fan of rays from a pose: rows from the lowest elevation, in a row from the smallest angle. Angles in rad, ranges in m.
class GAZEBO_VISIBLE MultiRayShape : public Shape
{
public:
  struct Scan
  {
    int samples = 1;
    double resolution = 1, min = 0, max = 0;
  };

  /// \throws std::invalid_argument numbers that make no fan
  MultiRayShape(const Scan& horizontal, const Scan& vertical, double min, double max);
  ~MultiRayShape() override;
  /// \param X_WS where the fan stands
  /// \param own collisions of these models are looked through within the near limit
  void Cast(const ignition::math::Pose3d& X_WS, const ModelPtr& own);
  void Update() override {}
  unsigned int RayCount() const { return static_cast<unsigned int>(ranges_.size()); }
  double GetRange(unsigned int index) const { return index < ranges_.size() ? ranges_[index] : 0; }  // min to max; max: nothing
  double GetRetro(unsigned int index) const { return index < retros_.size() ? retros_[index] : 0; }
  int GetFiducial(unsigned int) const { return -1; }
  double GetMinRange() const { return min_; }
  double GetMaxRange() const { return max_; }
  double GetResRange() const { return 0; }
  int GetSampleCount() const { return horizontal_.samples; }
  double GetScanResolution() const { return horizontal_.resolution; }
  ignition::math::Angle MinAngle() const { return horizontal_.min; }
  ignition::math::Angle MaxAngle() const { return horizontal_.max; }
  int GetVerticalSampleCount() const { return vertical_.samples; }
  double GetVerticalScanResolution() const { return vertical_.resolution; }
  ignition::math::Angle VerticalMinAngle() const { return vertical_.min; }
  ignition::math::Angle VerticalMaxAngle() const { return vertical_.max; }
  template <typename T>
  event::ConnectionPtr ConnectNewLaserScans(T subscriber)
  {
    return scanned_.Connect(subscriber);
  }
  unsigned int Listeners() const { return scanned_.ConnectionCount(); }
  const ode_sim::RayFan& Fan() const { return *fan_; }
  const std::vector<double>& Ranges() const { return ranges_; }
  const std::vector<double>& Retros() const { return retros_; }

private:
  Scan horizontal_, vertical_;
  double min_, max_;
  std::unique_ptr<const ode_sim::RayFan> fan_;
  std::vector<double> ranges_, retros_;
  event::EventT<void()> scanned_;
};

}  // namespace physics
}  // namespace gazebo
