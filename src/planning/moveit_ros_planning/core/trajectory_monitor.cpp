#include <moveit/planning_scene_monitor/trajectory_monitor.h>

#include <chrono>
#include <limits>

#include "log_names.hpp"

namespace planning_scene_monitor
{
TrajectoryMonitor::TrajectoryMonitor(const CurrentStateMonitorConstPtr& state_monitor, double sampling_frequency)
  : state_monitor_(state_monitor)
  , sampling_frequency_(sampling_frequency)
  , trajectory_(state_monitor_->getRobotModel(), "")
{
}

TrajectoryMonitor::~TrajectoryMonitor() { stopTrajectoryMonitor(); }

void TrajectoryMonitor::setSamplingFrequency(double sampling_frequency)
{
  if (sampling_frequency != sampling_frequency_ && sampling_frequency <= std::numeric_limits<double>::epsilon())
    ROS_INFO_NAMED(log_names::TRAJECTORY_MONITOR, "Disabling trajectory recording");
  sampling_frequency_ = sampling_frequency;
}

void TrajectoryMonitor::startTrajectoryMonitor()
{
  if (isActive() || !(sampling_frequency_ > std::numeric_limits<double>::epsilon()))
    return;
  stopping_ = false;
  thread_ = std::thread([this] { record(); });
}

void TrajectoryMonitor::stopTrajectoryMonitor()
{
  if (!isActive())
    return;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
  }
  stop_.notify_all();
  thread_.join();
}

void TrajectoryMonitor::clearTrajectory()
{
  const bool restart = isActive();
  stopTrajectoryMonitor();
  trajectory_.clear();
  if (restart)
    startTrajectoryMonitor();
}

// Simulated time may stand still for as long as it likes: it is looked at, and never slept by.
void TrajectoryMonitor::record()
{
  const ros::Duration period(1.0 / sampling_frequency_);
  ros::Time due = ros::Time::now() + period;
  std::unique_lock<std::mutex> lock(mutex_);
  while (!stop_.wait_for(lock, std::chrono::milliseconds(2), [this] { return stopping_; }))
  {
    const ros::Time now = ros::Time::now();
    if (now < due)
      continue;
    due = std::max(due + period, now);
    const auto [state, stamp] = state_monitor_->getCurrentStateAndTime();
    trajectory_.addSuffixWayPoint(state, trajectory_.empty() ? 0.0 : (stamp - last_).toSec());
    last_ = stamp;
    if (state_add_callback_)
      state_add_callback_(state, stamp);
  }
}
}  // namespace planning_scene_monitor
