// Rays: the fan, and the sensors made of it.
#include <gazebo/sensors/sensors.hh>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <gazebo/physics/physics.hh>
#include <gazebo/transport/transport.hh>

#include "contacts.hpp"
#include "mirror.hpp"
#include "sdf_text.hpp"

namespace gazebo
{
namespace physics
{

using ignition::math::Pose3d;
using ignition::math::Vector3d;

MultiRayShape::MultiRayShape(const Scan& horizontal, const Scan& vertical, double min, double max)
  : Shape(CollisionPtr(), MULTIRAY_SHAPE)
  , horizontal_(horizontal)
  , vertical_(vertical)
  , min_(min)
  , max_(max)
{
  for (int row = 0; row < vertical.samples; ++row)
    for (int column = 0; column < horizontal.samples; ++column)
    {
      const double pitch = vertical.angle(row), yaw = horizontal.angle(column);
      directions_.emplace_back(std::cos(pitch) * std::cos(yaw), std::cos(pitch) * std::sin(yaw), std::sin(pitch));
    }
  ranges_.assign(directions_.size(), max);
  retros_.assign(directions_.size(), 0);
}

void MultiRayShape::Cast(const Pose3d& X_WS, const ModelPtr& own)
{
  const ode_sim::Scene& scene = Mirror::Get().GetWorld()->Core()->scene();
  const std::size_t n = directions_.size();
  std::vector<double> origins(3 * n), centres(3 * n), ways(3 * n), far(n), near(n, std::numeric_limits<double>::infinity());
  std::vector<int32_t> hits(n), near_hits(n);
  for (std::size_t i = 0; i < n; ++i)
  {
    // From the near limit on, so that what stands inside it (the robot's own housing) does not hide the world.
    const Vector3d way = X_WS.Rot().RotateVector(directions_[i]), from = X_WS.Pos() + min_ * way;
    for (int k = 0; k < 3; ++k)
      origins[3 * i + k] = from[k], centres[3 * i + k] = X_WS.Pos()[k], ways[3 * i + k] = way[k];
  }
  ode_sim::cast_rays(scene, origins.data(), ways.data(), static_cast<int>(n), max_ - min_, {}, far.data(), hits.data());
  if (min_ > 0)
  {
    std::vector<int> housing;
    if (own)
      for (const LinkPtr& link : own->GetLinks())
        for (const CollisionPtr& collision : link->GetCollisions())
          housing.push_back(collision->Core()->id);
    ode_sim::cast_rays(scene, centres.data(), ways.data(), static_cast<int>(n), min_, housing, near.data(), near_hits.data());
  }
  for (std::size_t i = 0; i < n; ++i)
  {
    ranges_[i] = std::isfinite(near[i]) ? min_ : std::min(min_ + far[i], max_);
    const Collision* const hit = hits[i] >= 0 ? collision_of(hits[i]) : nullptr;
    retros_[i] = hit ? hit->GetLaserRetro() : 0;
  }
  scanned_();
}

}  // namespace physics

namespace sensors
{

namespace
{

constexpr double most_rays = 1e6;
using Scan = physics::MultiRayShape::Scan;

Scan read_scan(const sdf::ElementPtr& sdf, int samples)
{
  Scan scan;
  scan.samples = samples;
  if (!sdf)
    return scan;
  const auto get = [&](const char* tag, double fallback) { return sdf->HasElement(tag) ? sdf->Get<double>(tag) : fallback; };
  const double count = get("samples", samples);
  scan.resolution = get("resolution", 1), scan.min = get("min_angle", 0), scan.max = get("max_angle", 0);
  if (!(scan.resolution > 0) || !(count * std::max(1.0, scan.resolution) <= most_rays))
    throw std::runtime_error("<samples> and <resolution> of its <scan> are not possible");
  scan.samples = std::max(1, static_cast<int>(count));
  return scan;
}

int reported_count(const Scan& scan) { return std::max(1, static_cast<int>(scan.samples * scan.resolution)); }
double step(const Scan& scan, int count) { return count > 1 ? (scan.max - scan.min) / (count - 1) : 0; }

}  // namespace

RaySensor::RaySensor() : Sensor(RAY) {}
RaySensor::~RaySensor() = default;
bool RaySensor::IsActive() const { return Sensor::IsActive() || shape_->Listeners(); }

void RaySensor::Load(const std::string& world)
{
  Sensor::Load(world);
  const sdf::ElementPtr ray = inside(sdf, sdf->HasElement("ray") ? "ray" : "lidar");
  if (!ray)
    throw std::runtime_error("it has no <ray> block");
  const sdf::ElementPtr scan = inside(ray, "scan"), range = inside(ray, "range");
  const Scan horizontal = read_scan(inside(scan, "horizontal"), 640), vertical = read_scan(inside(scan, "vertical"), 1);
  const double min = range ? range->Get<double>("min") : 0, max = range ? range->Get<double>("max") : 0;
  if (!(min >= 0 && min < max) || static_cast<double>(horizontal.samples) * vertical.samples > most_rays)
    throw std::runtime_error("its <range> or its number of rays is not possible");
  range_resolution_ = range->HasElement("resolution") ? range->Get<double>("resolution") : 0;
  shape_.reset(new physics::MultiRayShape(horizontal, vertical, min, max));
  const int columns = reported_count(horizontal), rows = reported_count(vertical);
  scan_.set_frame(ParentName());
  scan_.set_angle_min(horizontal.min), scan_.set_angle_max(horizontal.max), scan_.set_angle_step(step(horizontal, columns));
  scan_.set_vertical_angle_min(vertical.min), scan_.set_vertical_angle_max(vertical.max);
  scan_.set_vertical_angle_step(step(vertical, rows));
  scan_.set_range_min(min), scan_.set_range_max(max);
  scan_.set_count(columns), scan_.set_vertical_count(rows);
  msgs::Set(scan_.mutable_world_pose(), pose);
  noiseFrom(ray, RAY_NOISE);
  topic_ = topicOf("/scan");
  publisher_ = node->Advertise<msgs::LaserScanStamped>(topic_, 50);
}

/// Of reported row and column, between the rays around it where <resolution> is not 1.
double RaySensor::reported(const std::vector<double>& rays, int row, int column, bool nearest) const
{
  const int width = RayCount(), height = VerticalRayCount();
  const auto place = [](int i, int reported, int rays) { return reported > 1 ? i * (rays - 1.0) / (reported - 1) : 0.0; };
  double x = place(column, RangeCount(), width), y = place(row, VerticalRangeCount(), height);
  if (nearest)
    x = std::round(x), y = std::round(y);
  const int left = static_cast<int>(x), low = static_cast<int>(y);
  const double u = x - left, v = y - low;
  const auto at = [&](int r, int c) { return rays[std::min(r, height - 1) * width + std::min(c, width - 1)]; };
  const auto between = [](double a, double b, double w) { return w == 0 ? a : (1 - w) * a + w * b; };
  return between(between(at(low, left), at(low, left + 1), u), between(at(low + 1, left), at(low + 1, left + 1), u), v);
}

bool RaySensor::UpdateImpl(bool)
{
  const physics::LinkPtr on = link();
  if (!on)
    return false;
  const ignition::math::Pose3d X_WS = worldPose();
  shape_->Cast(X_WS, on->GetModel());
  std::vector<double> ranges, retros;
  for (unsigned int i = 0; i < shape_->RayCount(); ++i)
    ranges.push_back(shape_->GetRange(i)), retros.push_back(shape_->GetRetro(i));
  const NoisePtr noise = Noise(RAY_NOISE);
  const double infinity = std::numeric_limits<double>::infinity();
  msgs::LaserScanStamped message;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    msgs::Set(scan_.mutable_world_pose(), X_WS);
    scan_.clear_ranges(), scan_.clear_intensities();
    for (int row = 0; row < VerticalRangeCount(); ++row)
      for (int column = 0; column < RangeCount(); ++column)
      {
        double range = reported(ranges, row, column, false);
        if (range >= RangeMax())
          range = infinity;
        else if (range <= RangeMin())
          range = -infinity;
        else if (noise)
          range = std::clamp(noise->Apply(range), RangeMin(), RangeMax());
        scan_.add_ranges(range);
        scan_.add_intensities(reported(retros, row, column, true));
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
