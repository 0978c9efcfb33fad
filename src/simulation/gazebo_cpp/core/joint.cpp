// Joint.
#include <gazebo/physics/physics.hh>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
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

/// Joints that Init() could not make: plugins may make them firm afterwards, by their limits.
struct Asked
{
  std::mutex mutex;
  std::map<const Joint*, std::pair<int64_t, std::string>> joints;  // since when, and what is said if it stays so
};

Asked& asked()
{
  static Asked* one = new Asked;  // threads of plugins end after static objects
  return *one;
}

bool forget(const Joint* joint)
{
  const std::lock_guard<std::mutex> lock(asked().mutex);
  return asked().joints.erase(joint) > 0;
}

constexpr int64_t patience_ns = 200000000;

/// A joint of a description lets go, for good: its links go on as they move, each by itself, and may touch. What still holds the joint
/// finds one without axes: nothing moves it any more.
void take_off(ode_sim::World& world, ode_sim::Joint& joint)
{
  ode_sim::Model& model = *joint.model;
  const auto is = [&joint](const auto& other) { return &*other == &joint; };
  const auto owner = std::find_if(model.joints.begin(), model.joints.end(), is);
  if (owner == model.joints.end())
    return;  // it has let go before
  const std::shared_ptr<ode_sim::Joint> kept = *owner;
  world.disturb(model);
  world.drive_off(joint);
  model.joints.erase(owner);
  for (ode_sim::Link* link : { joint.parent, joint.child })
    if (link)
      link->joints.erase(std::remove(link->joints.begin(), link->joints.end(), &joint), link->joints.end());
  joint.child->parent_joint = nullptr;
  model.jointed.clear();
  for (const auto& other : model.joints)
  {
    if (other->parent)
      model.jointed.insert(std::minmax(other->parent->id, other->child->id));
    if (other->holds() && other->child == joint.child && !joint.child->parent_joint)
      joint.child->parent_joint = other.get();
  }
  const ode_sim::OdeScope scope;
  joint.joint.reset();
  joint.type = ode_sim::JointType::Fixed, joint.axis_count = 0;
  joint.feedback = {};
  for (ode_sim::Axis& axis : joint.axes)
    axis.relax(), ode_sim::set_motor(axis, 0, 0);
  ode_sim::judge_masses(model);
  model.dirty = true;
  world.refresh();
}

}  // namespace

void tell_of_refused_joints(int64_t now_ns)
{
  std::vector<std::string> lines;
  {
    const std::lock_guard<std::mutex> lock(asked().mutex);
    auto& joints = asked().joints;
    for (auto each = joints.begin(); each != joints.end();)
    {
      const bool late = std::abs(now_ns - each->second.first) > patience_ns;
      if (late)
        lines.push_back(each->second.second);
      each = late ? joints.erase(each) : std::next(each);
    }
  }
  for (const std::string& line : lines)
    refused(line);
}

Joint::~Joint() { forget(this); }

// -- joints that plugins make -------------------------------------------------------------------------------------------------------

bool Joint::firm() const { return HasType(FIXED_JOINT) || (made_upper_ - made_lower_ < 1e-6); }

void Joint::Load(LinkPtr parent, LinkPtr child, const Pose3d&)
{
  if (core_)
    return;
  parent_ = parent, child_ = child;
  if (child && !GetWorld())
    SetWorld(child->GetWorld());
}

void Joint::SetModel(ModelPtr model)
{
  if (model)
    SetWorld(model->GetWorld());
}

void Joint::Init()
{
  if (core_ || weld_ || (!parent_ && !child_))
    return;
  if (!firm())
  {
    const char* who = internal::CurrentPlugin();
    const std::lock_guard<std::mutex> lock(asked().mutex);
    asked().joints[this] = {
      Mirror::Get().Now(), (who ? std::string(who) + ": " : "") + "joint '" + GetName() + "' of " +
                               (parent_ ? parent_->GetScopedName() : "the world") + " and " +
                               (child_ ? child_->GetScopedName() : "the world") +
                               " cannot be made while the simulation runs: only firm ones can (type fixed, or both limits 0)"
    };
    return;
  }
  forget(this);
  const LinkPtr child = child_ ? child_ : parent_, parent = child_ ? parent_ : LinkPtr();
  change(GetName(), [&] {
    if (ode_sim::World* core = world_of(child->Core()->model))
      weld_ = core->weld(parent ? parent->Core() : nullptr, child->Core());
  });
}

/// A joint that was let go holds again.
void Joint::Attach(LinkPtr parent, LinkPtr child)
{
  if (core_)
    return;
  const bool again = parent_ == parent && child_ == child && (parent_ || child_);
  parent_ = parent, child_ = child;
  if (again && firm())
    Init();
}

void Joint::Detach()
{
  if (core_)
    return change(GetScopedName(), [&] {
      if (ode_sim::World* world = world_of(core_->model))
        take_off(*world, *core_);
    });
  const LinkPtr link = child_ ? child_ : parent_;
  if (!weld_ || !link)
    return;
  change(GetName(), [&] {
    if (ode_sim::World* core = world_of(link->Core()->model))
      core->unweld(weld_);
  });
  weld_ = 0;
}

