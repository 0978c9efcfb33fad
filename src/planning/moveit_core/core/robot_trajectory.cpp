#include <moveit/robot_trajectory/robot_trajectory.h>

#include <tf2_eigen/tf2_eigen.h>

#include <algorithm>
#include <numeric>

#include <moveit/robot_state/conversions.h>
#include <moveit/trajectory_processing/trajectory_tools.h>

namespace robot_trajectory
{
using moveit::core::JointModel;
using moveit::core::RobotState;
using moveit::core::RobotStatePtr;

RobotTrajectory::RobotTrajectory(const moveit::core::RobotModelConstPtr& robot_model)
  : robot_model_(robot_model)
  , group_(nullptr)
{
}

RobotTrajectory::RobotTrajectory(const moveit::core::RobotModelConstPtr& robot_model, const std::string& group)
  : robot_model_(robot_model)
  , group_(group.empty() ? nullptr : robot_model->getJointModelGroup(group))
{
}

RobotTrajectory::RobotTrajectory(const moveit::core::RobotModelConstPtr& robot_model,
                                 const moveit::core::JointModelGroup* group)
  : robot_model_(robot_model)
  , group_(group)
{
}

RobotTrajectory::RobotTrajectory(const RobotTrajectory& other, bool deepcopy)
  : robot_model_(other.robot_model_)
  , group_(other.group_)
  , waypoints_(other.waypoints_)
  , duration_from_previous_(other.duration_from_previous_)
{
  if (deepcopy)
    for (RobotStatePtr& state : waypoints_)
      state = std::make_shared<RobotState>(*state);
}

const std::string& RobotTrajectory::getGroupName() const
{
  static const std::string none;
  return group_ ? group_->getName() : none;
}

RobotTrajectory& RobotTrajectory::setGroupName(const std::string& group_name)
{
  group_ = robot_model_->getJointModelGroup(group_name);
  return *this;
}

// ---------------------------------------------------------------- times

double RobotTrajectory::getWayPointDurationFromStart(std::size_t index) const
{
  if (duration_from_previous_.empty())
    return 0.0;
  const std::size_t end = std::min(index + 1, duration_from_previous_.size());
  return std::accumulate(duration_from_previous_.begin(), duration_from_previous_.begin() + end, 0.0);
}

RobotTrajectory& RobotTrajectory::setWayPointDurationFromPrevious(std::size_t index, double value)
{
  if (duration_from_previous_.size() <= index)
    duration_from_previous_.resize(index + 1, 0.0);
  duration_from_previous_[index] = value;
  return *this;
}

double RobotTrajectory::getDuration() const
{
  return std::accumulate(duration_from_previous_.begin(), duration_from_previous_.end(), 0.0);
}

double RobotTrajectory::getAverageSegmentDuration() const
{
  if (duration_from_previous_.empty())
    return 0.0;
  // The first one is the way to the first state: no segment when it is 0.
  const bool counts = duration_from_previous_[0] != 0.0;
  const std::size_t segments = duration_from_previous_.size() - (counts ? 0 : 1);
  return segments ? getDuration() / static_cast<double>(segments) : 0.0;
}

// ---------------------------------------------------------------- changes

RobotTrajectory& RobotTrajectory::insertWayPoint(std::size_t index, const RobotState& state, double dt)
{
  return insertWayPoint(index, std::make_shared<RobotState>(state), dt);
}

RobotTrajectory& RobotTrajectory::insertWayPoint(std::size_t index, const RobotStatePtr& state, double dt)
{
  state->update();
  waypoints_.insert(waypoints_.begin() + index, state);
  duration_from_previous_.insert(duration_from_previous_.begin() + std::min(index, duration_from_previous_.size()), dt);
  return *this;
}

RobotTrajectory& RobotTrajectory::append(const RobotTrajectory& source, double dt, size_t start_index, size_t end_index)
{
  end_index = std::min(end_index, source.waypoints_.size());
  for (std::size_t i = start_index; i < end_index; ++i)
  {
    waypoints_.push_back(source.waypoints_[i]);
    duration_from_previous_.push_back(i == start_index ? dt : source.getWayPointDurationFromPrevious(i));
  }
  return *this;
}

void RobotTrajectory::swap(RobotTrajectory& other)
{
  std::swap(robot_model_, other.robot_model_);
  std::swap(group_, other.group_);
  waypoints_.swap(other.waypoints_);
  duration_from_previous_.swap(other.duration_from_previous_);
}

RobotTrajectory& RobotTrajectory::clear()
{
  waypoints_.clear();
  duration_from_previous_.clear();
  return *this;
}

RobotTrajectory& RobotTrajectory::reverse()
{
  std::reverse(waypoints_.begin(), waypoints_.end());
  for (RobotStatePtr& state : waypoints_)
    state->invertVelocity();
  if (!duration_from_previous_.empty())
  {
    duration_from_previous_.push_back(duration_from_previous_.front());
    std::reverse(duration_from_previous_.begin(), duration_from_previous_.end());
    duration_from_previous_.pop_back();
  }
  return *this;
}

namespace
{
// Each value goes on from the one before by less than half a turn.
void unwindJoint(std::deque<RobotStatePtr>& states, const JointModel* joint, double last)
{
  for (RobotStatePtr& state : states)
  {
    double value = *state->getJointPositions(joint);
    value = last + std::remainder(value - last, 2.0 * M_PI);
    state->setJointPositions(joint, &value);
    last = value;
  }
}
}  // namespace

RobotTrajectory& RobotTrajectory::unwind()
{
  if (waypoints_.empty())
    return *this;
  for (const JointModel* joint : group_ ? group_->getContinuousJointModels() : robot_model_->getContinuousJointModels())
    unwindJoint(waypoints_, joint, *waypoints_[0]->getJointPositions(joint));
  return *this;
}

RobotTrajectory& RobotTrajectory::unwind(const RobotState& state)
{
  for (const JointModel* joint : group_ ? group_->getContinuousJointModels() : robot_model_->getContinuousJointModels())
    unwindJoint(waypoints_, joint, *state.getJointPositions(joint));
  return *this;
}

// ---------------------------------------------------------------- messages

void RobotTrajectory::getRobotTrajectoryMsg(moveit_msgs::RobotTrajectory& trajectory,
                                            const std::vector<std::string>& joint_filter) const
{
  trajectory = moveit_msgs::RobotTrajectory();
  if (waypoints_.empty())
    return;
  std::vector<const JointModel*> single, multi;
  for (const JointModel* joint : group_ ? group_->getActiveJointModels() : robot_model_->getActiveJointModels())
    if (joint_filter.empty() || std::count(joint_filter.begin(), joint_filter.end(), joint->getName()))
      (joint->getVariableCount() == 1 ? single : multi).push_back(joint);
  trajectory_msgs::JointTrajectory& one = trajectory.joint_trajectory;
  trajectory_msgs::MultiDOFJointTrajectory& many = trajectory.multi_dof_joint_trajectory;
  for (const JointModel* joint : single)
    one.joint_names.push_back(joint->getName());
  for (const JointModel* joint : multi)
    many.joint_names.push_back(joint->getName());
  one.header.frame_id = many.header.frame_id = robot_model_->getModelFrame();
  double time = 0.0;
  for (std::size_t i = 0; i < waypoints_.size(); ++i)
  {
    const RobotState& state = *waypoints_[i];
    time += getWayPointDurationFromPrevious(i);
    if (!single.empty())
    {
      one.points.emplace_back();
      trajectory_msgs::JointTrajectoryPoint& point = one.points.back();
      for (const JointModel* joint : single)
      {
        const int index = joint->getFirstVariableIndex();
        point.positions.push_back(state.getVariablePosition(index));
        if (state.hasVelocities())
          point.velocities.push_back(state.getVariableVelocity(index));
        if (state.hasAccelerations())
          point.accelerations.push_back(state.getVariableAcceleration(index));
        if (state.hasEffort())
          point.effort.push_back(state.getVariableEffort(index));
      }
      point.time_from_start = ros::Duration(time);
    }
    if (!multi.empty())
    {
      many.points.emplace_back();
      for (const JointModel* joint : multi)
        many.points.back().transforms.push_back(tf2::eigenToTransform(state.getJointTransform(joint)).transform);
      many.points.back().time_from_start = ros::Duration(time);
    }
  }
}

RobotTrajectory& RobotTrajectory::setRobotTrajectoryMsg(const RobotState& reference_state,
                                                        const trajectory_msgs::JointTrajectory& trajectory)
{
  moveit_msgs::RobotTrajectory whole;
  whole.joint_trajectory = trajectory;
  return setRobotTrajectoryMsg(reference_state, whole);
}

RobotTrajectory& RobotTrajectory::setRobotTrajectoryMsg(const RobotState& reference_state,
                                                        const moveit_msgs::RobotTrajectory& trajectory)
{
  clear();
  const trajectory_msgs::JointTrajectory& one = trajectory.joint_trajectory;
  const trajectory_msgs::MultiDOFJointTrajectory& many = trajectory.multi_dof_joint_trajectory;
  double last = 0.0;
  for (std::size_t i = 0; i < std::max(one.points.size(), many.points.size()); ++i)
  {
    const RobotStatePtr state = std::make_shared<RobotState>(reference_state);
    double time = last;
    if (i < one.points.size())
    {
      moveit::core::jointTrajPointToRobotState(one, i, *state);
      time = one.points[i].time_from_start.toSec();
    }
    if (i < many.points.size())
    {
      for (std::size_t j = 0; j < many.joint_names.size() && j < many.points[i].transforms.size(); ++j)
        state->setJointPositions(many.joint_names[j], tf2::transformToEigen(many.points[i].transforms[j]));
      time = many.points[i].time_from_start.toSec();
    }
    addSuffixWayPoint(state, time - last);
    last = time;
  }
  return *this;
}

RobotTrajectory& RobotTrajectory::setRobotTrajectoryMsg(const RobotState& reference_state, const moveit_msgs::RobotState& state,
                                                        const moveit_msgs::RobotTrajectory& trajectory)
{
  RobotState start(reference_state);
  moveit::core::robotStateMsgToRobotState(state, start);
  return setRobotTrajectoryMsg(start, trajectory);
}

// ---------------------------------------------------------------- in between

void RobotTrajectory::findWayPointIndicesForDurationAfterStart(const double duration, int& before, int& after,
                                                               double& blend) const
{
  before = after = 0;
  blend = 0.0;
  if (duration < 0.0 || waypoints_.empty())
    return;
  double running = 0.0;
  std::size_t index = 0;
  while (index < waypoints_.size())
  {
    running += getWayPointDurationFromPrevious(index);
    if (running >= duration)
      break;
    ++index;
  }
  before = std::max<int>(static_cast<int>(index) - 1, 0);
  after = std::min<int>(static_cast<int>(index), static_cast<int>(waypoints_.size()) - 1);
  const double segment = getWayPointDurationFromPrevious(after);
  blend = after == before || segment == 0.0 ? 1.0 : (duration - (running - segment)) / segment;
}

bool RobotTrajectory::getStateAtDurationFromStart(const double request_duration, RobotStatePtr& output_state) const
{
  if (waypoints_.empty())
    return false;
  int before, after;
  double blend;
  findWayPointIndicesForDurationAfterStart(request_duration, before, after, blend);
  waypoints_[before]->interpolate(*waypoints_[after], blend, *output_state);
  return true;
}

double path_length(RobotTrajectory const& trajectory)
{
  double length = 0.0;
  for (std::size_t i = 1; i < trajectory.getWayPointCount(); ++i)
    length += trajectory.getWayPoint(i).distance(trajectory.getWayPoint(i - 1));
  return length;
}
}  // namespace robot_trajectory

namespace trajectory_processing
{
bool isTrajectoryEmpty(const moveit_msgs::RobotTrajectory& trajectory) { return trajectoryWaypointCount(trajectory) == 0; }

std::size_t trajectoryWaypointCount(const moveit_msgs::RobotTrajectory& trajectory)
{
  return std::max(trajectory.joint_trajectory.points.size(), trajectory.multi_dof_joint_trajectory.points.size());
}
}  // namespace trajectory_processing
