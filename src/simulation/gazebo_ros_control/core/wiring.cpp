#include "wiring.hpp"

#include <cmath>
#include <stdexcept>

namespace gazebo_ros_control
{
namespace
{

using joint_limits_interface::LimitRule;

bool is_position(LimitRule rule) { return rule == LimitRule::PositionSaturation || rule == LimitRule::PositionSoft; }

/// What other limits than that of the effort made of a command is no law.
bool is_law(double wanted, double allowed, double effort_limit)
{
  return wanted == allowed ||
         (effort_limit <= std::abs(allowed) && std::abs(allowed) < std::abs(wanted) && std::isfinite(wanted));
}

}  // namespace

int Wiring::add_joint(ode_sim::Joint& joint, const Places& places)
{
  if (!places.position || !places.velocity)
    throw std::invalid_argument("a wired joint needs places for its position and velocity");
  Wired wired;
  wired.joint = &joint;
  wired.places = places;
  joints_.push_back(wired);
  return static_cast<int>(joints_.size()) - 1;
}

int Wiring::add_command(int joint, const Command& command)
{
  joints_.at(joint);
  if (!command.command || !command.limiter)
    throw std::invalid_argument("a command needs a place and limits");
  commands_.push_back(command);
  return static_cast<int>(commands_.size()) - 1;
}

void Wiring::engage(int joint, int command)
{
  Wired& wired = joints_.at(joint);
  if (wired.engaged == command)
    return;
  if (command >= 0)
    commands_.at(command);
  wired.engaged = command;
  wired.stopped_at = *wired.places.position;
}

void Wiring::stop(bool active)
{
  if (active && !stopped_)
    for (Wired& wired : joints_)
      wired.stopped_at = *wired.places.position;
  stopped_ = active;
}

void Wiring::read()
{
  for (Wired& wired : joints_)
  {
    *wired.places.position = joint_position(*wired.joint);
    *wired.places.velocity = joint_velocity(*wired.joint);
    if (wired.by_load && wired.places.effort)
      *wired.places.effort = joint_load(*wired.joint);
  }
}

std::vector<Wiring::Refused> Wiring::write(double dt)
{
  std::vector<Refused> refused;
  for (Wired& wired : joints_)
  {
    if (wired.engaged < 0)
      continue;
    const Command& command = commands_[wired.engaged];
    if (stopped_ && is_position(command.limiter->rule()))
      *command.command = wired.stopped_at;
    const double wanted = *command.command;
    if (!command.limiter->enforce(*command.command, *wired.places.position, *wired.places.velocity, dt))
      refused.push_back({ wired.engaged, wanted });
    give(wired, command, wanted);
  }
  return refused;
}

void Wiring::give(const Wired& wired, const Command& command, double wanted)
{
  ode_sim::Joint& joint = *wired.joint;
  const double allowed = *command.command;
  switch (command.limiter->rule())
  {
    case LimitRule::PositionSaturation:
    case LimitRule::PositionSoft:
      joint_drive(joint, allowed);
      return;
    case LimitRule::VelocitySaturation:
    case LimitRule::VelocitySoft:
      joint_motor(joint, stopped_ ? 0.0 : allowed, command.effort_limit);
      return;
    case LimitRule::EffortSaturation:
    case LimitRule::EffortSoft:
      break;
  }
  const double slope = command.slope ? *command.slope : 0.0;
  if (stopped_)
    joint_push(joint, 0.0);
  else if (slope != 0.0 && is_law(wanted, allowed, command.effort_limit))
    joint_law(joint, wanted, slope, command.effort_limit);
  else
    joint_push(joint, allowed);
  if (wired.places.effort)
    *wired.places.effort = joint_effort(joint);
}

}  // namespace gazebo_ros_control
