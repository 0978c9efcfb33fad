// The system's time for a control loop that has a clock of its own.
#pragma once

#include <mutex>
#include <thread>

#include <ros/time.h>

namespace realtime_tools
{

/// A thread compares the two clocks every millisecond, so that the loop need not ask the system.
class RealtimeClock
{
public:
  RealtimeClock();
  ~RealtimeClock();
  RealtimeClock(const RealtimeClock&) = delete;
  RealtimeClock& operator=(const RealtimeClock&) = delete;

  /// System time at \p realtime_time, to be called by the loop; zero until the clocks have been compared.
  ros::Time getSystemTime(const ros::Time& realtime_time);
  /// What the thread does until the clock is destroyed.
  void loop();

private:
  std::mutex mutex_;
  ros::Time system_time_, last_realtime_time_;
  ros::Duration clock_offset_;
  unsigned int lock_misses_ = 0;
  bool running_ = false;
  bool initialized_ = false;
  std::thread thread_;
};

}  // namespace realtime_tools
