// Rays: the fan, and the sensors made of it.
#include <gazebo/sensors/sensors.hh>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <gazebo/physics/ode/ODERayShape.hh>
#include <gazebo/physics/physics.hh>
#include <gazebo/transport/transport.hh>

#include "contacts.hpp"
#include "convert.hpp"
#include "mirror.hpp"
#include "ray_fan.hpp"
#include "sdf_text.hpp"

namespace gazebo
{
namespace physics
{

using ignition::math::Pose3d;
using ignition::math::Vector3d;

namespace
{

using Scan = MultiRayShape::Scan;

Scan read_scan(const sdf::ElementPtr& sdf, int samples)
{
  Scan scan;
  scan.samples = samples;
  if (!sdf)
    return scan;
  const auto get = [&](const char* tag, double fallback) { return sdf->HasElement(tag) ? sdf->Get<double>(tag) : fallback; };
  scan.resolution = get("resolution", 1), scan.min = get("min_angle", 0), scan.max = get("max_angle", 0);
  scan.samples = static_cast<int>(std::clamp(get("samples", samples), 1.0, 2e9));
  return scan;
}

ode_sim::RayScan law(const Scan& scan) { return { scan.samples, scan.resolution, scan.min, scan.max }; }

}  // namespace

MultiRayShape::MultiRayShape(const Scan& horizontal, const Scan& vertical, double min, double max)
  : Shape(CollisionPtr(), MULTIRAY_SHAPE)
  , horizontal_(horizontal)
  , vertical_(vertical)
  , min_(min)
  , max_(max)
  , fan_(new ode_sim::RayFan(law(horizontal), law(vertical), min, max))
{
  ranges_.assign(fan_->rays(), max);
  retros_.assign(fan_->rays(), 0);
}

MultiRayShape::MultiRayShape(CollisionPtr parent) : Shape(parent, MULTIRAY_SHAPE) { collisionParent = parent; }
MultiRayShape::~MultiRayShape() = default;

void MultiRayShape::Load(sdf::ElementPtr sdf)
{
  Shape::Load(sdf);
  rayElem = inside(sdf, "ray");
  scanElem = inside(rayElem, "scan"), rangeElem = inside(rayElem, "range");
  horzElem = inside(scanElem, "horizontal"), vertElem = inside(scanElem, "vertical");
  horizontal_ = read_scan(horzElem, 640), vertical_ = read_scan(vertElem, 1);
  const auto get = [this](const char* tag, double otherwise) {
    return rangeElem && rangeElem->HasElement(tag) ? rangeElem->Get<double>(tag) : otherwise;
  };
  min_ = get("min", 0), max_ = get("max", 1000), resolution_ = get("resolution", 0);
}

void MultiRayShape::Init()
{
  if (fan_ || !scanElem)
    return;
  offset = collisionParent ? collisionParent->RelativePose() : Pose3d();
  const ode_sim::RayFan fan(law(horizontal_), law(vertical_), min_, max_);
  for (const ode_sim::Vec3& direction : fan.directions())
  {
    const Vector3d axis = offset.Rot() * ign(direction);
    AddRay(axis * min_ + offset.Pos(), axis * max_ + offset.Pos());
  }
}

void MultiRayShape::AddRay(const Vector3d& start, const Vector3d& end)
{
  const RayShapePtr ray(new RayShape(collisionParent));
  ray->SetPoints(start, end);
  rays.push_back(ray);
}

bool MultiRayShape::SetRay(unsigned int index, const Vector3d& start, const Vector3d& end)
{
  if (index >= rays.size())
    return false;
  rays[index]->SetPoints(start, end);
  return true;
}

unsigned int MultiRayShape::RayCount() const { return static_cast<unsigned int>(fan_ ? ranges_.size() : rays.size()); }

double MultiRayShape::GetRange(unsigned int index) const
{
  if (fan_)
    return index < ranges_.size() ? ranges_[index] : 0;
  return index < rays.size() ? min_ + rays[index]->GetLength() : 0;
}

double MultiRayShape::GetRetro(unsigned int index) const
{
  if (fan_)
    return index < retros_.size() ? retros_[index] : 0;
  return index < rays.size() ? rays[index]->GetRetro() : 0;
}

void MultiRayShape::Update()
{
  if (fan_)
    return;  // Cast() does it
  for (const RayShapePtr& ray : rays)
  {
    ray->SetLength(max_ - min_);
    ray->SetRetro(0);
    if (ODERayShape* const geom = dynamic_cast<ODERayShape*>(ray.get()))
      geom->Update();
  }
  UpdateRays();
  newLaserScans();
}

void MultiRayShape::UpdateRays()
{
  std::vector<double> origins, directions, ranges(rays.size());
  std::vector<int32_t> hits(rays.size());
  double longest = 0;
  for (const RayShapePtr& ray : rays)
  {
    Vector3d start, end;
    ray->GlobalPoints(start, end);
    const Vector3d way = (end - start).Normalized();
    longest = std::max(longest, end.Distance(start));
    origins.insert(origins.end(), { start.X(), start.Y(), start.Z() });
    directions.insert(directions.end(), { way.X(), way.Y(), way.Z() });
  }
  const boost::recursive_mutex::scoped_lock lock(step_mutex());
  ode_sim::cast_rays(Mirror::Get().GetWorld()->Core()->scene(), origins.data(), directions.data(),
                     static_cast<int>(rays.size()), longest, {}, ranges.data(), hits.data());
  for (std::size_t i = 0; i < rays.size(); ++i)
  {
    const Collision* const hit = hits[i] >= 0 ? collision_of(hits[i]) : nullptr;
    if (!hit || ranges[i] >= rays[i]->GetLength())
      continue;
    rays[i]->SetLength(ranges[i]);
    rays[i]->SetRetro(hit->GetLaserRetro());
  }
}

void MultiRayShape::Cast(const Pose3d& X_WS, const ModelPtr& own)
{
  std::vector<int> housing;
  if (own)
    for (const LinkPtr& link : own->GetLinks())
      for (const CollisionPtr& collision : link->GetCollisions())
        housing.push_back(collision->Core()->id);
  std::vector<int32_t> hits(fan_->rays());
  fan_->cast(Mirror::Get().GetWorld()->Core()->scene(), ode(X_WS), housing, ranges_.data(), hits.data());
  for (std::size_t i = 0; i < hits.size(); ++i)
  {
    const Collision* const hit = hits[i] >= 0 ? collision_of(hits[i]) : nullptr;
    retros_[i] = hit ? hit->GetLaserRetro() : 0;
  }
  newLaserScans();
}

}  // namespace physics

namespace sensors
{

RaySensor::RaySensor() : Sensor(RAY) {}
RaySensor::~RaySensor() = default;
bool RaySensor::IsActive() const { return Sensor::IsActive() || shape_->Listeners(); }

void RaySensor::Load(const std::string& world)
{
  Sensor::Load(world);
  // Without a <ray> it is there, as in Gazebo, and reaches nothing: plugins that make rays of their own stand in such.
  const sdf::ElementPtr ray = inside(sdf, sdf->HasElement("ray") ? "ray" : "lidar");
  const sdf::ElementPtr scan = inside(ray, "scan"), range = inside(ray, "range");
  const physics::Scan horizontal = physics::read_scan(inside(scan, "horizontal"), 640);
  const physics::Scan vertical = physics::read_scan(inside(scan, "vertical"), 1);
  const double min = range ? range->Get<double>("min") : 0;
  const double max = range ? range->Get<double>("max") : ray ? 0 : 1e-6;
  range_resolution_ = range && range->HasElement("resolution") ? range->Get<double>("resolution") : 0;
  shape_.reset(new physics::MultiRayShape(horizontal, vertical, min, max));
  const ode_sim::RayScan &across = shape_->Fan().horizontal(), &up = shape_->Fan().vertical();
  scan_.set_frame(ParentName());
  scan_.set_angle_min(horizontal.min), scan_.set_angle_max(horizontal.max), scan_.set_angle_step(across.step());
  scan_.set_vertical_angle_min(vertical.min), scan_.set_vertical_angle_max(vertical.max);
  scan_.set_vertical_angle_step(up.step());
  scan_.set_range_min(min), scan_.set_range_max(max);
  scan_.set_count(across.count()), scan_.set_vertical_count(up.count());
  msgs::Set(scan_.mutable_world_pose(), pose);
  noiseFrom(ray, RAY_NOISE);
  topic_ = topicOf("/scan");
  publisher_ = node->Advertise<msgs::LaserScanStamped>(topic_, 50);
}

bool RaySensor::UpdateImpl(bool)
{
  const physics::LinkPtr on = link();
  if (!on)
    return false;
  const ignition::math::Pose3d X_WS = worldPose();
  shape_->Cast(X_WS, on->GetModel());
  const ode_sim::RayFan& fan = shape_->Fan();
  std::vector<double> ranges(fan.values()), retros(fan.values());
  fan.between(shape_->Ranges().data(), ranges.data());
  fan.mean(shape_->Retros().data(), retros.data());
  const NoisePtr noise = Noise(RAY_NOISE);
  msgs::LaserScanStamped message;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    msgs::Set(scan_.mutable_world_pose(), X_WS);
    scan_.clear_ranges(), scan_.clear_intensities();
    for (std::size_t i = 0; i < ranges.size(); ++i)
    {
      double range = fan.told(ranges[i]);
      if (noise && std::isfinite(range))
        range = std::clamp(noise->Apply(range), RangeMin(), RangeMax());
      scan_.add_ranges(range);
      scan_.add_intensities(retros[i]);
    }
    msgs::Set(message.mutable_time(), lastMeasurementTime);
    if (listened())
      *message.mutable_scan() = scan_;
  }
  if (listened())
    publisher_->Publish(message);
  return true;
}

double RaySensor::Range(unsigned int index) const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return index < static_cast<unsigned int>(scan_.ranges_size()) ? scan_.ranges(static_cast<int>(index)) : 0;
}

void RaySensor::Ranges(std::vector<double>& ranges) const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  ranges.assign(scan_.ranges().begin(), scan_.ranges().end());
}

double RaySensor::Retro(unsigned int index) const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return index < static_cast<unsigned int>(scan_.intensities_size()) ? scan_.intensities(static_cast<int>(index)) : 0;
}

bool GpuRaySensor::UpdateImpl(bool force)
{
  if (!RaySensor::UpdateImpl(force))
    return false;
  if (!frames_.ConnectionCount())
    return true;
  std::vector<float> data;
  for (int i = 0; i < scan_.ranges_size(); ++i)
    data.insert(data.end(), { static_cast<float>(scan_.ranges(i)), static_cast<float>(scan_.intensities(i)), 0.0f });
  frames_(data.data(), scan_.count(), scan_.vertical_count(), 3u, std::string("FLOAT32"));
  return true;
}

}  // namespace sensors
}  // namespace gazebo
