// A piece of the trajectory of a joint that knows which goal it belongs to.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include <angles/angles.h>  // derived controllers use it without including it
#include <boost/shared_ptr.hpp>
#include <control_msgs/FollowJointTrajectoryAction.h>
#include <joint_trajectory_controller/joint_trajectory_msg_utils.h>
#include <joint_trajectory_controller/tolerances.h>
#include <joint_trajectory_controller/tracking_law.h>
#include <realtime_tools/realtime_server_goal_handle.h>
#include <trajectory_msgs/JointTrajectoryPoint.h>

namespace joint_trajectory_controller
{

/// \tparam Segment such as trajectory_interface::QuinticSplineSegment<double>
template <class Segment>
class JointTrajectorySegment : public Segment
{
public:
  typedef typename Segment::Scalar Scalar;
  typedef typename Segment::Time Time;
  typedef realtime_tools::RealtimeServerGoalHandle<control_msgs::FollowJointTrajectoryAction> RealtimeGoalHandle;
  typedef boost::shared_ptr<RealtimeGoalHandle> RealtimeGoalHandlePtr;

  struct State : public Segment::State
  {
    typedef typename Segment::State::Scalar Scalar;

    State() = default;
    State(unsigned int size) : Segment::State(size) {}
    State(const trajectory_msgs::JointTrajectoryPoint& point,
          const std::vector<Scalar>& position_offset = std::vector<Scalar>())
    {
      init(point, position_offset);
    }

    /// \param position_offset added to each position; none: 0 \throws std::invalid_argument sizes differ
    void init(const trajectory_msgs::JointTrajectoryPoint& point,
              const std::vector<Scalar>& position_offset = std::vector<Scalar>())
    {
      if (!isValid(point, point.positions.size()))
        throw std::invalid_argument("Size mismatch in trajectory point position, velocity or acceleration data.");
      if (!position_offset.empty() && position_offset.size() != point.positions.size())
        throw std::invalid_argument("Size mismatch between trajectory point and vector specifying whether joints wrap around.");
      this->position.assign(point.positions.begin(), point.positions.end());
      for (std::size_t i = 0; i < position_offset.size(); ++i)
        this->position[i] += position_offset[i];
      this->velocity.assign(point.velocities.begin(), point.velocities.end());
      this->acceleration.assign(point.accelerations.begin(), point.accelerations.end());
      this->time_from_start = Scalar(point.time_from_start.toSec());
    }
  };

  /// \throws std::invalid_argument as Segment::init()
  JointTrajectorySegment(const Time& start_time, const State& start_state, const Time& end_time, const State& end_state)
  {
    Segment::init(start_time, start_state, end_time, end_state);
  }

  /// Between two points of a message. \throws std::invalid_argument their sizes or times do not fit
  JointTrajectorySegment(const ros::Time& traj_start_time, const trajectory_msgs::JointTrajectoryPoint& start_point,
                         const trajectory_msgs::JointTrajectoryPoint& end_point,
                         const std::vector<Scalar>& position_offset = std::vector<Scalar>())
  {
    try
    {
      if (start_point.positions.size() != end_point.positions.size())
        throw std::invalid_argument("Start/end points data size mismatch.");
      Segment::init(Time((traj_start_time + start_point.time_from_start).toSec()), State(start_point, position_offset),
                    Time((traj_start_time + end_point.time_from_start).toSec()), State(end_point, position_offset));
    }
    catch (const std::invalid_argument& error)
    {
      throw std::invalid_argument(std::string("Can't construct segment from ROS message: ") + error.what());
    }
  }

  /// None: it belongs to no goal.
  RealtimeGoalHandlePtr getGoalHandle() const { return rt_goal_handle_; }
  void setGoalHandle(RealtimeGoalHandlePtr rt_goal_handle) { rt_goal_handle_ = rt_goal_handle; }

  const SegmentTolerancesPerJoint<Scalar>& getTolerances() const { return tolerances_; }
  void setTolerances(const SegmentTolerancesPerJoint<Scalar>& tolerances) { tolerances_ = tolerances; }

private:
  RealtimeGoalHandlePtr rt_goal_handle_;
  SegmentTolerancesPerJoint<Scalar> tolerances_;
};

/// Whole turns to add to next_position so that a joint that turns without end goes the short way.
/// Where both ways are equally long, it turns as the numbers say. 0 for other joints.
template <class Scalar>
inline Scalar wraparoundJointOffset(const Scalar& prev_position, const Scalar& next_position, const bool& angle_wraparound)
{
  return angle_wraparound ? Scalar(law::turns_to_add(prev_position, next_position)) : Scalar(0);
}

}  // namespace joint_trajectory_controller
