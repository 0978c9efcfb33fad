// Time-optimal timing along a given way. The way: straight pieces, corners rounded by circles (Kunz and Stilman, "Time-optimal
// trajectory generation for path following with bounded acceleration and velocity", RSS 2012). The speed along it: the
// largest that can still be braked (backwards), then the largest that can be reached (forwards), on a grid whose intervals
// never span two pieces, so that the limits are kept on both sides of every joint of the way.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "motion/timing.hpp"

namespace motion
{
namespace
{
using Vector = Eigen::VectorXd;

struct Piece
{
  double length;
  bool arc;
  Vector start, direction;  // straight: start + s direction
  Vector centre, x, y;      // arc: centre + radius (x cos(s / radius) + y sin(s / radius))
  double radius = 0;
  bool stop_before = false;  // a corner that is not rounded: the motion has to stop there

  Vector position(double s) const
  {
    if (!arc)
      return start + s * direction;
    return centre + radius * (x * std::cos(s / radius) + y * std::sin(s / radius));
  }
  Vector tangent(double s) const
  {
    if (!arc)
      return direction;
    return -x * std::sin(s / radius) + y * std::cos(s / radius);
  }
  Vector curvature(double s) const
  {
    if (!arc)
      return Vector::Zero(direction.size());
    return -(x * std::cos(s / radius) + y * std::sin(s / radius)) / radius;
  }
};

Piece straight(const Vector& from, const Vector& to)
{
  Piece piece;
  piece.arc = false;
  piece.length = (to - from).norm();
  piece.start = from;
  piece.direction = (to - from) / std::max(piece.length, 1e-300);
  return piece;
}

std::vector<Piece> makeWay(const std::vector<Vector>& points, double tolerance)
{
  std::vector<Piece> way;
  Vector from = points.front();
  auto add = [&](const Vector& to) {
    if ((to - from).norm() > 1e-9)
      way.push_back(straight(from, to));
    from = to;
  };
  for (std::size_t i = 1; i + 1 < points.size(); ++i)
  {
    const Vector before = points[i] - points[i - 1], after = points[i + 1] - points[i];
    const Vector y1 = before.normalized(), y2 = after.normalized();
    const double cosine = std::min(1.0, std::max(-1.0, y1.dot(y2))), angle = std::acos(cosine);
    if (angle < 1e-6)
    {
      add(points[i]);
      continue;
    }
    const double half = 0.5 * angle;
    double reach = std::min(0.5 * before.norm(), 0.5 * after.norm());
    if (half < 0.5 * M_PI - 1e-6)
      reach = std::min(reach, tolerance * std::sin(half) / (1.0 - std::cos(half)));
    const double radius = reach / std::tan(half);
    if (radius < 1e-7)
    {
      add(points[i]);
      const std::size_t next = way.size();
      Piece corner = straight(points[i], points[i]);
      corner.stop_before = true;
      way.push_back(corner);
      way[next].direction = y2;
      continue;
    }
    add(points[i] - reach * y1);
    Piece arc;
    arc.arc = true;
    arc.radius = radius;
    arc.length = angle * radius;
    arc.centre = points[i] + (y2 - y1).normalized() * (radius / std::cos(half));
    arc.x = (points[i] - reach * y1 - arc.centre).normalized();
    arc.y = y1;
    way.push_back(arc);
    from = points[i] + reach * y2;
  }
  add(points.back());
  return way;
}

// The grid: node k at s[k]; interval k from node k to k + 1, inside one piece.
struct Interval
{
  double length;
  Vector p0, c0, p1, c1;  // tangent and curvature at its ends
  std::size_t piece;
  double offset;  // of its start in the piece
};

class Speed
{
public:
  Speed(const std::vector<Piece>& way, const TimingLimits& limits)
    : velocity_(Eigen::Map<const Vector>(limits.velocity.data(), limits.velocity.size()))
    , acceleration_(Eigen::Map<const Vector>(limits.acceleration.data(), limits.acceleration.size()))
  {
    double total = 0;
    for (const Piece& piece : way)
      total += piece.length;
    bool stop = false;
    for (std::size_t p = 0; p < way.size(); ++p)
    {
      const Piece& piece = way[p];
      stop = stop || piece.stop_before;
      if (piece.length < 1e-12)
        continue;
      // Between nodes nothing is checked: an arc may not turn much from one to the next.
      const double turn = piece.arc ? piece.length / piece.radius : 0.0;
      const int count =
          std::max({8, static_cast<int>(std::ceil(piece.length / total * 1000)), static_cast<int>(std::ceil(turn / 0.03))});
      const double length = piece.length / count;
      for (int k = 0; k < count; ++k)
      {
        const double s = k * length;
        intervals.push_back(
            {length, piece.tangent(s), piece.curvature(s), piece.tangent(s + length), piece.curvature(s + length), p, s});
        most_.push_back(stop ? 0.0 : std::numeric_limits<double>::infinity());
        stop = false;
      }
    }
    most_.push_back(0.0);
    for (std::size_t k = 0; k < intervals.size(); ++k)
    {
      most_[k] = std::min(most_[k], fastest(intervals[k].p0));
      most_[k + 1] = std::min(most_[k + 1], fastest(intervals[k].p1));
    }
    most_[0] = 0.0;
    backwards();
    forwards();
  }

