// States in a row, each so many seconds after the one before.
#pragma once

#include <moveit_msgs/RobotState.h>
#include <moveit_msgs/RobotTrajectory.h>

#include <deque>
#include <limits>

#include <moveit/macros/class_forward.h>
#include <moveit/robot_state/robot_state.h>

namespace robot_trajectory
{
MOVEIT_CLASS_FORWARD(RobotTrajectory);

class RobotTrajectory
{
public:
  // Without a group: of the whole robot.
  explicit RobotTrajectory(const moveit::core::RobotModelConstPtr& robot_model);
  RobotTrajectory(const moveit::core::RobotModelConstPtr& robot_model, const std::string& group);
  RobotTrajectory(const moveit::core::RobotModelConstPtr& robot_model, const moveit::core::JointModelGroup* group);
  RobotTrajectory(const RobotTrajectory& other, bool deepcopy = false);  // shares the states unless deep
  RobotTrajectory& operator=(const RobotTrajectory&) = default;

  const moveit::core::RobotModelConstPtr& getRobotModel() const { return robot_model_; }
  const moveit::core::JointModelGroup* getGroup() const { return group_; }
  const std::string& getGroupName() const;
  RobotTrajectory& setGroupName(const std::string& group_name);

  std::size_t getWayPointCount() const { return waypoints_.size(); }
  std::size_t size() const { return waypoints_.size(); }
  bool empty() const { return waypoints_.empty(); }
  const moveit::core::RobotState& getWayPoint(std::size_t index) const { return *waypoints_[index]; }
  const moveit::core::RobotState& getLastWayPoint() const { return *waypoints_.back(); }
  const moveit::core::RobotState& getFirstWayPoint() const { return *waypoints_.front(); }
  moveit::core::RobotStatePtr& getWayPointPtr(std::size_t index) { return waypoints_[index]; }
  moveit::core::RobotStatePtr& getLastWayPointPtr() { return waypoints_.back(); }
  moveit::core::RobotStatePtr& getFirstWayPointPtr() { return waypoints_.front(); }

  // ------------------------------------------------------------ times, in s
  const std::deque<double>& getWayPointDurations() const { return duration_from_previous_; }
  double getWayPointDurationFromStart(std::size_t index) const;
  double getWaypointDurationFromStart(std::size_t index) const { return getWayPointDurationFromStart(index); }
  double getWayPointDurationFromPrevious(std::size_t index) const
  {
    return index < duration_from_previous_.size() ? duration_from_previous_[index] : 0.0;
  }
  RobotTrajectory& setWayPointDurationFromPrevious(std::size_t index, double value);
  double getDuration() const;
  double getAverageSegmentDuration() const;

  // ------------------------------------------------------------ changes
  RobotTrajectory& addSuffixWayPoint(const moveit::core::RobotState& state, double dt)
  {
    return insertWayPoint(waypoints_.size(), state, dt);
  }
  RobotTrajectory& addSuffixWayPoint(const moveit::core::RobotStatePtr& state, double dt)
  {
    return insertWayPoint(waypoints_.size(), state, dt);
  }
  RobotTrajectory& addPrefixWayPoint(const moveit::core::RobotState& state, double dt) { return insertWayPoint(0, state, dt); }
  RobotTrajectory& addPrefixWayPoint(const moveit::core::RobotStatePtr& state, double dt)
  {
    return insertWayPoint(0, state, dt);
  }
  RobotTrajectory& insertWayPoint(std::size_t index, const moveit::core::RobotState& state, double dt);
  RobotTrajectory& insertWayPoint(std::size_t index, const moveit::core::RobotStatePtr& state, double dt);
  RobotTrajectory& append(const RobotTrajectory& source, double dt, size_t start_index = 0,
                          size_t end_index = std::numeric_limits<std::size_t>::max());
  void swap(RobotTrajectory& other);
  RobotTrajectory& clear();
  RobotTrajectory& reverse();
  // Continuous joints go on turning instead of jumping from pi to -pi.
  RobotTrajectory& unwind();
  RobotTrajectory& unwind(const moveit::core::RobotState& state);

  // ------------------------------------------------------------ messages
  void getRobotTrajectoryMsg(moveit_msgs::RobotTrajectory& trajectory,
                             const std::vector<std::string>& joint_filter = std::vector<std::string>()) const;
  // Joints that the message does not name are where they are in the reference state.
  RobotTrajectory& setRobotTrajectoryMsg(const moveit::core::RobotState& reference_state,
                                         const trajectory_msgs::JointTrajectory& trajectory);
  RobotTrajectory& setRobotTrajectoryMsg(const moveit::core::RobotState& reference_state,
                                         const moveit_msgs::RobotTrajectory& trajectory);
  RobotTrajectory& setRobotTrajectoryMsg(const moveit::core::RobotState& reference_state, const moveit_msgs::RobotState& state,
                                         const moveit_msgs::RobotTrajectory& trajectory);

  // ------------------------------------------------------------ in between
  void findWayPointIndicesForDurationAfterStart(const double duration, int& before, int& after, double& blend) const;
  bool getStateAtDurationFromStart(const double request_duration, moveit::core::RobotStatePtr& output_state) const;

private:
  moveit::core::RobotModelConstPtr robot_model_;
  const moveit::core::JointModelGroup* group_;
  std::deque<moveit::core::RobotStatePtr> waypoints_;
  std::deque<double> duration_from_previous_;
};

// Sum of the distances between its states.
double path_length(RobotTrajectory const& trajectory);
}  // namespace robot_trajectory
