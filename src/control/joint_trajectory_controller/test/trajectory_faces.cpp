// The classes of C++ with upstream's names, driven from standard input; what they answer goes to standard output, one line for each.
//   segment start end p0 v0 a0 p1 v1 a1 and whether v0 a0 v1 a1 are there | sample time | stop start p v duration time
//   error measured desired angular | position error tolerance | velocity error tolerance | override tolerance asked | turns from to
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include <joint_trajectory_controller/joint_trajectory_segment.h>
#include <joint_trajectory_controller/stop_trajectory_builder.h>
#include <joint_trajectory_controller/tolerances.h>
#include <trajectory_interface/quintic_spline_segment.h>

namespace
{

using namespace joint_trajectory_controller;
using Spline = trajectory_interface::QuinticSplineSegment<double>;
using Segment = JointTrajectorySegment<Spline>;

void answer(const std::vector<double>& numbers)
{
  for (std::size_t i = 0; i < numbers.size(); ++i)
    std::printf(i + 1 < numbers.size() ? "%a " : "%a\n", numbers[i]);
}

void answer(const Spline& segment, double time)
{
  Spline::State state;
  segment.sample(time, state);
  answer({ state.position[0], state.velocity[0], state.acceleration[0] });
}

Spline segment(const std::vector<double>& n)
{
  Spline::State first, last;
  first.position = { n[2] };
  last.position = { n[5] };
  if (n[8] != 0.0)
    first.velocity = { n[3] };
  if (n[9] != 0.0)
    first.acceleration = { n[4] };
  if (n[10] != 0.0)
    last.velocity = { n[6] };
  if (n[11] != 0.0)
    last.acceleration = { n[7] };
  return Spline(n[0], first, n[1], last);
}

void stop(const std::vector<double>& n)
{
  Segment::State from(1);
  from.position[0] = n[1];
  from.velocity[0] = n[2];
  const Segment::State zero(1);
  std::vector<std::vector<Segment>> trajectory(1, std::vector<Segment>(1, Segment(0.0, zero, 0.0, zero)));
  StopTrajectoryBuilder<Spline>(n[3], from).setStartTime(n[0])->buildTrajectory(&trajectory);
  answer(trajectory[0][0], n[4]);
}

double over(bool of_position, double error, double tolerance)
{
  Spline::State state(1);
  (of_position ? state.position : state.velocity)[0] = error;
  return checkStateTolerancePerJoint(state,
                                     StateTolerances<double>(of_position ? tolerance : 0.0, of_position ? 0.0 : tolerance))
             ? 0.0
             : 1.0;
}

double overridden(double tolerance, double asked)
{
  StateTolerances<double> tolerances(tolerance);
  control_msgs::JointTolerance message;
  message.position = asked;
  updateStateTolerances(message, tolerances);
  return tolerances.position;
}

}  // namespace

int main()
{
  Spline current;
  for (std::string line; std::getline(std::cin, line);)
  {
    std::istringstream in(line);
    std::string word, text;
    in >> word;
    std::vector<double> n;
    while (in >> text)
      n.push_back(std::strtod(text.c_str(), nullptr));  // also inf and nan
    if (word == "segment")
      current = segment(n);
    else if (word == "sample")
      answer(current, n[0]);
    else if (word == "stop")
      stop(n);
    else if (word == "error")
      answer({ law::position_error(n[0], n[1], n[2] != 0.0) });
    else if (word == "override")
      answer({ overridden(n[0], n[1]) });
    else if (word == "turns")
      answer({ wraparoundJointOffset(n[0], n[1], true) });
    else
      answer({ over(word == "position", n[0], n[1]) });
  }
}
