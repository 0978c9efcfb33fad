// Upstream's handles, driven from standard input: a word and its numbers on each line, the command for each step to standard output.
//   joint KIND SOFT POSITION_LIMITS VELOCITY_LIMITS ACCELERATION_LIMITS EFFORT_LIMITS xmin xmax V A E smin smax kp kv   a new handle
//   step command position velocity dt
//   reset
//   parameters XML             what a map of parameters, as XML-RPC writes it, makes of the limits of limit_source_cases.py
//   description KIND lower upper velocity effort    the same of a <limit>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <sstream>
#include <string>

#include <joint_limits_interface/joint_limits_interface.h>
#include <joint_limits_interface/joint_limits_rosparam.h>
#include <joint_limits_interface/joint_limits_urdf.h>

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

/// BEFORE of limit_source_cases.py.
JointLimits before()
{
  JointLimits limits;
  limits.has_position_limits = limits.has_velocity_limits = limits.has_acceleration_limits = limits.has_jerk_limits = true;
  limits.min_position = -3.0;
  limits.max_position = 3.0;
  limits.max_velocity = 1.0;
  limits.max_acceleration = 5.0;
  limits.max_jerk = 7.0;
  return limits;
}

void print(const JointLimits& l)
{
  std::printf("%a %a %a %a %a %a %d %d %d %d %d %d", l.min_position, l.max_position, l.max_velocity, l.max_acceleration,
              l.max_jerk, l.max_effort, l.has_position_limits, l.has_velocity_limits, l.has_acceleration_limits,
              l.has_jerk_limits, l.has_effort_limits, l.angle_wraparound);
}

/// The limits, whether there are soft ones, and these.
void print_parameters(std::istream& in)
{
  std::string xml;
  std::getline(in, xml);
  int offset = 0;
  const internal::ParameterMap values(XmlRpc::XmlRpcValue(xml, &offset));
  JointLimits limits = before();
  apply_parameters(values, limits);
  SoftJointLimits soft;
  const bool is_soft = apply_soft_parameters(values, soft);
  print(limits);
  std::printf(" %d %a %a %a %a\n", is_soft, soft.min_position, soft.max_position, soft.k_position, soft.k_velocity);
}

void print_description(std::istream& in)
{
  static const std::map<std::string, decltype(urdf::Joint::REVOLUTE)> kinds = {
    { "revolute", urdf::Joint::REVOLUTE }, { "prismatic", urdf::Joint::PRISMATIC }, { "continuous", urdf::Joint::CONTINUOUS },
    { "fixed", urdf::Joint::FIXED },       { "planar", urdf::Joint::PLANAR },       { "floating", urdf::Joint::FLOATING }
  };
  std::string kind;
  in >> kind;
  auto joint = std::make_shared<urdf::Joint>();
  joint->type = kinds.at(kind);
  joint->limits = std::make_shared<urdf::JointLimits>();
  for (double* value : { &joint->limits->lower, &joint->limits->upper, &joint->limits->velocity, &joint->limits->effort })
    *value = number(in);
  JointLimits limits = before();
  getJointLimits(joint, limits);
  print(limits);
  std::puts("");
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
    else if (word == "parameters")
      print_parameters(in);
    else if (word == "description")
      print_description(in);
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
