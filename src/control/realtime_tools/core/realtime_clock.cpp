#include <realtime_tools/realtime_clock.h>

#include <chrono>

#include <ros/console.h>

namespace realtime_tools
{

RealtimeClock::RealtimeClock() : running_(true), thread_(&RealtimeClock::loop, this) {}

RealtimeClock::~RealtimeClock()
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    running_ = false;
  }
  thread_.join();
}

ros::Time RealtimeClock::getSystemTime(const ros::Time& realtime_time)
{
  const std::unique_lock<std::mutex> lock(mutex_, std::try_to_lock);
  if (!lock.owns_lock())
  {
    ++lock_misses_;
    return realtime_time + clock_offset_;
  }
  lock_misses_ = 0;
  last_realtime_time_ = realtime_time;
  if (!initialized_)
    return ros::Time();
  return realtime_time + clock_offset_;
}

void RealtimeClock::loop()
{
  while (true)
  {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!running_)
        return;
      if (!last_realtime_time_.isZero())
      {
        // The first comparison counts whole; later ones smooth out how late this thread is.
        const double now = (ros::Time::now() - last_realtime_time_).toSec();
        clock_offset_ = ros::Duration(initialized_ ? clock_offset_.toSec() * 0.9999 + now * 0.0001 : now);
        initialized_ = true;
      }
      if (lock_misses_ > 100)
        ROS_WARN_THROTTLE(1.0, "The time estimator has trouble transferring data between non-RT and RT");
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

}  // namespace realtime_tools
