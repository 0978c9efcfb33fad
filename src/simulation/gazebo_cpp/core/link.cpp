// Link.
#include <gazebo/physics/physics.hh>

#include <algorithm>

#include <limits.hpp>

#include "mirror.hpp"

namespace gazebo
{
namespace physics
{

using ignition::math::Pose3d;
using ignition::math::Vector3d;

Link::Link(EntityPtr parent) : Entity(parent), inertial(new Inertial) { AddType(LINK); }
Link::~Link() = default;

void Link::Init()
{
  const auto actor = boost::dynamic_pointer_cast<Actor>(GetModel());
  if (!actor)
    return;
  for (const CollisionPtr& collision : collisions_)
    if (!boost::dynamic_pointer_cast<MeshShape>(collision->GetShape()))  // the skin is what rays see
      collision->SetCollideBits(GZ_ALL_COLLIDE & 0xFFFF);
  actor->LetCollide();
}

bool Link::IsStatic() const { return core_->model->is_static; }

const Pose3d& Link::WorldPose() const { return worldPose = ign(core_->X_WL); }

void Link::place(const Pose3d& X_WL)
{
  if (ode_sim::World* core = world_of(core_->model))
    core->set_link_pose(*core_, ode(X_WL));
}

// -- switches -----------------------------------------------------------------------------------------------------------------------

// A body that is switched off stays where it is. One that hangs on others is woken by them, and so it is here.
void Link::SetEnabled(bool enable) const
{
  if (enable == GetEnabled() || core_->model->links.size() > 1)
    return;
  change(GetScopedName(), [&] {
    core_->kinematic = !enable;
    core_->model->dirty = true;
    if (ode_sim::World* core = world_of(core_->model); core && !enable)
      core->zero_velocities(*core_->model);
  });
}

bool Link::GetEnabled() const { return !core_->kinematic; }

void Link::SetGravityMode(bool on)
{
  core_->gravity = on;
  core_->model->dirty = true;
}
bool Link::GetGravityMode() const { return core_->gravity; }

void Link::SetSelfCollide(bool collide) { core_->self_collide = collide; }
bool Link::GetSelfCollide() const { return core_->self_collide; }

void Link::SetCollideMode(const std::string& mode)
{
  const bool none = mode == "none" || mode == "ghost" || mode == "sensors";
  for (const auto& shape : core_->shapes)
    shape->surface.collide_bitmask = none ? 0 : 0xFFFF;
  core_->model->changed = true;
}

void Link::SetLaserRetro(float retro)
{
  for (const CollisionPtr& collision : collisions_)
    collision->SetLaserRetro(retro);
}

void Link::SetKinematic(const bool& kinematic)
{
  core_->kinematic = kinematic;
  core_->model->dirty = true;
}
bool Link::GetKinematic() const { return core_->kinematic; }

void Link::SetLinearDamping(double damping)
{
  change(GetScopedName(), [&] { core_->linear_decay = std::max(ode_sim::limited(damping, 1, "linear damping"), 0.0); });
}
void Link::SetAngularDamping(double damping)
{
  change(GetScopedName(), [&] { core_->angular_decay = std::max(ode_sim::limited(damping, 1, "angular damping"), 0.0); });
}
double Link::GetLinearDamping() const { return core_->linear_decay; }
double Link::GetAngularDamping() const { return core_->angular_decay; }

void Link::ResetPhysicsStates() { SetWorldTwist({}, {}); }

// -- motion -------------------------------------------------------------------------------------------------------------------------

namespace
{

void set_twist(const std::string& who, ode_sim::Link& link, const Vector3d& v, const Vector3d& w)
{
  change(who, [&] {
    ode_sim::World* core = world_of(link.model);
    if (core && !link.model->is_static)
      core->set_link_twist(link, ode_sim::limited(ode(v), ode_sim::kFastestSet, "a velocity"),
                           ode_sim::limited(ode(w), ode_sim::kFastestSet, "an angular velocity"));
  });
}

}  // namespace

void Link::SetLinearVel(const Vector3d& velocity)
{
  const Vector3d arm = WorldPose().Pos() - com();
  set_twist(GetScopedName(), *core_, velocity + WorldAngularVel().Cross(arm), WorldAngularVel());
}

void Link::SetAngularVel(const Vector3d& velocity)
{
  const Vector3d arm = WorldPose().Pos() - com();
  set_twist(GetScopedName(), *core_, WorldCoGLinearVel() + velocity.Cross(arm), velocity);
}

void Link::SetWorldTwist(const Vector3d& linear, const Vector3d& angular, bool)
{
  set_twist(GetScopedName(), *core_, linear, angular);
}

void Link::MoveFrame(const Pose3d& from, const Pose3d& to, bool preserve_velocity)
{
  const Vector3d v = WorldLinearVel(), w = WorldAngularVel();
  SetWorldPose((WorldPose() - from) + to);
  if (preserve_velocity)
    SetWorldTwist(v, w);
}

Vector3d Link::com() const { return ign(core_->com_W()); }
Pose3d Link::WorldCoGPose() const { return { com(), WorldPose().Rot() * inertial->Pose().Rot() }; }
Vector3d Link::WorldLinearVel() const { return ign(core_->v); }
Vector3d Link::WorldLinearVel(const Vector3d& offset) const { return ign(core_->velocity_at(core_->X_WL * ode(offset))); }
Vector3d Link::WorldLinearVel(const Vector3d& offset, const ignition::math::Quaterniond& q) const
{
  return ign(core_->velocity_at(core_->X_WL.p + ode(q.RotateVector(offset))));
}
Vector3d Link::WorldCoGLinearVel() const { return ign(core_->velocity_at(core_->com_W())); }
Vector3d Link::WorldAngularVel() const { return ign(core_->w); }

Vector3d Link::WorldWindLinearVel() const
{
  if (!windy_)
    return {};
  const WorldPtr world = GetModel()->GetWorld();
  if (!world->WindEnabled())
    return {};
  if (const uint64_t step = world->Iterations(); step != wind_of_step_)
  {
    wind_of_step_ = step;
    wind_ = world->Wind().WorldLinearVel(this);
  }
  return wind_;
}

Vector3d Link::WorldLinearAccel() const
{
  if (!watched_)
    Mirror::Get().Watch(boost::static_pointer_cast<Link>(const_cast<Link*>(this)->shared_from_this()));
  return a_;
}

Vector3d Link::WorldAngularAccel() const
{
  WorldLinearAccel();
  return alpha_;
}

Vector3d Link::WorldAngularMomentum() const { return WorldInertiaMatrix() * WorldAngularVel(); }

// -- forces -------------------------------------------------------------------------------------------------------------------------

void Link::add(const Vector3d& force, const Vector3d& torque)
{
  if (!force.IsFinite() || !torque.IsFinite())
    return refused("a force on " + GetScopedName() + " is not a number; it is left out");
  core_->force = ode_sim::limited(core_->force + ode(force), ode_sim::kStrongest, "a force");
  core_->torque = ode_sim::limited(core_->torque + ode(torque), ode_sim::kStrongest, "a torque");
}

void Link::SetForce(const Vector3d& force)
{
  core_->force = {};
  add(force, {});
}
void Link::SetTorque(const Vector3d& torque)
{
  core_->torque = {};
  add({}, torque);
}
void Link::AddForce(const Vector3d& force) { add(force, {}); }
void Link::AddTorque(const Vector3d& torque) { add({}, torque); }
void Link::AddRelativeForce(const Vector3d& force) { add(WorldPose().Rot().RotateVector(force), {}); }
void Link::AddRelativeTorque(const Vector3d& torque) { add({}, WorldPose().Rot().RotateVector(torque)); }
void Link::AddForceAtWorldPosition(const Vector3d& force, const Vector3d& position)
{
  add(force, (position - com()).Cross(force));
}
void Link::AddForceAtRelativePosition(const Vector3d& force, const Vector3d& position)
{
  add(force, WorldPose().Rot().RotateVector(position).Cross(force));
}
void Link::AddLinkForce(const Vector3d& force, const Vector3d& offset)
{
  const Vector3d f = WorldPose().Rot().RotateVector(force);
  AddForceAtWorldPosition(f, ign(core_->X_WL * ode(offset)));
}

Vector3d Link::WorldForce() const
{
  const auto f = core_->force;
  return ign(f.x || f.y || f.z ? f : core_->applied_force);
}
Vector3d Link::WorldTorque() const
{
  const auto t = core_->torque;
  return ign(t.x || t.y || t.z ? t : core_->applied_torque);
}

// -- mass ---------------------------------------------------------------------------------------------------------------------------

void Link::UpdateMass()
{
  const auto R = ignition::math::Matrix3d(inertial->Pose().Rot());
  const auto I = R * inertial->MOI() * R.Transposed();
  change(GetScopedName(), [&] {
    if (!(inertial->Mass() > 0))
      throw std::invalid_argument("a mass must be positive");
    if (ode_sim::World* core = world_of(core_->model))
      core->set_inertial(*core_, ode_sim::checked(inertial->Mass(), "a mass"),
                         ode_sim::checked_place(ode(inertial->CoG()), "a centre of mass"),
                         { I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2) });
  });
}

Pose3d Link::WorldInertialPose() const { return inertial->Pose() + WorldPose(); }

ignition::math::Matrix3d Link::WorldInertiaMatrix() const
{
  const ignition::math::Matrix3d R(WorldInertialPose().Rot());
  return R * inertial->MOI() * R.Transposed();
}

double Link::GetWorldEnergyPotential() const { return -inertial->Mass() * GetWorld()->Gravity().Dot(WorldCoGPose().Pos()); }

double Link::GetWorldEnergyKinetic() const
{
  const Vector3d v = WorldCoGLinearVel(), w = WorldAngularVel();
  return 0.5 * inertial->Mass() * v.Dot(v) + 0.5 * w.Dot(WorldInertiaMatrix() * w);
}

// -- who belongs to it --------------------------------------------------------------------------------------------------------------

ModelPtr Link::GetModel() const { return boost::dynamic_pointer_cast<Model>(GetParent()); }

CollisionPtr Link::GetCollision(const std::string& name)
{
  for (const CollisionPtr& collision : collisions_)
    if (collision->GetName() == name || collision->GetScopedName() == name)
      return collision;
  return CollisionPtr();
}

common::BatteryPtr Link::Battery(const std::string& name) const
{
  const auto found = std::find_if(batteries_.begin(), batteries_.end(),
                                  [&name](const common::BatteryPtr& battery) { return battery->Name() == name; });
  return found == batteries_.end() ? common::BatteryPtr() : *found;
}

common::BatteryPtr Link::Battery(std::size_t index) const
{
  return index < batteries_.size() ? batteries_[index] : common::BatteryPtr();
}

CollisionPtr Link::GetCollision(unsigned int index) const
{
  return index < collisions_.size() ? collisions_[index] : CollisionPtr();
}

CollisionPtr Link::GetCollisionById(unsigned int id) const
{
  for (const CollisionPtr& collision : collisions_)
    if (collision->GetId() == id)
      return collision;
  return CollisionPtr();
}

ignition::math::AxisAlignedBox Link::BoundingBox() const
{
  ignition::math::AxisAlignedBox box;
  for (const CollisionPtr& collision : collisions_)
    box += collision->BoundingBox();
  return box;
}

Joint_V Link::GetParentJoints() const
{
  Joint_V found;
  if (const ModelPtr model = GetModel())
    for (const JointPtr& joint : model->GetJoints())
      if (joint->GetChild().get() == this)
        found.push_back(joint);
  return found;
}

Joint_V Link::GetChildJoints() const
{
  Joint_V found;
  if (const ModelPtr model = GetModel())
    for (const JointPtr& joint : model->GetJoints())
      if (joint->GetParent().get() == this)
        found.push_back(joint);
  return found;
}

Link_V Link::GetChildJointsLinks() const
{
  Link_V found;
  for (const JointPtr& joint : GetChildJoints())
    if (joint->GetChild())
      found.push_back(joint->GetChild());
  return found;
}

Link_V Link::GetParentJointsLinks() const
{
  Link_V found;
  for (const JointPtr& joint : GetParentJoints())
    if (joint->GetParent())
      found.push_back(joint->GetParent());
  return found;
}

}  // namespace physics
}  // namespace gazebo
