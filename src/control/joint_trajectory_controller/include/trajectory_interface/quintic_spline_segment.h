// One piece of a trajectory: a polynomial in time for each joint.
#pragma once

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include <trajectory_interface/pos_vel_acc_state.h>

namespace trajectory_interface
{

/// Of the highest order that both ends specify: linear, cubic or quintic. Before its start and after its end it is at rest there.
template <class ScalarType>
class QuinticSplineSegment
{
public:
  typedef ScalarType Scalar;
  typedef Scalar Time;
  typedef PosVelAccState<Scalar> State;

  QuinticSplineSegment() = default;

  /// \throws std::invalid_argument as init()
  QuinticSplineSegment(const Time& start_time, const State& start_state, const Time& end_time, const State& end_state)
  {
    init(start_time, start_state, end_time, end_state);
  }

  /// \throws std::invalid_argument the times are the wrong way round, there are no positions, or sizes differ
  void init(const Time& start_time, const State& start_state, const Time& end_time, const State& end_state)
  {
    if (end_time < start_time)
      refuse("end_time < start_time.");
    if (start_state.position.empty() || end_state.position.empty())
      refuse("Endpoint positions can't be empty.");
    const auto joints = start_state.position.size();
    if (joints != end_state.position.size())
      refuse("Endpoint positions size mismatch.");
    const bool cubic = !start_state.velocity.empty() && !end_state.velocity.empty();
    const bool accelerations = !start_state.acceleration.empty() && !end_state.acceleration.empty();
    if (cubic && (joints != start_state.velocity.size() || joints != end_state.velocity.size()))
      refuse("Endpoint velocities size mismatch.");
    if (accelerations && (joints != start_state.acceleration.size() || joints != end_state.acceleration.size()))
      refuse("Endpoint accelerations size mismatch.");

    start_time_ = start_time;
    duration_ = end_time - start_time;
    time_from_start_ = start_state.time_from_start;
    polynomials_.assign(joints, Polynomial{});
    for (std::size_t i = 0; i < joints; ++i)
    {
      const Scalar p0 = start_state.position[i], p1 = end_state.position[i];
      if (!cubic)
        linear(p0, p1, polynomials_[i]);
      else if (!accelerations)
        cubic_of(p0, start_state.velocity[i], p1, end_state.velocity[i], polynomials_[i]);
      else
        quintic_of(p0, start_state.velocity[i], start_state.acceleration[i], p1, end_state.velocity[i],
                   end_state.acceleration[i], polynomials_[i]);
    }
  }

  /// The state at a time. Allocates only where state is not of this segment's size.
  void sample(const Time& time, State& state) const
  {
    state.position.resize(polynomials_.size());
    state.velocity.resize(polynomials_.size());
    state.acceleration.resize(polynomials_.size());
    const Time since = time - start_time_;
    const bool before = since<Time(0), after = since> duration_;
    const Time t = before ? Time(0) : after ? duration_ : since;
    for (std::size_t i = 0; i < polynomials_.size(); ++i)
    {
      const Polynomial& c = polynomials_[i];
      state.position[i] = c[0] + t * (c[1] + t * (c[2] + t * (c[3] + t * (c[4] + t * c[5]))));
      state.velocity[i] = before || after ? Scalar(0) : c[1] + t * (2 * c[2] + t * (3 * c[3] + t * (4 * c[4] + t * 5 * c[5])));
      state.acceleration[i] = before || after ? Scalar(0) : 2 * c[2] + t * (6 * c[3] + t * (12 * c[4] + t * 20 * c[5]));
    }
  }

  Time startTime() const { return start_time_; }
  Time endTime() const { return start_time_ + duration_; }
  Time timeFromStart() const { return time_from_start_; }
  unsigned int size() const { return static_cast<unsigned int>(polynomials_.size()); }

private:
  typedef std::array<Scalar, 6> Polynomial;  // of ascending powers of the time since the start

  static void refuse(const char* why)
  {
    throw std::invalid_argument(std::string("Quintic spline segment can't be constructed: ") + why);
  }

  // A segment that takes no time stays where it starts.

  void linear(Scalar p0, Scalar p1, Polynomial& c) const
  {
    c[0] = p0;
    c[1] = duration_ == Time(0) ? Scalar(0) : (p1 - p0) / duration_;
  }

  void cubic_of(Scalar p0, Scalar v0, Scalar p1, Scalar v1, Polynomial& c) const
  {
    c[0] = p0;
    c[1] = v0;
    const Time t = duration_;
    if (t == Time(0))
      return;
    c[2] = (3 * (p1 - p0) / t - 2 * v0 - v1) / t;
    c[3] = (v0 + v1 - 2 * (p1 - p0) / t) / (t * t);
  }

  void quintic_of(Scalar p0, Scalar v0, Scalar a0, Scalar p1, Scalar v1, Scalar a1, Polynomial& c) const
  {
    c[0] = p0;
    c[1] = v0;
    c[2] = a0 / 2;
    const Time t = duration_, tt = t * t;
    if (t == Time(0))
      return;
    const Scalar way = p1 - p0;
    c[3] = (20 * way - (12 * v0 + 8 * v1) * t - (3 * a0 - a1) * tt) / (2 * tt * t);
    c[4] = (-30 * way + (16 * v0 + 14 * v1) * t + (3 * a0 - 2 * a1) * tt) / (2 * tt * tt);
    c[5] = (12 * way - 6 * (v0 + v1) * t + (a1 - a0) * tt) / (2 * tt * tt * t);
  }

  std::vector<Polynomial> polynomials_;
  Time duration_ = Time(0), start_time_ = Time(0), time_from_start_ = Time(0);
};

}  // namespace trajectory_interface
