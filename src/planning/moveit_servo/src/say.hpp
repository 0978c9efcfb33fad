// Lines that come again and again, by the clock on the wall: ROS_WARN_THROTTLE says nothing in the first period of simulated time.
#pragma once

#include <atomic>
#include <cstdlib>

#include <ros/ros.h>

namespace moveit_servo
{
class Every
{
public:
  explicit Every(double seconds) : seconds_(seconds) {}
  bool isDue()
  {
    const double now = ros::WallTime::now().toSec();
    double last = last_;
    return now - last >= seconds_ && last_.compare_exchange_strong(last, now);
  }

private:
  const double seconds_;
  std::atomic<double> last_{ 0.0 };
};

// Static objects are not taken down under the threads that use them.
[[noreturn]] inline void endProgram()
{
  ros::shutdown();
  std::_Exit(EXIT_FAILURE);
}
}  // namespace moveit_servo

// LOG is ROS_WARN_NAMED or one of its kin, the rest its arguments.
#define SAY_EVERY(seconds, LOG, ...)           \
  do                                           \
  {                                            \
    static moveit_servo::Every every(seconds); \
    if (every.isDue())                         \
      LOG(__VA_ARGS__);                        \
  } while (false)
