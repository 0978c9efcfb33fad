// Trajectories: containers of segments in the order of their start times.
#pragma once

#include <algorithm>
#include <iterator>

namespace trajectory_interface
{

/// The last segment that has begun by that time; last, if none has.
template <class TrajectoryIterator, class Time>
inline TrajectoryIterator findSegment(TrajectoryIterator first, TrajectoryIterator last, const Time& time)
{
  typedef typename std::iterator_traits<TrajectoryIterator>::value_type Segment;
  const TrajectoryIterator next =
      std::upper_bound(first, last, time, [](const Time& t, const Segment& segment) { return t < segment.startTime(); });
  return next == first ? last : std::prev(next);
}

template <class Trajectory, class Time>
inline typename Trajectory::const_iterator findSegment(const Trajectory& trajectory, const Time& time)
{
  return findSegment(trajectory.begin(), trajectory.end(), time);
}

template <class Trajectory, class Time>
inline typename Trajectory::iterator findSegment(Trajectory& trajectory, const Time& time)
{
  return findSegment(trajectory.begin(), trajectory.end(), time);
}

/// The state at that time; before the first segment that of its start. \return the segment it is from, or end()
template <class Trajectory>
inline typename Trajectory::const_iterator sample(const Trajectory& trajectory,
                                                  const typename Trajectory::value_type::Time& time,
                                                  typename Trajectory::value_type::State& state)
{
  const typename Trajectory::const_iterator segment = findSegment(trajectory, time);
  if (segment != trajectory.end())
    segment->sample(time, state);
  else if (!trajectory.empty())
    trajectory.front().sample(time, state);
  return segment;
}

}  // namespace trajectory_interface
