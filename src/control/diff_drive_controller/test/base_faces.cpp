// Upstream's classes, driven from standard input; what a step gives goes to standard output.
//   limiter has low high has low high has low high     velocity, acceleration, jerk: a new one
//   limit v v0 v1 dt
//   sides window separation radius radius | axle window base radius     a new odometry
//   init time | update one other time | open linear angular time
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>
#include <type_traits>

#include <ackermann_steering_controller/odometry.h>
#include <diff_drive_controller/odometry.h>
#include <four_wheel_steering_controller/speed_limiter.h>

namespace
{

static_assert(std::is_same<four_wheel_steering_controller::SpeedLimiter, diff_drive_controller::SpeedLimiter>::value, "");

template <class Odometry>
void step(Odometry& odometry, const std::string& word, const double* n)
{
  if (word == "init")
    odometry.init(ros::Time(n[0]));
  else if (word == "update")
    odometry.update(n[0], n[1], ros::Time(n[2]));
  else
    odometry.updateOpenLoop(n[0], n[1], ros::Time(n[2]));
  std::printf("%a %a %a %a %a\n", odometry.getX(), odometry.getY(), odometry.getHeading(), odometry.getLinear(),
              odometry.getAngular());
}

}  // namespace

int main()
{
  diff_drive_controller::SpeedLimiter limiter;
  std::unique_ptr<diff_drive_controller::Odometry> sides;
  std::unique_ptr<ackermann_steering_controller::Odometry> axle;
  for (std::string line; std::getline(std::cin, line);)
  {
    std::istringstream in(line);
    std::string word, number;
    in >> word;
    double n[9] = {};
    for (double& value : n)
      if (in >> number)
        value = std::strtod(number.c_str(), nullptr);  // also inf and nan
    if (word == "limiter")
    {
      limiter = { n[0] != 0.0, n[3] != 0.0, n[6] != 0.0, n[1], n[2], n[4], n[5], n[7], n[8] };
      std::puts("new");
    }
    else if (word == "limit")
    {
      limiter.limit(n[0], n[1], n[2], n[3]);
      std::printf("%a\n", n[0]);
    }
    else if (word == "sides")
    {
      axle.reset();
      sides.reset(new diff_drive_controller::Odometry(static_cast<std::size_t>(n[0])));
      sides->setWheelParams(n[1], n[2], n[3]);
      std::puts("new");
    }
    else if (word == "axle")
    {
      axle.reset(new ackermann_steering_controller::Odometry(static_cast<std::size_t>(n[0])));
      axle->setWheelParams(n[1], n[2]);
      std::puts("new");
    }
    else if (axle)
      step(*axle, word, n);
    else
      step(*sides, word, n);
  }
}
