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
constexpr double GONE = 1.0;     // s of wall time after which a server that is not there is taken for dead
using moveit_controller_manager::ExecutionStatus;
using Value = XmlRpc::XmlRpcValue;

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

double numberOf(Value& value)
{
  return value.getType() == Value::TypeDouble ? static_cast<double>(value)
         : value.getType() == Value::TypeInt  ? static_cast<int>(value)
                                              : 0.0;
}

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
    goal.path_tolerance = tolerances("path_tolerance");
    goal.goal_tolerance = tolerances("goal_tolerance");
    goal.goal_time_tolerance = ros::Duration(std::max(0.0, entry_.number("goal_time_tolerance", 0.0)));
    return true;
  }

  void explain(const control_msgs::FollowJointTrajectoryResult& result) override
  {
    if (result.error_code != control_msgs::FollowJointTrajectoryResult::SUCCESSFUL)
      ROS_WARN_NAMED(log_names::CONTROLLER_MANAGER, "Controller '%s' failed with error code %d: %s", name_.c_str(),
                     result.error_code, result.error_string.c_str());
  }

private:
  // A list of {name, position, velocity, acceleration}.
  std::vector<control_msgs::JointTolerance> tolerances(const char* key) const
  {
    std::vector<control_msgs::JointTolerance> rows;
    Value all = entry_.all;
    if (!all.hasMember(key) || all[key].getType() != Value::TypeArray)
      return rows;
    for (int i = 0; i < all[key].size(); ++i)
    {
      Value& row = all[key][i];
      if (row.getType() != Value::TypeStruct || !row.hasMember("name"))
        continue;
      rows.emplace_back();
      rows.back().name = static_cast<std::string>(row["name"]);
      rows.back().position = row.hasMember("position") ? numberOf(row["position"]) : 0.0;
      rows.back().velocity = row.hasMember("velocity") ? numberOf(row["velocity"]) : 0.0;
      rows.back().acceleration = row.hasMember("acceleration") ? numberOf(row["acceleration"]) : 0.0;
    }
    return rows;
  }
};

// The last point of a trajectory is where the gripper goes.
class GripperCommandHandle : public ActionHandle<control_msgs::GripperCommandAction>
{
public:
  using ActionHandle::ActionHandle;

protected:
  bool makeGoal(const moveit_msgs::RobotTrajectory& trajectory, control_msgs::GripperCommandGoal& goal) override
  {
    const auto& names = trajectory.joint_trajectory.joint_names;
    if (trajectory.joint_trajectory.points.empty())
    {
      ROS_ERROR_NAMED(log_names::CONTROLLER_MANAGER, "%s requires at least one joint trajectory point, but none is given",
                      name_.c_str());
      return false;
    }
    std::vector<std::string> commanded = entry_.joints;
    if (!entry_.flag("parallel") || commanded.size() != 2)
    {
      const std::string command = entry_.text("command_joint");
      commanded.assign(1, command.empty() && !entry_.joints.empty() ? entry_.joints[0] : command);
    }
    const auto& last = trajectory.joint_trajectory.points.back();
    bool any = false;
    for (const std::string& joint : commanded)
    {
      const std::size_t index = std::find(names.begin(), names.end(), joint) - names.begin();
      if (index >= names.size() || index >= last.positions.size())
        continue;
      goal.command.position += last.positions[index];
      goal.command.max_effort = !any && index < last.effort.size() ? last.effort[index] : entry_.number("max_effort", 0.0);
      any = true;
    }
    if (!any)
      ROS_ERROR_NAMED(log_names::CONTROLLER_MANAGER, "%s found no joint of its own in the trajectory", name_.c_str());
    return any;
  }
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