  std::vector<Interval> intervals;
  std::vector<double> squared;  // speed^2 at the nodes
  std::vector<double> push;     // acceleration along the way in the intervals

private:
  double fastest(const Vector& tangent) const
  {
    double most = std::numeric_limits<double>::infinity();
    for (Eigen::Index j = 0; j < tangent.size(); ++j)
      if (std::abs(tangent[j]) > 1e-12)
        most = std::min(most, velocity_[j] / std::abs(tangent[j]));
    return most * most;
  }

  // Accelerations along the way that keep the joints' limits in interval k when it is entered with speed^2 x and left with
  // at most `leave`: [low, high], empty if there is none.
  bool range(std::size_t k, double x, double leave, double& low, double& high) const
  {
    const Interval& i = intervals[k];
    low = -x / (2 * i.length);
    high = (leave - x) / (2 * i.length);
    auto keep = [&](double factor, double rest, double limit) {
      // |factor u + rest| <= limit
      if (std::abs(factor) < 1e-12)
        return std::abs(rest) <= limit * (1 + 1e-9);
      const double a = (-limit - rest) / factor, b = (limit - rest) / factor;
      low = std::max(low, std::min(a, b));
      high = std::min(high, std::max(a, b));
      return true;
    };
    for (Eigen::Index j = 0; j < acceleration_.size(); ++j)
      if (!keep(i.p0[j], i.c0[j] * x, acceleration_[j]) ||
          !keep(i.p1[j] + 2 * i.length * i.c1[j], i.c1[j] * x, acceleration_[j]))
        return false;
    return low <= high;
  }

  void backwards()
  {
    const std::size_t n = intervals.size();
    double low, high;
    for (std::size_t k = n; k-- > 0;)
    {
      const double leave = most_[k + 1];
      // The most that can be braked from is bounded by the straight case; bisect below it.
      double top = most_[k];
      if (!std::isfinite(top))
        top = 1e12;
      if (range(k, top, leave, low, high))
      {
        most_[k] = top;
        continue;
      }
      double bottom = 0;
      for (int step = 0; step < 60 && top - bottom > 1e-12 * top; ++step)
      {
        const double middle = step < 12 ? std::sqrt(std::max(bottom, 1e-12) * top) : 0.5 * (bottom + top);
        (range(k, middle, leave, low, high) ? bottom : top) = middle;
      }
      most_[k] = bottom;
    }
  }

