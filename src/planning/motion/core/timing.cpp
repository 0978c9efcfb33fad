#include "motion/timing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace motion
{
namespace
{
constexpr double TOLERANCE = 1e-3;     // of a limit of an acceleration; upstream's 0.01 rad/s^2 is 5 % of 0.2 rad/s^2
constexpr double SAME = 1e-8;          // rad or m: way points that are nearer to each other are one
constexpr double SHORTEST = 1e-6;      // s, of a segment: times of messages are whole nanoseconds
constexpr double MOST_STRETCH = 0.01;  // s, of a segment at one touch, as upstream
constexpr double NEARLY = 0.01;        // by which a spline may be beyond a limit before the whole of it is slowed down
constexpr double GENTLY = 1.0 / 16;  // of what a segment of a spline needs, in one sweep, as upstream: more would go beyond it

TimedPath atRest(const Rows& points)
{
  TimedPath out;
  out.positions = points;
  out.times.assign(points.size(), 0.0);
  const std::vector<double> zero(points.empty() ? 0 : points[0].size(), 0.0);
  out.velocities.assign(points.size(), zero);
  out.accelerations.assign(points.size(), zero);
  return out;
}

std::vector<double> shortestSegments(const Rows& points, const TimingLimits& limits)
{
  std::vector<double> segments(points.size() - 1, 0.0);
  for (std::size_t i = 0; i < segments.size(); ++i)
    for (std::size_t j = 0; j < points[i].size(); ++j)
      segments[i] = std::max(segments[i], std::abs(points[i + 1][j] - points[i][j]) / limits.velocity[j]);
  for (double& dt : segments)
    dt = std::max(dt, SHORTEST);
  return segments;
}

// Without those where nothing has moved: no two points come at one time, which controllers refuse.
Rows moving(const Rows& given)
{
  Rows points;
  auto same = [&points](const std::vector<double>& row) {
    for (std::size_t j = 0; j < row.size(); ++j)
      if (!(std::abs(row[j] - points.back()[j]) < SAME))
        return false;
    return true;
  };
  for (const auto& row : given)
    if (points.empty() || !same(row))
      points.push_back(row);
  return points;
}

// Mean velocities before and after a way point; at the ends the motion is mirrored, so that it starts and ends at rest.
struct Around
{
  double before, after, time_before, time_after;
  double acceleration() const { return 2.0 * (after - before) / (time_before + time_after); }
};

Around around(const Rows& points, const std::vector<double>& segments, std::size_t i, std::size_t j)
{
  const std::size_t last = points.size() - 1;
  const std::size_t in = i == 0 ? 0 : i - 1, out = i == last ? last - 1 : i;
  const double dt1 = segments[in], dt2 = segments[out];
  const double dq1 = points[in + 1][j] - points[in][j], dq2 = points[out + 1][j] - points[out][j];
  const double v1 = dt1 > 0 ? dq1 / dt1 : 0.0, v2 = dt2 > 0 ? dq2 / dt2 : 0.0;
  return {i == 0 ? -v2 : v1, i == last ? -v1 : v2, dt1, dt2};
}

// The smallest root of a x^2 + b x + c beyond `from`; infinity where there is none.
double rootBeyond(double a, double b, double c, double from)
{
  double best = std::numeric_limits<double>::infinity();
  const double inside = b * b - 4 * a * c;
  if (inside < 0)
    return best;
  const double q = -0.5 * (b + std::copysign(std::sqrt(inside), b));  // without losing digits
  for (const double root : {q / a, c / q})
    if (root > from && root < best)
      best = root;
  return best;
}

// Stretches one of the two segments at way point i, by no more than it needs; false if there is nothing to do. The shortest time at which the
// acceleration is its limit is taken: a longer one may be too long, where the joint would have to brake as hard.
bool stretch(const Rows& points, std::vector<double>& segments, std::size_t i, std::size_t j, double limit, bool later)
{
  const std::size_t last = points.size() - 1;
  const bool end = i == 0 || i == last;
  const std::size_t segment = i == 0 ? 0 : i == last ? last - 1 : later ? i : i - 1;
  const Around a = around(points, segments, i, j);
  if (a.time_before + a.time_after <= 0 || std::abs(a.acceleration()) <= limit * (1 + TOLERANCE))
    return false;
  const double from = segments[segment], way = points[segment + 1][j] - points[segment][j];
  const double most = std::copysign(limit, a.acceleration());
  double fits;
  if (end)
    fits = std::sqrt(2 * std::abs(way) / limit);
  else if (later)
    fits = rootBeyond(most, most * a.time_before + 2 * a.before, -2 * way, from);
  else
    fits = rootBeyond(most, most * a.time_after - 2 * a.after, 2 * way, from);
  segments[segment] = std::min(fits, from + MOST_STRETCH);
  return segments[segment] > from;
}

// Times of the segments between which every joint's mean velocity changes no faster than it may.
std::vector<double> parabolicSegments(const Rows& points, const TimingLimits& limits)
{
  std::vector<double> segments = shortestSegments(points, limits);
  // Upstream stops after 100 sweeps, fitting or not; here it goes on until the limits are kept.
  bool changed = true;
  for (int sweep = 0; changed && sweep < 20000; ++sweep)
  {
    changed = false;
    for (std::size_t j = 0; j < points[0].size(); ++j)
    {
      for (std::size_t i = 0; i < points.size(); ++i)
        changed |= stretch(points, segments, i, j, limits.acceleration[j], true);
      for (std::size_t i = points.size(); i-- > 0;)
        changed |= stretch(points, segments, i, j, limits.acceleration[j], false);
    }
  }
  return segments;
}

void fillTimes(TimedPath& out, const std::vector<double>& segments)
{
  out.times.assign(1, 0.0);
  for (double dt : segments)
    out.times.push_back(out.times.back() + dt);
}
}  // namespace

TimedPath iterativeParabolic(const Rows& given, const TimingLimits& limits)
{
  const Rows points = moving(given);
  TimedPath out = atRest(points);
  if (points.size() < 2)
    return out;
  const std::vector<double> segments = parabolicSegments(points, limits);
  fillTimes(out, segments);
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < points[i].size(); ++j)
    {
      const Around a = around(points, segments, i, j);
      out.velocities[i][j] = 0.5 * (a.before + a.after);
      out.accelerations[i][j] = a.time_before + a.time_after > 0 ? a.acceleration() : 0.0;
    }
  return out;
}

