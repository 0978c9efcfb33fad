#include "ray_fan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "world.hpp"

namespace ode_sim {

namespace {

std::vector<Vec3> grid(const RayScan& horizontal, int columns, const RayScan& vertical, int rows) {
  const auto angle = [](const RayScan& s, int i, int n) {
    if (s.samples == 1) return 0.0;
    return n > 1 ? s.min_angle + i * ((s.max_angle - s.min_angle) / (n - 1)) : s.min_angle;
  };
  std::vector<Vec3> out;
  out.reserve(static_cast<size_t>(columns) * rows);
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const double pitch = angle(vertical, row, rows), yaw = angle(horizontal, column, columns);
      out.push_back({std::cos(pitch) * std::cos(yaw), std::cos(pitch) * std::sin(yaw), std::sin(pitch)});
    }
  return out;
}

void check(const RayScan& scan) {
  const double values = std::max(scan.samples, 1) * std::max(1.0, scan.resolution);
  if (!(scan.resolution > 0) || !(values <= RayFan::kMostRays))
    throw std::invalid_argument("<samples> and <resolution> of its <scan> make no count from 1 to a million");
  if (!std::isfinite(scan.min_angle) || !std::isfinite(scan.max_angle))
    throw std::invalid_argument("<min_angle> or <max_angle> of its <scan> is no number");
}

// The rays to both sides of value i of `told`, and how far it is from the first to the second.
struct Between {
  Between(int i, int told, int rays) {
    const double at = told > 1 ? i * (rays - 1.0) / (told - 1) : 0.0;
    first = static_cast<int>(at), second = std::min(first + 1, rays - 1), part = at - first;
  }
  int first, second;
  double part;
};

double linear(double a, double b, double part) { return part == 0 ? a : (1 - part) * a + part * b; }

}  // namespace

int RayScan::count() const { return std::max(1, static_cast<int>(samples * resolution)); }

RayFan::RayFan(const RayScan& horizontal, const RayScan& vertical, double min, double max)
    : horizontal_(horizontal), vertical_(vertical), min_(min), max_(max) {
  if (!(min >= 0 && min < max)) throw std::invalid_argument("its <range> needs a <min> from 0 to below its <max>");
  horizontal_.samples = std::max(1, horizontal.samples), vertical_.samples = std::max(1, vertical.samples);
  check(horizontal_), check(vertical_);
  const double rays = static_cast<double>(horizontal_.samples) * vertical_.samples,
               told = static_cast<double>(horizontal_.count()) * vertical_.count();
  if (std::max(rays, told) > kMostRays) throw std::invalid_argument("it has more than a million rays");
  directions_ = grid(horizontal_, horizontal_.samples, vertical_, vertical_.samples);
}

std::vector<Vec3> RayFan::told_directions() const {
  return grid(horizontal_, horizontal_.count(), vertical_, vertical_.count());
}

void RayFan::cast(const Scene& scene, const Pose& X_WS, const std::vector<int>& housing, double* ranges, int32_t* hits) const {
  const size_t n = rays();
  std::vector<double> origins(3 * n), ways(3 * n);
  const auto from = [&](double distance) {
    for (size_t i = 0; i < n; ++i) {
      const Vec3 way = rotate(X_WS.q, directions_[i]), origin = X_WS.p + way * distance;
      origins[3 * i] = origin.x, origins[3 * i + 1] = origin.y, origins[3 * i + 2] = origin.z;
      ways[3 * i] = way.x, ways[3 * i + 1] = way.y, ways[3 * i + 2] = way.z;
    }
  };
  from(min_);
  cast_rays(scene, origins.data(), ways.data(), static_cast<int>(n), max_ - min_, {}, ranges, hits);
  for (size_t i = 0; i < n; ++i) ranges[i] = std::min(min_ + ranges[i], max_);
  if (!(min_ > 0)) return;
  from(0);
  std::vector<double> near(n);
  std::vector<int32_t> which(n);
  if (cast_rays(scene, origins.data(), ways.data(), static_cast<int>(n), min_, housing, near.data(), which.data()) == 0) return;
  for (size_t i = 0; i < n; ++i)
    if (which[i] >= 0) ranges[i] = min_;
}

template <typename Blend>
void RayFan::blend(const double* rays, double* told, const Blend& of_four) const {
  const int columns = horizontal_.count(), rows = vertical_.count(), width = horizontal_.samples;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const Between x(column, columns, width), y(row, rows, vertical_.samples);
      const double *low = rays + y.first * width, *high = rays + y.second * width;
      *told++ = of_four(low[x.first], low[x.second], high[x.first], high[x.second], x.part, y.part);
    }
}

void RayFan::between(const double* ranges, double* told) const {
  blend(ranges, told,
        [](double a, double b, double c, double d, double x, double y) { return linear(linear(a, b, x), linear(c, d, x), y); });
}

void RayFan::mean(const double* intensities, double* told) const {
  if (one_to_one()) std::copy(intensities, intensities + rays(), told);
  else blend(intensities, told, [](double a, double b, double c, double d, double, double) { return (a + b + c + d) / 4; });
}

double RayFan::told(double range) const {
  if (range >= max_) return std::numeric_limits<double>::infinity();
  return range <= min_ ? -std::numeric_limits<double>::infinity() : range;
}

}  // namespace ode_sim