bool Joint::AreConnected(LinkPtr one, LinkPtr two) const
{
  return (core_ || weld_) && ((one == parent_ && two == child_) || (one == child_ && two == parent_));
}

void Joint::Reset() { SetVelocity(0, 0); }

// -- state --------------------------------------------------------------------------------------------------------------------------

unsigned int Joint::DOF() const { return core_ ? static_cast<unsigned int>(core_->axis_count) : 0; }

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
  if (!core_)
    return wrench;
  SetProvideFeedback(true);
  // What the links exert on the joint, each in its own axes, torques about the anchor.
  const auto& f = core_->feedback;
  const auto child = child_->WorldPose().Rot();
  const auto parent = parent_ ? parent_->WorldPose().Rot() : ignition::math::Quaterniond::Identity;
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
  if (!core_)
    return {};
  return ign(index == 0 ? core_->feedback.child_force : core_->feedback.parent_force);
}

Vector3d Joint::LinkTorque(unsigned int index) const
{
  if (!core_)
    return {};
  return ign(index == 0 ? core_->feedback.child_torque : core_->feedback.parent_torque);
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
  else if (!core_)
    params_[key] = *number;
  else if (key == "stop_erp")
    core_->stop_erp = std::min(std::max(*number, 0.0), 10.0), core_->model->dirty = true;
  else if (key == "stop_cfm")
    core_->stop_cfm = std::min(std::max(*number, 0.0), ode_sim::kStiffest), core_->model->dirty = true;
  else if (key == "thread_pitch" || key == "gearbox_ratio")
  {
    const auto set = key == "thread_pitch" ? ode_sim::set_thread_pitch : ode_sim::set_gear_ratio;
    bool done = false;
    change(GetScopedName(), [&] { set(*core_, *number), done = true; });
    return done;
  }
  else if (auto* axis = axis_of(core_, index))
  {
    if (key == "fmax")
      ode_sim::set_motor(*axis, axis->motor_velocity, std::max(*number, 0.0));
    else if (key == "vel")
      ode_sim::set_motor(*axis, *number, axis->motor_force);
    else if (key == "friction")
      axis->friction = std::max(*number, 0.0), core_->model->dirty = true;
    else if (key == "erp" || key == "cfm" || key == "fudge_factor" || key == "suspension_erp" || key == "suspension_cfm")
      params_[key] = *number;
    else
    {
      refused("joint " + GetScopedName() + " has no parameter '" + key + "'");
      return false;
    }
  }
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
  if (core_ && key == "stop_erp")
    return core_->stop_erp;
  if (core_ && key == "stop_cfm")
    return core_->stop_cfm;
  if (core_ && key == "thread_pitch")
    return core_->thread_pitch;
  if (core_ && key == "gearbox_ratio")
    return core_->gear_ratio;
  if (const auto* axis = axis_of(core_, index))
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
    const auto* axis = axis_of(core_, index);                         \
    return axis ? axis->field : none;                                 \
  }                                                                   \
  void Joint::Set(unsigned int index, double value)                   \
  {                                                                   \
    auto* axis = axis_of(core_, index);                               \
    if (!axis || std::isnan(value))                                   \
      return;                                                         \
    axis->field = std::min(std::max(value, low), ode_sim::kStiffest); \
    core_->model->dirty = true;                                       \
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
  if (auto* axis = axis_of(core_, index); axis && std::isfinite(reference))
    axis->spring_reference = reference;
}

double Joint::GetSpringReferencePosition(unsigned int index) const
{
  const auto* axis = axis_of(core_, index);
  return axis ? axis->spring_reference : 0.0;
}

double Joint::LowerLimit(unsigned int index) const
{
  const auto* axis = axis_of(core_, index);
  return axis ? written(axis->lower) : core_ ? nan : made_lower_;
}

double Joint::UpperLimit(unsigned int index) const
{
  const auto* axis = axis_of(core_, index);
  return axis ? written(axis->upper) : core_ ? nan : made_upper_;
}

void Joint::SetLowerLimit(unsigned int index, double limit)
{
  if (std::isnan(limit))
    return refused("a limit of joint " + GetScopedName() + " is not a number; it is left out");
  if (!core_)
  {
    made_lower_ = limit;
    if (firm() && forget(this))
      Init();
  }
  else if (auto* axis = axis_of(core_, index))
    axis->lower = std::min(read(limit), axis->upper), core_->model->dirty = true;
}

void Joint::SetUpperLimit(unsigned int index, double limit)
{
  if (std::isnan(limit))
    return refused("a limit of joint " + GetScopedName() + " is not a number; it is left out");
  if (!core_)
  {
    made_upper_ = limit;
    if (firm() && forget(this))
      Init();
  }
  else if (auto* axis = axis_of(core_, index))
    axis->upper = std::max(read(limit), axis->lower), core_->model->dirty = true;
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
