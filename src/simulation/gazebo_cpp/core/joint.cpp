// Joint.
#include <gazebo/physics/physics.hh>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

#include <limits.hpp>

#include "mirror.hpp"

namespace gazebo
{
namespace physics
{

using ignition::math::Pose3d;
using ignition::math::Vector3d;

namespace
{

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// As descriptions write "none".
double written(double limit) { return std::isinf(limit) ? std::copysign(1e16, limit) : limit; }
double read(double limit) { return std::abs(limit) >= ode_sim::kUnlimited ? std::copysign(ode_sim::kInf, limit) : limit; }

}  // namespace

bool Joint::AreConnected(LinkPtr one, LinkPtr two) const
{
  return (core_ || weld_) && ((one == parent_ && two == child_) || (one == child_ && two == parent_));
}

void Joint::Reset() { SetVelocity(0, 0); }

// -- state --------------------------------------------------------------------------------------------------------------------------

unsigned int Joint::DOF() const { return static_cast<unsigned int>(wanted().axis_count); }

double Joint::Position(unsigned int index) const
{
  const auto* axis = axis_of(core_, index);
  return axis ? axis->q : nan;
}

double Joint::GetVelocity(unsigned int index) const
{
  const auto* axis = axis_of(core_, index);
  return axis ? axis->qd : 0.0;
}

double Joint::GetForce(unsigned int index)
{
  const auto* axis = axis_of(core_, index);
  return axis ? axis->effort_now() : 0.0;
}

void Joint::SetForce(unsigned int index, double effort)
{
  auto* axis = axis_of(core_, index);
  if (!axis)
    return refused("joint " + GetScopedName() + " has no axis " + std::to_string(index) + " for SetForce()");
  if (std::isnan(effort))
    return refused("a force on joint " + GetScopedName() + " is not a number; it is left out");
  ode_sim::add_force(*axis, effort);
}

double Joint::CheckAndTruncateForce(unsigned int index, double effort)
{
  const auto* axis = axis_of(core_, index);
  return axis ? axis->admitted(effort) : effort;
}

// With their velocities kept, the links beyond go on as they went: who steers so in every step would else hold what falls or rolls.
bool Joint::SetPosition(unsigned int index, double position, bool preserve_velocity)
{
  auto* axis = axis_of(core_, index);
  if (!axis)
    return false;
  bool done = false;
  change(GetScopedName(), [&] {
    ode_sim::World* core = world_of(core_->model);
    if (!core)
      return;
    std::vector<std::tuple<ode_sim::Link*, ode_sim::Vec3, ode_sim::Vec3>> kept;
    if (preserve_velocity)
      for (ode_sim::Link* link : ode_sim::links_beyond(*core_))
        kept.emplace_back(link, link->v, link->w);
    const double rate = axis->qd;
    done =
        core->set_joint_position(*core_, static_cast<int>(index), ode_sim::limited(position, ode_sim::kFarthest, "a position"));
    for (const auto& [link, v, w] : kept)
      core->set_link_twist(*link, v, w);
    if (preserve_velocity)
      axis->qd = rate;
  });
  return done;
}

// As the original: the child alone gets the velocity that the joint then has.
void Joint::SetVelocity(unsigned int index, double velocity)
{
  if (!axis_of(core_, index) || core_->type == ode_sim::JointType::Ball || !core_->holds())
    return;
  Vector3d v, w;
  const Vector3d at = Anchor(0);
  if (parent_)
  {
    w = parent_->WorldAngularVel();
    v = parent_->WorldLinearVel(at - parent_->WorldPose().Pos(), ignition::math::Quaterniond::Identity);
  }
  if (core_->type == ode_sim::JointType::Prismatic)
  {
    v += velocity * GlobalAxis(index);
  }
  else if (core_->type == ode_sim::JointType::Screw)
  {
    const double turn = index == 0 ? velocity : velocity / core_->slides();
    v += turn * core_->slides() * GlobalAxis(0);
    w += turn * GlobalAxis(0);
  }
  else
  {
    w += velocity * GlobalAxis(index);
    if (core_->axis_count == 2)
      w += GetVelocity(1 - index) * GlobalAxis(1 - index);
  }
  child_->SetWorldTwist(v + w.Cross(child_->WorldPose().Pos() - at), w);
}

JointWrench Joint::GetForceTorque(unsigned int)
{
  JointWrench wrench;
  const auto& link = child_ ? child_ : parent_;
  if (!link)
    return wrench;
  SetProvideFeedback(true);
  // What the links exert on the joint, each in its own axes, torques about the anchor.
  const ode_sim::Feedback f = feedback();
  const auto child = link->WorldPose().Rot();
  const auto parent = child_ && parent_ ? parent_->WorldPose().Rot() : ignition::math::Quaterniond::Identity;
  wrench.body2Force = child.RotateVectorReverse(-ign(f.child_force));
  wrench.body2Torque = child.RotateVectorReverse(-ign(f.child_torque));
  wrench.body1Force = parent.RotateVectorReverse(-ign(f.parent_force));
  wrench.body1Torque = parent.RotateVectorReverse(-ign(f.parent_torque));
  return wrench;
}

void Joint::SetProvideFeedback(bool enable)
{
  if (!core_ || core_->watched || !enable)
    return;
  core_->watched = true;
  core_->model->dirty = true;
}

Vector3d Joint::LinkForce(unsigned int index) const
{
  const ode_sim::Feedback f = feedback();
  return ign(index == 0 ? f.child_force : f.parent_force);
}

Vector3d Joint::LinkTorque(unsigned int index) const
{
  const ode_sim::Feedback f = feedback();
  return ign(index == 0 ? f.child_torque : f.parent_torque);
}

// -- parameters ---------------------------------------------------------------------------------------------------------------------

bool Joint::SetParam(const std::string& key, unsigned int index, const boost::any& value)
{
  const double* number = boost::any_cast<double>(&value);
  if (!number || std::isnan(*number))
  {
    refused("joint " + GetScopedName() + ": SetParam(\"" + key + "\") takes a number that is a double");
    return false;
  }
  if (key == "hi_stop")
    SetUpperLimit(index, *number);
  else if (key == "lo_stop")
    SetLowerLimit(index, *number);
  else if (key == "stop_erp")
    wanted().stop_erp = std::min(std::max(*number, 0.0), 10.0), changed();
  else if (key == "stop_cfm")
    wanted().stop_cfm = std::min(std::max(*number, 0.0), ode_sim::kStiffest), changed();
  else if (key == "thread_pitch" || key == "gearbox_ratio")
  {
    if (!core_)
      return key == "thread_pitch" && *number != 0 && (wanted().thread_pitch = *number, true);
    const auto set = key == "thread_pitch" ? ode_sim::set_thread_pitch : ode_sim::set_gear_ratio;
    bool done = false;
    change(GetScopedName(), [&] { set(*core_, *number), done = true; });
    return done;
  }
  else if (auto* axis = settings(index))
  {
    if (key == "fmax")
      ode_sim::set_motor(*axis, axis->motor_velocity, std::max(*number, 0.0));
    else if (key == "vel")
      ode_sim::set_motor(*axis, *number, axis->motor_force);
    else if (key == "friction")
      axis->friction = std::max(*number, 0.0), changed();
    else if (key == "erp" || key == "cfm" || key == "fudge_factor" || key == "suspension_erp" || key == "suspension_cfm")
      params_[key] = *number;
    else
    {
      refused("joint " + GetScopedName() + " has no parameter '" + key + "'");
      return false;
    }
  }
  else if (DOF() == 0)
    params_[key] = *number;
  else
    return false;
  return true;
}

double Joint::GetParam(const std::string& key, unsigned int index)
{
  if (key == "hi_stop")
    return UpperLimit(index);
  if (key == "lo_stop")
    return LowerLimit(index);
  if (key == "stop_erp")
    return wanted().stop_erp;
  if (key == "stop_cfm")
    return wanted().stop_cfm;
  if (key == "thread_pitch")
    return wanted().thread_pitch;
  if (key == "gearbox_ratio")
    return wanted().gear_ratio;
  if (const auto* axis = settings(index))
  {
    if (key == "fmax")
      return axis->motor_force;
    if (key == "vel")
      return axis->motor_velocity;
    if (key == "friction")
      return axis->friction;
  }
  const auto kept = params_.find(key);
  return kept == params_.end() ? 0.0 : kept->second;
}

#define GZ_AXIS_NUMBER(Get, Set, field, none, low)                    \
  double Joint::Get(unsigned int index)                               \
  {                                                                   \
    const auto* axis = settings(index);                               \
    return axis ? axis->field : none;                                 \
  }                                                                   \
  void Joint::Set(unsigned int index, double value)                   \
  {                                                                   \
    auto* axis = settings(index);                                     \
    if (!axis || std::isnan(value))                                   \
      return;                                                         \
    axis->field = std::min(std::max(value, low), ode_sim::kStiffest); \
    changed();                                                        \
  }
GZ_AXIS_NUMBER(GetDamping, SetDamping, damping, 0.0, 0.0)
GZ_AXIS_NUMBER(GetStiffness, SetStiffness, spring_stiffness, 0.0, 0.0)
GZ_AXIS_NUMBER(GetEffortLimit, SetEffortLimit, effort, -1.0, -1.0)
GZ_AXIS_NUMBER(GetVelocityLimit, SetVelocityLimit, velocity, -1.0, -1.0)
#undef GZ_AXIS_NUMBER

void Joint::SetStiffnessDamping(unsigned int index, double stiffness, double damping, double reference)
{
  SetStiffness(index, stiffness);
  SetDamping(index, damping);
  if (auto* axis = settings(index); axis && std::isfinite(reference))
    axis->spring_reference = reference;
}

double Joint::GetSpringReferencePosition(unsigned int index) const
{
  const auto* axis = settings(index);
  return axis ? axis->spring_reference : 0.0;
}

double Joint::LowerLimit(unsigned int index) const
{
  const auto* axis = settings(index);
  return axis ? written(axis->lower) : nan;
}

double Joint::UpperLimit(unsigned int index) const
{
  const auto* axis = settings(index);
  return axis ? written(axis->upper) : nan;
}

void Joint::SetLowerLimit(unsigned int index, double limit) { setLimit(index, limit, false); }
void Joint::SetUpperLimit(unsigned int index, double limit) { setLimit(index, limit, true); }

// One never goes beyond the other.
void Joint::setLimit(unsigned int index, double limit, bool upper)
{
  if (std::isnan(limit))
    return refused("a limit of joint " + GetScopedName() + " is not a number; it is left out");
  ode_sim::Axis* axis = settings(index);
  if (!axis)
    return;
  if (upper)
    axis->upper = std::max(read(limit), axis->lower);
  else
    axis->lower = std::min(read(limit), axis->upper);
  changed();
  if (made_)
    hold();
}

}  // namespace physics

void internal::Drive(const physics::JointPtr& joint, double position)
{
  const std::shared_ptr<ode_sim::Joint> core = joint ? joint->Core() : nullptr;
  if (!core)
    return;
  physics::change(joint->GetScopedName(), [&] {
    if (ode_sim::World* world = physics::world_of(core->model))
      world->set_drive(*core, position);
  });
}
}  // namespace gazebo
