// Records where a robot goes.
#pragma once

#include <boost/function.hpp>
#include <condition_variable>
#include <mutex>
#include <thread>

#include <moveit/macros/class_forward.h>
#include <moveit/planning_scene_monitor/current_state_monitor.h>
#include <moveit/robot_trajectory/robot_trajectory.h>

namespace planning_scene_monitor
{
using TrajectoryStateAddedCallback = boost::function<void(const moveit::core::RobotStateConstPtr&, const ros::Time&)>;

MOVEIT_CLASS_FORWARD(TrajectoryMonitor);

// A thread of its own takes the monitor's state at the frequency (Hz of ROS time; 0: never), from one period after the start on. Times
// of the trajectory are those of the states' stamps.
class TrajectoryMonitor
{
public:
  TrajectoryMonitor(const CurrentStateMonitorConstPtr& state_monitor, double sampling_frequency = 0.0);
  ~TrajectoryMonitor();

  void startTrajectoryMonitor();
  void stopTrajectoryMonitor();  // returns when the last state is in
  void clearTrajectory();
  bool isActive() const { return thread_.joinable(); }
  double getSamplingFrequency() const { return sampling_frequency_; }
  void setSamplingFrequency(double sampling_frequency);  // from the next start on

  // Only while it does not record.
  const robot_trajectory::RobotTrajectory& getTrajectory() { return trajectory_; }
  void swapTrajectory(robot_trajectory::RobotTrajectory& other) { trajectory_.swap(other); }
  void setOnStateAddCallback(const TrajectoryStateAddedCallback& callback) { state_add_callback_ = callback; }

private:
  void record();

  CurrentStateMonitorConstPtr state_monitor_;
  double sampling_frequency_;
  robot_trajectory::RobotTrajectory trajectory_;
  ros::Time last_;
  TrajectoryStateAddedCallback state_add_callback_;
  std::mutex mutex_;
  std::condition_variable stop_;
  bool stopping_ = false;
  std::thread thread_;
};
}  // namespace planning_scene_monitor