// ---------------------------------------------------------------- spline

namespace
{
// Velocities at the way points of the cubic spline that starts and ends at rest (tridiagonal system).
std::vector<double> splineVelocities(const Rows& points, const std::vector<double>& dt, std::size_t j)
{
  const std::size_t n = points.size();
  std::vector<double> diagonal(n, 1.0), upper(n, 0.0), velocity(n, 0.0);
  for (std::size_t i = 1; i + 1 < n; ++i)
  {
    const double a = dt[i], b = 2 * (dt[i - 1] + dt[i]), c = dt[i - 1];
    const double right =
        3 * (dt[i - 1] / dt[i] * (points[i + 1][j] - points[i][j]) + dt[i] / dt[i - 1] * (points[i][j] - points[i - 1][j]));
    const double pivot = b - a * upper[i - 1];
    upper[i] = c / pivot;
    velocity[i] = (right - a * velocity[i - 1]) / pivot;
  }
  for (std::size_t i = n - 1; i-- > 1;)
    velocity[i] -= upper[i] * velocity[i + 1];
  return velocity;
}

struct Cubic
{
  double q, v, half_a, jerk6;  // q + v t + half_a t^2 + jerk6 t^3
};

Cubic cubic(double q0, double q1, double v0, double v1, double dt)
{
  const double slope = (q1 - q0) / dt;
  return {q0, v0, (3 * slope - 2 * v0 - v1) / dt, (v0 + v1 - 2 * slope) / (dt * dt)};
}
}  // namespace

TimedPath iterativeSpline(const Rows& given, const TimingLimits& limits)
{
  const Rows points = moving(given);
  TimedPath out = atRest(points);
  if (points.size() < 2)
    return out;
  std::vector<double> segments = shortestSegments(points, limits);
  for (int sweep = 0; sweep < 2000; ++sweep)
  {
    std::vector<double> factor(segments.size(), 1.0);
    for (std::size_t j = 0; j < points[0].size(); ++j)
    {
      const std::vector<double> velocity = splineVelocities(points, segments, j);
      for (std::size_t i = 0; i < segments.size(); ++i)
      {
        const double dt = segments[i];
        const Cubic c = cubic(points[i][j], points[i + 1][j], velocity[i], velocity[i + 1], dt);
        const double a0 = std::abs(2 * c.half_a), a1 = std::abs(2 * c.half_a + 6 * c.jerk6 * dt);
        double fastest = std::max(std::abs(velocity[i]), std::abs(velocity[i + 1]));
        const double top = c.jerk6 != 0 ? -c.half_a / (3 * c.jerk6) : -1;
        if (top > 0 && top < dt)
          fastest = std::max(fastest, std::abs(c.v + 2 * c.half_a * top + 3 * c.jerk6 * top * top));
        factor[i] = std::max({factor[i], fastest / limits.velocity[j], std::sqrt(std::max(a0, a1) / limits.acceleration[j])});
      }
    }
    const double worst = *std::max_element(factor.begin(), factor.end());
    const bool nearly = worst <= 1.0 + NEARLY;  // then all of it at once
    for (std::size_t i = 0; i < segments.size(); ++i)
      segments[i] *= nearly ? worst : 1.0 + (factor[i] - 1.0) * GENTLY;
    if (nearly)
      break;
  }
  fillTimes(out, segments);
  for (std::size_t j = 0; j < points[0].size(); ++j)
  {
    const std::vector<double> velocity = splineVelocities(points, segments, j);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      out.velocities[i][j] = velocity[i];
      const std::size_t s = std::min(i, segments.size() - 1);
      const Cubic c = cubic(points[s][j], points[s + 1][j], velocity[s], velocity[s + 1], segments[s]);
      out.accelerations[i][j] = 2 * c.half_a + (i > s ? 6 * c.jerk6 * segments[s] : 0.0);
    }
  }
  return out;
}
}  // namespace motion
