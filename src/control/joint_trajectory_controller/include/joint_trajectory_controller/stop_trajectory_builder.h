// Come to rest smoothly.
#pragma once

#include <vector>

#include <joint_trajectory_controller/trajectory_builder.h>

namespace joint_trajectory_controller
{

/// From a state in motion to rest, without turning back: the first half of the quintic that leads from (position, velocity) to
/// (position, -velocity) in twice the time.
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
      const bool at_once = !(duration_ > 0);
      begin_.position[0] = from_.position[i];
      begin_.velocity[0] = at_once ? 0 : from_.velocity[i];
      end_.position[0] = begin_.position[0] + 0.625 * begin_.velocity[0] * duration_;
      end_.acceleration[0] = at_once ? 0 : -1.5 * begin_.velocity[0] / duration_;
      Segment& segment = (*hold_traj)[i].front();
      segment.init(start, begin_, at_once ? start : start + duration_, end_);
      segment.setGoalHandle(this->createGoalHandlePtr());
    }
    return true;
  }

private:
  const typename Segment::Time duration_;
  const typename Segment::State& from_;
  typename Segment::State begin_{ 1u }, end_{ 1u };  // made here, as the control loop must not allocate
};

}  // namespace joint_trajectory_controller
