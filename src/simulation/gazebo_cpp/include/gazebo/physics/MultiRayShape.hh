#pragma once
#include <functional>
#include <memory>
#include <vector>

#include <ignition/math/Angle.hh>
#include <ignition/math/Pose3.hh>

#include <gazebo/physics/Shape.hh>
#include <gazebo/physics/Collision.hh>

namespace gazebo
{
namespace physics
{

/// Many rays: a fan from a pose, rows from the lowest elevation, in a row from the smallest angle; or those that a plugin adds to a
/// collision, which may look for them itself. Angles in rad, ranges in m.
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
  /// \param parent rays are in its frame; the fan that Load() gets in a <ray> is added by Init()
  explicit MultiRayShape(CollisionPtr parent);
  ~MultiRayShape() override;
  void Load(sdf::ElementPtr sdf) override;
  void Init() override;
  /// \param X_WS where the fan stands
  /// \param own collisions of these models are looked through within the near limit
  void Cast(const ignition::math::Pose3d& X_WS, const ModelPtr& own);
  void Update() override;  // rays that were added: where they are, what they meet, then those who listen
  virtual void UpdateRays();
  virtual void AddRay(const ignition::math::Vector3d& start, const ignition::math::Vector3d& end);
  bool SetRay(unsigned int index, const ignition::math::Vector3d& start, const ignition::math::Vector3d& end);
  RayShapePtr Ray(unsigned int index) const { return index < rays.size() ? rays[index] : RayShapePtr(); }
  unsigned int RayCount() const;
  double GetRange(unsigned int index) const;  // min to max; max: nothing
  double GetRetro(unsigned int index) const;
  int GetFiducial(unsigned int) const { return -1; }
  double GetMinRange() const { return min_; }
  double GetMaxRange() const { return max_; }
  double GetResRange() const { return resolution_; }
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
    return newLaserScans.Connect(subscriber);
  }
  unsigned int Listeners() const { return newLaserScans.ConnectionCount(); }
  const ode_sim::RayFan& Fan() const { return *fan_; }
  const std::vector<double>& Ranges() const { return ranges_; }
  const std::vector<double>& Retros() const { return retros_; }

protected:
  std::vector<RayShapePtr> rays;
  ignition::math::Pose3d offset;
  sdf::ElementPtr rayElem, scanElem, horzElem, vertElem, rangeElem;
  event::EventT<void()> newLaserScans;

private:
  Scan horizontal_, vertical_;
  double min_ = 0, max_ = 1000, resolution_ = 0;
  std::unique_ptr<const ode_sim::RayFan> fan_;
  std::vector<double> ranges_, retros_;
};

}  // namespace physics
}  // namespace gazebo
