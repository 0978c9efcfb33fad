// Animation: the curves are those of ignition-math's Spline and RotationSpline, as in ode_sim's actors/splines.py.
#include <gazebo/common/Animation.hh>

#include <algorithm>
#include <cmath>

namespace gazebo
{
namespace common
{

using ignition::math::Quaterniond;
using ignition::math::Vector3d;

void Animation::SetTime(double time)
{
  if (loop_ && length_ > 0)
  {
    time = std::fmod(time, length_);
    time_ = time < 0 ? time + length_ : time;
  }
  else
    time_ = std::max(0.0, std::min(time, length_));
}

KeyFrame* Animation::insert(std::unique_ptr<KeyFrame> frame)
{
  const auto at = std::upper_bound(frames_.begin(), frames_.end(), frame,
                                   [](const auto& a, const auto& b) { return a->GetTime() < b->GetTime(); });
  return frames_.insert(at, std::move(frame))->get();
}

std::size_t Animation::find(double time, double& part) const
{
  std::size_t at = 0;
  while (at + 1 < frames_.size() && frames_[at + 1]->GetTime() <= time)
    ++at;
  part = 0;
  if (at + 1 < frames_.size())
  {
    const double from = frames_[at]->GetTime(), until = frames_[at + 1]->GetTime();
    part = std::max(0.0, (time - from) / (until - from));
  }
  return at;
}

namespace
{

constexpr double kSmall = 1e-3;  // of a sine or a rest of a cosine: below, upstream takes the straight way

double dot(const Quaterniond& p, const Quaterniond& q) { return p.W() * q.W() + p.X() * q.X() + p.Y() * q.Y() + p.Z() * q.Z(); }

Quaterniond sum(const Quaterniond& p, double a, const Quaterniond& q, double b)
{
  return { a * p.W() + b * q.W(), a * p.X() + b * q.X(), a * p.Y() + b * q.Y(), a * p.Z() + b * q.Z() };
}

Quaterniond slerp(double t, const Quaterniond& p, Quaterniond q, bool shortest)
{
  double cosine = dot(p, q);
  if (cosine < 0 && shortest)
    cosine = -cosine, q = { -q.W(), -q.X(), -q.Y(), -q.Z() };
  if (std::abs(cosine) < 1 - kSmall)
  {
    const double sine = std::sqrt(1 - cosine * cosine), angle = std::atan2(sine, cosine);
    return sum(p, std::sin((1 - t) * angle) / sine, q, std::sin(t * angle) / sine);
  }
  Quaterniond out = sum(p, 1 - t, q, t);
  out.Normalize();
  return out;
}

Vector3d logarithm(const Quaterniond& q)
{
  const Vector3d v(q.X(), q.Y(), q.Z());
  if (!(std::abs(q.W()) < 1))
    return v;
  const double angle = std::acos(q.W()), sine = std::sin(angle);
  return std::abs(sine) >= kSmall ? v * (angle / sine) : v;
}

Quaterniond exponential(const Vector3d& v)
{
  const double angle = v.Length(), sine = std::sin(angle), factor = std::abs(sine) >= kSmall ? sine / angle : 1;
  return { std::cos(angle), v.X() * factor, v.Y() * factor, v.Z() * factor };
}

/// The points before and after one of a curve; one that ends where it began is closed.
template <class T>
std::pair<T, T> neighbours(const std::vector<T>& points, std::size_t i)
{
  const std::size_t last = points.size() - 1;
  if ((i == 0 || i == last) && points.front() == points.back())
    return { points[last - 1], points[1] };
  return { points[i == 0 ? 0 : i - 1], points[std::min(i + 1, last)] };
}

Vector3d tangent(const std::vector<Vector3d>& points, std::size_t i, double tension)
{
  const auto [before, after] = neighbours(points, i);
  return (after - before) * (0.5 * (1 - tension));
}

Quaterniond tangent(const std::vector<Quaterniond>& points, std::size_t i)
{
  const auto [before, after] = neighbours(points, i);
  const Quaterniond back = points[i].Inverse();
  return points[i] * exponential((logarithm(back * after) + logarithm(back * before)) * -0.25);
}

}  // namespace

PoseKeyFrame* PoseAnimation::CreateKeyFrame(double time)
{
  return static_cast<PoseKeyFrame*>(insert(std::make_unique<PoseKeyFrame>(time)));
}

void PoseAnimation::GetInterpolatedKeyFrame(double time, PoseKeyFrame& frame) const
{
  if (frames_.empty())
    return;
  double t = 0;
  const std::size_t i = find(time, t);
  std::vector<Vector3d> places;
  std::vector<Quaterniond> turns;
  for (const auto& each : frames_)
  {
    places.push_back(static_cast<const PoseKeyFrame&>(*each).Translation());
    turns.push_back(static_cast<const PoseKeyFrame&>(*each).Rotation());
  }
  if (t < 1e-6)
  {
    frame.Translation(places[i]), frame.Rotation(turns[i]);
    return;
  }
  const double t2 = t * t, t3 = t2 * t;
  frame.Translation(places[i] * (2 * t3 - 3 * t2 + 1) + tangent(places, i, tension_) * (t3 - 2 * t2 + t) +
                    places[i + 1] * (3 * t2 - 2 * t3) + tangent(places, i + 1, tension_) * (t3 - t2));
  const Quaterniond direct = slerp(t, turns[i], turns[i + 1], true);
  const Quaterniond bent = slerp(t, tangent(turns, i), tangent(turns, i + 1), false);
  Quaterniond turn = slerp(2 * t * (1 - t), direct, bent, false);
  turn.Normalize();
  frame.Rotation(turn);
}

NumericKeyFrame* NumericAnimation::CreateKeyFrame(double time)
{
  return static_cast<NumericKeyFrame*>(insert(std::make_unique<NumericKeyFrame>(time)));
}

void NumericAnimation::GetInterpolatedKeyFrame(NumericKeyFrame& frame) const
{
  if (frames_.empty())
    return;
  double t = 0;
  const std::size_t i = find(GetTime(), t);
  const double value = static_cast<const NumericKeyFrame&>(*frames_[i]).GetValue();
  const double next = i + 1 < frames_.size() ? static_cast<const NumericKeyFrame&>(*frames_[i + 1]).GetValue() : value;
  frame.SetValue(value + t * (next - value));
}

}  // namespace common
}  // namespace gazebo
