// One piece of a trajectory: a polynomial in time for each joint.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include <trajectory_interface/pos_vel_acc_state.h>
#include <trajectory_interface/spline_law.h>

namespace trajectory_interface
{

/// Of the highest order that both ends specify: linear, cubic or quintic (spline_law.h).
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

    const auto knot = [cubic, accelerations](const State& state, std::size_t joint) {
      Knot<Scalar> knot;
      knot.position = state.position[joint];
      knot.has_velocity = cubic;
      knot.velocity = cubic ? state.velocity[joint] : Scalar(0);
      knot.has_acceleration = cubic && accelerations;
      knot.acceleration = knot.has_acceleration ? state.acceleration[joint] : Scalar(0);
      return knot;
    };
    start_time_ = start_time;
    end_time_ = end_time;
    time_from_start_ = start_state.time_from_start;
    laws_.resize(joints);
    for (std::size_t i = 0; i < joints; ++i)
      laws_[i] = SplineLaw<Scalar>(start_time, knot(start_state, i), end_time, knot(end_state, i));
  }

  /// The state at a time. Allocates only where state is not of this segment's size.
  void sample(const Time& time, State& state) const
  {
    state.position.resize(laws_.size());
    state.velocity.resize(laws_.size());
    state.acceleration.resize(laws_.size());
    for (std::size_t i = 0; i < laws_.size(); ++i)
    {
      const Sample<Scalar> at = laws_[i].sample(time);
      state.position[i] = at.position;
      state.velocity[i] = at.velocity;
      state.acceleration[i] = at.acceleration;
    }
  }

  Time startTime() const { return start_time_; }
  Time endTime() const { return end_time_; }
  Time timeFromStart() const { return time_from_start_; }
  unsigned int size() const { return static_cast<unsigned int>(laws_.size()); }

private:
  static void refuse(const char* why)
  {
    throw std::invalid_argument(std::string("Quintic spline segment can't be constructed: ") + why);
  }

  std::vector<SplineLaw<Scalar>> laws_;  // of each joint
  Time start_time_ = Time(0), end_time_ = Time(0), time_from_start_ = Time(0);
};

}  // namespace trajectory_interface
