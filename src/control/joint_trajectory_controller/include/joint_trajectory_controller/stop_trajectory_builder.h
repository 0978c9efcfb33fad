// Come to rest smoothly.
#pragma once

#include <vector>

#include <joint_trajectory_controller/tracking_law.h>
#include <joint_trajectory_controller/trajectory_builder.h>

namespace joint_trajectory_controller
{

/// From a state in motion to rest, without turning back: the stop of tracking_law.h.
template <class SegmentImpl>
class StopTrajectoryBuilder : public TrajectoryBuilder<SegmentImpl>
{
private:
  typedef JointTrajectorySegment<SegmentImpl> Segment;
  typedef std::vector<std::vector<Segment>> Trajectory;

public:
  /// \param stop_traj_duration in s; 0: at rest at once
  /// \param hold_state of all joints, as it is when the trajectory is built; outlives the builder
  StopTrajectoryBuilder(const typename Segment::Time& stop_traj_duration, const typename Segment::State& hold_state)
    : duration_(stop_traj_duration)
    , from_(hold_state)
  {
  }

  bool buildTrajectory(Trajectory* hold_traj) override
  {
    if (!this->getStartTime() || !this->isTrajectoryValid(hold_traj, from_.position.size(), 1))
      return false;
    const typename Segment::Time start = *this->getStartTime();
    for (std::size_t i = 0; i < from_.position.size(); ++i)
    {
      const law::Ends<typename Segment::Scalar> ends = law::stop(from_.position[i], from_.velocity[i], duration_);
      put(ends.first, begin_);
      put(ends.last, end_);
      Segment& segment = (*hold_traj)[i].front();
      segment.init(start, begin_, duration_ > 0 ? start + duration_ : start, end_);
      segment.setGoalHandle(this->createGoalHandlePtr());
    }
    return true;
  }

private:
  static void put(const trajectory_interface::Knot<typename Segment::Scalar>& knot, typename Segment::State& state)
  {
    state.position[0] = knot.position;
    state.velocity[0] = knot.velocity;
    state.acceleration[0] = knot.acceleration;
  }

  const typename Segment::Time duration_;
  const typename Segment::State& from_;
  typename Segment::State begin_{ 1u }, end_{ 1u };  // made here, as the control loop must not allocate
};

}  // namespace joint_trajectory_controller
