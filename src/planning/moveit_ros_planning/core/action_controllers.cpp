// Controllers behind FollowJointTrajectory and GripperCommand actions.
#include <actionlib/client/simple_action_client.h>
#include <control_msgs/FollowJointTrajectoryAction.h>
#include <control_msgs/GripperCommandAction.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>

#include "built_in_controllers.hpp"
#include "log_names.hpp"

namespace trajectory_execution_manager
{
namespace
{
constexpr double CONNECT = 2.0;  // s of wall time for a server that comes late
constexpr double LONGEST = 1e9;  // s: what a duration holds
constexpr double GONE = 1.0;     // s of wall time after which a server that is not there is taken for dead
using moveit_controller_manager::ExecutionStatus;

template <typename Action>
class ActionHandle : public moveit_controller_manager::MoveItControllerHandle
{
public:
  using Client = actionlib::SimpleActionClient<Action>;

  ActionHandle(const ControllerEntry& entry, const std::string& topic)
    : MoveItControllerHandle(entry.name)
    , entry_(entry)
    , topic_(topic)
    , client_(new Client(topic, true))
  {
  }

  bool sendTrajectory(const moveit_msgs::RobotTrajectory& trajectory) override
  {
    if (!connect())
      return false;
    typename Action::_action_goal_type::_goal_type goal;
    if (!makeGoal(trajectory, goal))
      return false;
    std::uint64_t sent;
    {
      std::lock_guard<std::mutex> lock(lock_);
      sent = ++goals_;
      status_ = ExecutionStatus::RUNNING;
    }
    client_->sendGoal(goal, [this, sent](const actionlib::SimpleClientGoalState& state, const auto& result) {
      if (result)
        explain(*result);
      end(sent, statusOf(state));
    });
    return true;
  }

  bool cancelExecution() override
  {
    std::uint64_t sent;
    {
      std::lock_guard<std::mutex> lock(lock_);
      if (status_ != ExecutionStatus::RUNNING)
        return true;
      sent = goals_;
    }
    ROS_INFO_NAMED(log_names::CONTROLLER_MANAGER, "Cancelling execution for %s", name_.c_str());
    client_->cancelGoal();
    end(sent, ExecutionStatus::PREEMPTED);
    return true;
  }

  bool waitForExecution(const ros::Duration& timeout) override
  {
    const ros::Time until = ros::Time::now() + timeout;
    ros::WallTime there = ros::WallTime::now();
    while (ros::ok())
    {
      {
        std::unique_lock<std::mutex> lock(lock_);
        if (ended_.wait_for(lock, std::chrono::milliseconds(20), [this]() { return status_ != ExecutionStatus::RUNNING; }))
          return true;
      }
      if (client_->isServerConnected())
        there = ros::WallTime::now();
      else if ((ros::WallTime::now() - there).toSec() > GONE)
      {
        ROS_ERROR_NAMED(log_names::CONTROLLER_MANAGER,
                        "The action server %s has gone away during the motion; the controller '%s' was stopped, or its "
                        "node has ended",
                        topic_.c_str(), name_.c_str());
        end(goals_, ExecutionStatus::ABORTED);
        return true;
      }
      if (!timeout.isZero() && ros::Time::now() > until)
        return false;
    }
    return false;
  }

  ExecutionStatus getLastExecutionStatus() override
  {
    std::lock_guard<std::mutex> lock(lock_);
    return status_;
  }

protected:
  virtual bool makeGoal(const moveit_msgs::RobotTrajectory& trajectory,
                        typename Action::_action_goal_type::_goal_type& goal) = 0;
  virtual void explain(const typename Action::_action_result_type::_result_type& /*result*/) {}

  const ControllerEntry entry_;

private:
  bool connect()
  {
    const ros::WallTime until = ros::WallTime::now() + ros::WallDuration(CONNECT);
    while (!client_->isServerConnected())
    {
      if (ros::WallTime::now() > until || !ros::ok())
      {
        ROS_ERROR_NAMED(log_names::CONTROLLER_MANAGER,
                        "Action client not connected to action server: %s. Start the controller '%s'", topic_.c_str(),
                        name_.c_str());
        return false;
      }
      ros::WallDuration(0.02).sleep();
    }
    return true;
  }

  void end(std::uint64_t sent, ExecutionStatus status)
  {
    std::lock_guard<std::mutex> lock(lock_);
    if (sent != goals_ || status_ != ExecutionStatus::RUNNING)
      return;
    status_ = status;
    ended_.notify_all();
  }

  ExecutionStatus statusOf(const actionlib::SimpleClientGoalState& state) const
  {
    using State = actionlib::SimpleClientGoalState;
    if (state == State::SUCCEEDED || (state == State::ABORTED && entry_.flag("allow_failure")))
      return ExecutionStatus::SUCCEEDED;
    ROS_WARN_NAMED(log_names::CONTROLLER_MANAGER, "Controller '%s' ended with %s: %s", name_.c_str(), state.toString().c_str(),
                   state.getText().c_str());
    return state == State::ABORTED     ? ExecutionStatus::ABORTED
           : state == State::PREEMPTED ? ExecutionStatus::PREEMPTED
                                       : ExecutionStatus::FAILED;
  }

