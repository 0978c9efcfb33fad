// Trajectories that are not made of a message.
#pragma once

#include <vector>

#include <boost/optional.hpp>
#include <boost/shared_ptr.hpp>
#include <control_msgs/FollowJointTrajectoryAction.h>
#include <joint_trajectory_controller/joint_trajectory_segment.h>
#include <realtime_tools/realtime_server_goal_handle.h>

namespace joint_trajectory_controller
{

/// Told the start, and if need be the goal, it fills in a trajectory of one segment for each joint: setStartTime(t)->buildTrajectory(&all).
template <class SegmentImpl>
class TrajectoryBuilder
{
private:
  typedef JointTrajectorySegment<SegmentImpl> Segment;
  typedef std::vector<Segment> TrajectoryPerJoint;
  typedef std::vector<TrajectoryPerJoint> Trajectory;
  typedef realtime_tools::RealtimeServerGoalHandle<control_msgs::FollowJointTrajectoryAction> RealtimeGoalHandle;
  typedef boost::shared_ptr<RealtimeGoalHandle> RealtimeGoalHandlePtr;

public:
  virtual ~TrajectoryBuilder() = default;

  TrajectoryBuilder* setStartTime(const typename Segment::Time& start_time)
  {
    start_time_ = start_time;
    return this;
  }

  /// \param goal_handle outlives the builder, or its next reset(): the goal's life is not prolonged by whoever builds for it
  TrajectoryBuilder* setGoalHandle(RealtimeGoalHandlePtr& goal_handle)
  {
    goal_handle_ = &goal_handle;
    return this;
  }

  /// Forget both.
  virtual void reset()
  {
    start_time_ = boost::none;
    goal_handle_ = nullptr;
  }

  /// \return false: no start was told, or the trajectory is not of this builder's joints; it is as it was
  virtual bool buildTrajectory(Trajectory* trajectory) = 0;

protected:
  RealtimeGoalHandlePtr createGoalHandlePtr() const { return goal_handle_ ? *goal_handle_ : createDefaultGoalHandle(); }
  const boost::optional<typename Segment::Time>& getStartTime() const { return start_time_; }
  static RealtimeGoalHandlePtr createDefaultGoalHandle() { return RealtimeGoalHandlePtr(); }

  static bool isTrajectoryValid(const Trajectory* trajectory, const unsigned int expected_number_of_joints,
                                const unsigned int expected_number_of_segments)
  {
    if (trajectory->size() != expected_number_of_joints)
      return false;
    for (const TrajectoryPerJoint& segments : *trajectory)
      if (segments.size() != expected_number_of_segments)
        return false;
    return true;
  }

private:
  boost::optional<typename Segment::Time> start_time_;
  RealtimeGoalHandlePtr* goal_handle_ = nullptr;
};

}  // namespace joint_trajectory_controller
