// Upstream's handles, driven from standard input: a word and its numbers on each line, the command for each step to standard output.
//   joint KIND SOFT POSITION_LIMITS VELOCITY_LIMITS ACCELERATION_LIMITS EFFORT_LIMITS xmin xmax V A E smin smax kp kv   a new handle
//   step command position velocity dt
//   reset
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>

#include <joint_limits_interface/joint_limits_interface.h>

using namespace joint_limits_interface;

namespace
{

double position, velocity, effort, command;

struct Handle
{
  std::function<void(double)> enforce;
  std::function<void()> reset;
};

double number(std::istream& in)
{
  std::string text;
  in >> text;
  return std::strtod(text.c_str(), nullptr);  // also inf and nan
}

template <class Face>
Handle handle_of(Face face)
{
  auto kept = std::make_shared<Face>(face);
  return { [kept](double dt) { kept->enforceLimits(ros::Duration(dt)); }, [kept] { kept->reset(); } };
}

Handle made(std::istream& in)
{
  std::string kind;
  in >> kind;
  const bool is_soft = number(in) != 0.0;
  JointLimits hard;
  SoftJointLimits soft;
  for (bool* flag :
       { &hard.has_position_limits, &hard.has_velocity_limits, &hard.has_acceleration_limits, &hard.has_effort_limits })
    *flag = number(in) != 0.0;
  for (double* value : { &hard.min_position, &hard.max_position, &hard.max_velocity, &hard.max_acceleration, &hard.max_effort,
                         &soft.min_position, &soft.max_position, &soft.k_position, &soft.k_velocity })
    *value = number(in);
  const hardware_interface::JointHandle joint(hardware_interface::JointStateHandle("j", &position, &velocity, &effort),
                                              &command);
  if (kind == "position")
    return is_soft ? handle_of(PositionJointSoftLimitsHandle(joint, hard, soft))
                   : handle_of(PositionJointSaturationHandle(joint, hard));
  if (kind == "velocity")
    return is_soft ? handle_of(VelocityJointSoftLimitsHandle(joint, hard, soft))
                   : handle_of(VelocityJointSaturationHandle(joint, hard));
  return is_soft ? handle_of(EffortJointSoftLimitsHandle(joint, hard, soft))
                 : handle_of(EffortJointSaturationHandle(joint, hard));
}

}  // namespace

int main()
{
  ros::Time::init();
  Handle handle;
  for (std::string line; std::getline(std::cin, line);)
  {
    std::istringstream in(line);
    std::string word;
    in >> word;
    if (word == "joint")
    {
      handle = made(in);
      std::puts("joint");
    }
    else if (word == "reset")
      handle.reset();
    else
    {
      command = number(in);
      position = number(in);
      velocity = number(in);
      handle.enforce(number(in));
      std::printf("%a\n", command);
    }
  }
}