  void forwards()
  {
    squared.assign(intervals.size() + 1, 0.0);
    push.assign(intervals.size(), 0.0);
    for (std::size_t k = 0; k < intervals.size(); ++k)
    {
      double low, high;
      if (!range(k, squared[k], most_[k + 1], low, high))
        high = (std::min(most_[k + 1], squared[k]) - squared[k]) / (2 * intervals[k].length);
      push[k] = high;
      squared[k + 1] = std::min(std::max(0.0, squared[k] + 2 * intervals[k].length * high), most_[k + 1]);
    }
  }

  Vector velocity_, acceleration_;
  std::vector<double> most_;
};

std::vector<double> row(const Vector& v) { return std::vector<double>(v.data(), v.data() + v.size()); }

// Those that differ from the one before, and the end exactly.
std::vector<Vector> wayPoints(const Rows& given, double min_angle_change)
{
  std::vector<Vector> points;
  for (std::size_t i = 0; i < given.size(); ++i)
  {
    const Vector point = Eigen::Map<const Vector>(given[i].data(), given[i].size());
    const double change = points.empty() ? 1e9 : (point - points.back()).cwiseAbs().maxCoeff();
    if (change > min_angle_change)
      points.push_back(point);
    else if (i + 1 == given.size())
      points.back() = points.size() > 1 ? point : points.back();
  }
  return points;
}
}  // namespace

TimedPath timeOptimal(const Rows& given, const TimingLimits& limits, double path_tolerance, double resample_dt,
                      double min_angle_change)
{
  TimedPath out;
  const std::vector<Vector> points = wayPoints(given, min_angle_change);
  const std::vector<double> zero(given.empty() ? 0 : given[0].size(), 0.0);
  auto add = [&](double time, const Vector& q, const Vector& v, const Vector& a) {
    out.times.push_back(time);
    out.positions.push_back(row(q));
    out.velocities.push_back(row(v));
    out.accelerations.push_back(row(a));
  };
  if (points.size() < 2)
  {
    if (!points.empty())
      add(0.0, points[0], Vector::Zero(points[0].size()), Vector::Zero(points[0].size()));
    return out;
  }
  const std::vector<Piece> way = makeWay(points, path_tolerance);
  const Speed speed(way, limits);
  std::vector<double> starts{0.0};
  for (std::size_t k = 0; k < speed.intervals.size(); ++k)
  {
    const double mean = 0.5 * (std::sqrt(speed.squared[k]) + std::sqrt(speed.squared[k + 1]));
    if (mean < 1e-12)
      throw InvalidInput("time-optimal timing: the motion comes to a halt on its way; are the limits far too small?");
    starts.push_back(starts.back() + speed.intervals[k].length / mean);
  }
  const double duration = starts.back();
  const double count = std::max(1.0, std::ceil(duration / resample_dt - 1e-6));  // no two points at one time
  if (count > 1e6)
    throw InvalidInput("time-optimal timing: the motion would last " + std::to_string(duration) +
                       " s, more than a million points; raise the limits, the scaling or the resampling time");
  std::size_t k = 0;
  for (int i = 0; i <= static_cast<int>(count); ++i)
  {
    const double time = std::min(duration, i * resample_dt);
    while (k + 1 < speed.intervals.size() && starts[k + 1] <= time)
      ++k;
    const Interval& interval = speed.intervals[k];
    const double passed = time - starts[k], v0 = std::sqrt(speed.squared[k]);
    const double s = std::min(interval.length, std::max(0.0, v0 * passed + 0.5 * speed.push[k] * passed * passed));
    const double v = std::sqrt(std::max(0.0, speed.squared[k] + 2 * speed.push[k] * s));
    const Piece& piece = way[interval.piece];
    const double at = interval.offset + s;
    const Vector tangent = piece.tangent(at);
    add(time, piece.position(at), tangent * v, tangent * speed.push[k] + piece.curvature(at) * v * v);
  }
  out.positions.back() = row(points.back());
  out.velocities.back() = zero;
  return out;
}
}  // namespace motion
