// Sensors of what stands in a cone or pyramid before them.
#include <gazebo/sensors/sensors.hh>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <gazebo/physics/physics.hh>
#include <gazebo/transport/transport.hh>

#include "mirror.hpp"
#include "sdf_text.hpp"

namespace gazebo
{
namespace sensors
{

using ignition::math::Pose3d;
using ignition::math::Vector3d;
using Lock = std::lock_guard<std::mutex>;

namespace
{

double number(const sdf::ElementPtr& sdf, const char* tag, double fallback)
{
  return sdf && sdf->HasElement(tag) ? sdf->Get<double>(tag) : fallback;
}

/// Whether some of the box is before each of the pyramid's six planes: what is outside one with all its corners cannot be seen.
bool reaches_into(const ignition::math::AxisAlignedBox& box, const Pose3d& X_WC, double near, double far, double width,
                  double height)
{
  if (!std::isfinite((box.Max() - box.Min()).SquaredLength()))  // nothing to collide with, or a plane without end
    return false;
  bool inside[6] = {};
  for (int corner = 0; corner < 8; ++corner)
  {
    const Vector3d p_W(corner & 1 ? box.Max().X() : box.Min().X(), corner & 2 ? box.Max().Y() : box.Min().Y(),
                       corner & 4 ? box.Max().Z() : box.Min().Z());
    const Vector3d p = X_WC.Rot().RotateVectorReverse(p_W - X_WC.Pos());  // x ahead, y left, z up
    const bool here[6] = { p.X() >= near,           p.X() <= far,
                           p.Y() <= p.X() * width,  p.Y() >= -p.X() * width,
                           p.Z() <= p.X() * height, p.Z() >= -p.X() * height };
    for (int k = 0; k < 6; ++k)
      inside[k] = inside[k] || here[k];
  }
  return std::all_of(std::begin(inside), std::end(inside), [](bool any) { return any; });
}

}  // namespace

// -- sonar --------------------------------------------------------------------------------------------------------------------------

SonarSensor::SonarSensor() : Sensor(OTHER) {}
SonarSensor::~SonarSensor() = default;

void SonarSensor::Load(const std::string& world)
{
  Sensor::Load(world);
  const sdf::ElementPtr sonar = inside(sdf, "sonar");
  const double min = number(sonar, "min", 0), max = number(sonar, "max", 1), radius = number(sonar, "radius", 0.5);
  if (!(min >= 0 && min < max && max <= 1e7 && radius >= 0 && radius <= 1e7))
    throw std::runtime_error("<min>, <max> or <radius> of its <sonar> is not possible");
  if (sonar && sonar->HasElement("geometry") && sonar->Get<std::string>("geometry") != "cone")
    throw std::runtime_error("the <geometry> of a <sonar> is a cone here");
  constexpr int rings = 8;
  directions_.emplace_back(0, 0, -1);
  for (int ring = 1; ring <= rings; ++ring)
    for (int i = 0; i < 6 * ring; ++i)
    {
      const double angle = i * M_PI / (3 * ring), out = radius * ring / rings;
      directions_.push_back(Vector3d(out * std::cos(angle), out * std::sin(angle), -max).Normalized());
    }
  msgs::Sonar& told = *message_.mutable_sonar();
  told.set_frame(ParentName()), told.set_geometry("cone");
  told.set_range_min(min), told.set_range_max(max), told.set_radius(radius), told.set_range(max);
  msgs::Set(told.mutable_world_pose(), worldPose());
  msgs::Set(message_.mutable_time(), common::Time());
  topic_ = topicOf("/sonar");
  publisher_ = node->Advertise<msgs::SonarStamped>(topic_, 50);
}

bool SonarSensor::UpdateImpl(bool)
{
  const physics::LinkPtr on = link();
  if (!on)
    return false;
  std::vector<int> own;
  for (const physics::LinkPtr& each : on->GetModel()->GetLinks())
    for (const physics::CollisionPtr& collision : each->GetCollisions())
      own.push_back(collision->Core()->id);
  const Pose3d X_WS = worldPose();
  const std::size_t n = directions_.size();
  std::vector<double> origins(3 * n), ways(3 * n), far(n);
  std::vector<int32_t> hits(n);
  for (std::size_t i = 0; i < n; ++i)
  {
    const Vector3d way = X_WS.Rot().RotateVector(directions_[i]), from = X_WS.Pos() + RangeMin() * way;
    for (int k = 0; k < 3; ++k)
      origins[3 * i + k] = from[k], ways[3 * i + k] = way[k];
  }
  const ode_sim::Scene& scene = physics::Mirror::Get().GetWorld()->Core()->scene();
  ode_sim::cast_rays(scene, origins.data(), ways.data(), static_cast<int>(n), RangeMax() - RangeMin(), own, far.data(),
                     hits.data());
  const std::size_t nearest = static_cast<std::size_t>(std::min_element(far.begin(), far.end()) - far.begin());
  msgs::SonarStamped now;
  {
    const Lock lock(mutex_);
    msgs::Sonar& told = *message_.mutable_sonar();
    const bool seen = hits[nearest] >= 0 && std::isfinite(far[nearest]);
    told.set_range(seen ? RangeMin() + far[nearest] : RangeMax());
    told.clear_contact();
    if (seen)
      msgs::Set(told.mutable_contact(), X_WS.Pos() + told.range() * X_WS.Rot().RotateVector(directions_[nearest]));
    msgs::Set(told.mutable_world_pose(), X_WS);
    msgs::Set(message_.mutable_time(), lastMeasurementTime);
    now = message_;
  }
  measured_(now);
  if (listened())
    publisher_->Publish(now);
  return true;
}

double SonarSensor::Range() const
{
  const Lock lock(mutex_);
  return message_.sonar().range();
}

// -- logical camera -----------------------------------------------------------------------------------------------------------------

LogicalCameraSensor::LogicalCameraSensor() : Sensor(OTHER) {}
LogicalCameraSensor::~LogicalCameraSensor() = default;

void LogicalCameraSensor::Load(const std::string& world)
{
  Sensor::Load(world);
  const sdf::ElementPtr camera = inside(sdf, "logical_camera");
  near_ = number(camera, "near", near_), far_ = number(camera, "far", far_);
  fov_ = number(camera, "horizontal_fov", fov_), aspect_ = number(camera, "aspect_ratio", aspect_);
  if (!(near_ >= 0 && near_ < far_ && fov_ > 0 && fov_ < M_PI && aspect_ > 0))
    throw std::runtime_error("<near>, <far>, <horizontal_fov> or <aspect_ratio> of its <logical_camera> is not possible");
  msgs::Set(message_.mutable_pose(), worldPose());
  topic_ = topicOf("/models");
  publisher_ = node->Advertise<msgs::LogicalCameraImage>(topic_, 50);
}

bool LogicalCameraSensor::UpdateImpl(bool)
{
  const physics::LinkPtr on = link();
  if (!on)
    return false;
  const Pose3d X_WC = worldPose();
  const double width = std::tan(fov_ / 2), height = width / aspect_;  // of half of what it sees, 1 m ahead
  msgs::LogicalCameraImage now;
  msgs::Set(now.mutable_pose(), X_WC);
  for (const physics::ModelPtr& model : physics::get_world()->Models())
  {
    if (model == on->GetModel() || !reaches_into(model->BoundingBox(), X_WC, near_, far_, width, height))
      continue;
    msgs::LogicalCameraImage::Model& seen = *now.add_model();
    seen.set_name(model->GetScopedName());
    msgs::Set(seen.mutable_pose(), model->WorldPose() - X_WC);
  }
  {
    const Lock lock(mutex_);
    message_ = now;
  }
  if (listened())
    publisher_->Publish(now);
  return true;
}

msgs::LogicalCameraImage LogicalCameraSensor::Image() const
{
  const Lock lock(mutex_);
  return message_;
}

}  // namespace sensors
}  // namespace gazebo