  const std::string topic_;
  std::mutex lock_;
  std::condition_variable ended_;
  ExecutionStatus status_ = ExecutionStatus::SUCCEEDED;
  std::uint64_t goals_ = 0;
  std::unique_ptr<Client> client_;  // goes first: its thread calls back
};

class FollowJointTrajectoryHandle : public ActionHandle<control_msgs::FollowJointTrajectoryAction>
{
public:
  using ActionHandle::ActionHandle;

protected:
  bool makeGoal(const moveit_msgs::RobotTrajectory& trajectory, control_msgs::FollowJointTrajectoryGoal& goal) override
  {
    if (!trajectory.multi_dof_joint_trajectory.points.empty())
      ROS_WARN_NAMED(log_names::CONTROLLER_MANAGER, "%s cannot execute multi-dof trajectories.", name_.c_str());
    if (trajectory.joint_trajectory.points.empty())
    {
      ROS_ERROR_NAMED(log_names::CONTROLLER_MANAGER, "The trajectory for '%s' has no points", name_.c_str());
      return false;
    }
    goal.trajectory = trajectory.joint_trajectory;
    goal.path_tolerance = path_;
    goal.goal_tolerance = end_;
    goal.goal_time_tolerance = late_;
    return true;
  }

  void explain(const control_msgs::FollowJointTrajectoryResult& result) override
  {
    if (result.error_code != control_msgs::FollowJointTrajectoryResult::SUCCESSFUL)
      ROS_WARN_NAMED(log_names::CONTROLLER_MANAGER, "Controller '%s' failed with error code %d: %s", name_.c_str(),
                     result.error_code, result.error_string.c_str());
  }

private:
  const std::vector<control_msgs::JointTolerance> path_ = entry_.tolerances("path_tolerance");
  const std::vector<control_msgs::JointTolerance> end_ = entry_.tolerances("goal_tolerance");
  const ros::Duration late_{ std::clamp(entry_.number("goal_time_tolerance", 0.0), -LONGEST, LONGEST) };
};

// The last point of a trajectory is where the gripper goes.
class GripperCommandHandle : public ActionHandle<control_msgs::GripperCommandAction>
{
public:
  using ActionHandle::ActionHandle;

protected:
  bool makeGoal(const moveit_msgs::RobotTrajectory& trajectory, control_msgs::GripperCommandGoal& goal) override
  {
    if (!trajectory.multi_dof_joint_trajectory.points.empty())
    {
      ROS_ERROR_NAMED(log_names::CONTROLLER_MANAGER, "%s cannot execute multi-dof trajectories", name_.c_str());
      return false;
    }
    if (trajectory.joint_trajectory.points.empty())
    {
      ROS_ERROR_NAMED(log_names::CONTROLLER_MANAGER, "%s requires at least one joint trajectory point, but none is given",
                      name_.c_str());
      return false;
    }
    const std::vector<std::size_t> commanded = commandedOf(trajectory.joint_trajectory.joint_names);
    const auto& last = trajectory.joint_trajectory.points.back();
    if (commanded.empty() || commanded.back() >= last.positions.size())
    {
      ROS_ERROR_NAMED(log_names::CONTROLLER_MANAGER, "%s found no %s of its own in the trajectory", name_.c_str(),
                      commanded.empty() ? "joint" : "position");
      return false;
    }
    for (std::size_t index : commanded)
      goal.command.position += last.positions[index];
    goal.command.max_effort = commanded.back() < last.effort.size() ? last.effort[commanded.back()] : max_effort_;
    return true;
  }

private:
  // Those that the gripper goes to the sum of, in the order of the trajectory.
  std::vector<std::size_t> commandedOf(const std::vector<std::string>& names) const
  {
    std::vector<std::string> mine = entry_.joints;
    if (!entry_.flag("parallel"))
    {
      const std::string command = entry_.text("command_joint");
      mine.assign(1, command.empty() && !entry_.joints.empty() ? entry_.joints[0] : command);
    }
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < names.size(); ++i)
      if (std::find(mine.begin(), mine.end(), names[i]) != mine.end())
        found.push_back(i);
    return found;
  }

  const double max_effort_ = entry_.number("max_effort", 0.0);
};
}  // namespace

Handles makeActionHandles(const std::vector<ControllerEntry>& entries)
{
  Handles handles;
  for (const ControllerEntry& entry : entries)
  {
    const std::string topic = entry.name.empty()        ? "/" + entry.action_ns
                              : entry.action_ns.empty() ? entry.name
                                                        : entry.name + "/" + entry.action_ns;
    if (entry.type == "FollowJointTrajectory")
      handles[entry.name] = std::make_shared<FollowJointTrajectoryHandle>(entry, topic);
    else if (entry.type == "GripperCommand" && entry.flag("parallel") && entry.joints.size() != 2)
      ROS_ERROR_NAMED(log_names::CONTROLLER_MANAGER, "Parallel Gripper requires exactly two joints: controller '%s' has %zu",
                      entry.name.c_str(), entry.joints.size());
    else if (entry.type == "GripperCommand")
      handles[entry.name] = std::make_shared<GripperCommandHandle>(entry, topic);
    else
      ROS_ERROR_NAMED(log_names::CONTROLLER_MANAGER,
                      "Unknown controller type: %s of controller '%s'; there are: FollowJointTrajectory, GripperCommand",
                      entry.type.c_str(), entry.name.c_str());
  }
  return handles;
}
}  // namespace trajectory_execution_manager
