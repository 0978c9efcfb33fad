// Controllers that only publish the joint states which a robot would have.
#include <ros/ros.h>
#include <sensor_msgs/JointState.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "built_in_controllers.hpp"
#include "log_names.hpp"

namespace trajectory_execution_manager
{
namespace
{
using moveit_controller_manager::ExecutionStatus;
using trajectory_msgs::JointTrajectory;

class FakeHandle : public moveit_controller_manager::MoveItControllerHandle
{
public:
  FakeHandle(const ControllerEntry& entry, const ros::Publisher& publisher, double rate)
    : MoveItControllerHandle(entry.name)
    , kind_(entry.type)
    , rate_(rate)
    , publisher_(publisher)
  {
  }
  ~FakeHandle() override { FakeHandle::cancelExecution(); }

  bool sendTrajectory(const moveit_msgs::RobotTrajectory& trajectory) override
  {
    cancelExecution();
    ROS_INFO_NAMED(log_names::FAKE_CONTROLLER_MANAGER, "Fake execution of trajectory");
    stop_ = false;
    status_ = ExecutionStatus::RUNNING;
    thread_ = std::thread([this, points = trajectory.joint_trajectory]() {
      if (!points.points.empty())
        move(points);
      std::lock_guard<std::mutex> lock(lock_);
      status_ = stop_ ? ExecutionStatus::PREEMPTED : ExecutionStatus::SUCCEEDED;
      ended_.notify_all();
    });
    return true;
  }

  bool cancelExecution() override
  {
    stop_ = true;
    if (thread_.joinable())
      thread_.join();
    return true;
  }

  bool waitForExecution(const ros::Duration& timeout) override
  {
    const ros::Time until = ros::Time::now() + timeout;
    std::unique_lock<std::mutex> lock(lock_);
    while (status_ == ExecutionStatus::RUNNING)
    {
      if (!ros::ok() || (!timeout.isZero() && ros::Time::now() > until))
        return false;
      ended_.wait_for(lock, std::chrono::milliseconds(20));
    }
    return true;
  }

  ExecutionStatus getLastExecutionStatus() override
  {
    std::lock_guard<std::mutex> lock(lock_);
    return status_;
  }

private:
  // In ROS time; false when stopped.
  bool until(const ros::Time& when) const
  {
    while (ros::ok() && !stop_)
    {
      const double left = (when - ros::Time::now()).toSec();
      if (left <= 0.0)
        return true;
      ros::WallDuration(std::min(left, 0.01)).sleep();
    }
    return false;
  }

  void publish(const JointTrajectory& trajectory, const std::vector<double>& positions) const
  {
    sensor_msgs::JointState message;
    message.header.stamp = ros::Time::now();
    message.name = trajectory.joint_names;
    message.position = positions;
    publisher_.publish(message);
  }

  void move(const JointTrajectory& trajectory) const
  {
    const ros::Time start = ros::Time::now();
    if (kind_ == "via points")
    {
      for (const auto& point : trajectory.points)
        if (until(start + point.time_from_start))
          publish(trajectory, point.positions);
    }
    else if (kind_ == "interpolate")
      interpolate(trajectory, start);
    else
    {
      publish(trajectory, trajectory.points.back().positions);
      until(start + ros::Duration(0.5));
    }
  }

  void interpolate(const JointTrajectory& trajectory, const ros::Time& start) const
  {
    const auto& points = trajectory.points;
    for (ros::Time next = start + ros::Duration(1.0 / rate_); next < start + points.back().time_from_start;
         next += ros::Duration(1.0 / rate_))
    {
      if (!until(next))
        return;
      const ros::Duration now = ros::Time::now() - start;
      const auto after =
          std::find_if(points.begin(), points.end(), [&](const auto& point) { return point.time_from_start > now; });
      if (after == points.begin() || after == points.end())
        continue;
      const auto& a = *(after - 1);
      const double share = (now - a.time_from_start).toSec() / (after->time_from_start - a.time_from_start).toSec();
      std::vector<double> positions;
      for (std::size_t k = 0; k < a.positions.size(); ++k)
        positions.push_back(a.positions[k] + share * (after->positions[k] - a.positions[k]));
      publish(trajectory, positions);
    }
    if (until(start + points.back().time_from_start))
      publish(trajectory, points.back().positions);
  }

  const std::string kind_;
  const double rate_;
  const ros::Publisher publisher_;
  std::atomic<bool> stop_{ false };
  std::thread thread_;
  std::mutex lock_;
  std::condition_variable ended_;
  ExecutionStatus status_ = ExecutionStatus::SUCCEEDED;
};

// The poses that ~initial names, so that the robot has a state before it moves.
void publishInitial(const ros::NodeHandle& nh, const moveit::core::RobotModel& model, const ros::Publisher& publisher)
{
  XmlRpc::XmlRpcValue entries;
  if (!nh.getParam("initial", entries) || entries.getType() != XmlRpc::XmlRpcValue::TypeArray)
    return;
  std::map<std::string, double> values;
  for (int i = 0; i < entries.size(); ++i)
  {
    ControllerEntry entry;
    entry.all = entries[i];
    const std::string group = entry.text("group"), pose = entry.text("pose");
    std::map<std::string, double> own;
    if (!model.hasJointModelGroup(group) || !model.getJointModelGroup(group)->getVariableDefaultPositions(pose, own))
      ROS_WARN_NAMED(log_names::FAKE_CONTROLLER_MANAGER, "initial: the robot has no pose '%s' of a group '%s'", pose.c_str(),
                     group.c_str());
    values.insert(own.begin(), own.end());
  }
  sensor_msgs::JointState message;
  message.header.stamp = ros::Time::now();
  for (const auto& value : values)
  {
    message.name.push_back(value.first);
    message.position.push_back(value.second);
  }
  if (!values.empty())
    publisher.publish(message);
}
}  // namespace

Handles makeFakeHandles(const std::vector<ControllerEntry>& entries, const ros::NodeHandle& nh,
                        const moveit::core::RobotModel& model)
{
  ros::NodeHandle node(nh);
  const ros::Publisher publisher = node.advertise<sensor_msgs::JointState>("fake_controller_joint_states", 100, true);
  double rate = 10.0;
  nh.getParam("fake_interpolating_controller_rate", rate);
  Handles handles;
  for (const ControllerEntry& entry : entries)
    handles[entry.name] = std::make_shared<FakeHandle>(entry, publisher, std::max(0.1, rate));
  publishInitial(nh, model, publisher);
  return handles;
}
}  // namespace trajectory_execution_manager
