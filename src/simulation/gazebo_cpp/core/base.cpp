// Base, Entity, Inertial.
#include <gazebo/common/Animation.hh>
#include <gazebo/physics/physics.hh>

#include <algorithm>
#include <atomic>
#include <iostream>
#include <map>
#include <vector>

#include "mirror.hpp"

namespace gazebo
{
namespace physics
{

uint32_t getUniqueId()
{
  static std::atomic<uint32_t> next{ 1 };
  return next++;
}

// -- Base ---------------------------------------------------------------------------------------------------------------------------

Base::Base(BasePtr parent) : parent_(parent.get()), id_(getUniqueId())
{
  if (parent)
    world = parent->GetWorld();
}

Base::~Base()
{
  for (const BasePtr& child : children)
    if (child->parent_ == this)
      child->parent_ = nullptr;
}

BasePtr Base::GetParent() const { return parent_ ? parent_->shared_from_this() : BasePtr(); }

int Base::GetParentId() const { return parent_ ? static_cast<int>(parent_->GetId()) : 0; }

void Base::AddChild(BasePtr child)
{
  if (child)
    children.push_back(child);
}

void Base::RemoveChild(unsigned int id)
{
  children.erase(std::remove_if(children.begin(), children.end(), [&](const BasePtr& c) { return c->GetId() == id; }),
                 children.end());
}

void Base::RemoveChild(const std::string& name) { RemoveChild(GetByName(name)); }

void Base::RemoveChild(BasePtr child)
{
  if (child)
    RemoveChild(child->GetId());
}

BasePtr Base::GetById(unsigned int id) const
{
  for (const BasePtr& child : children)
    if (child->GetId() == id)
      return child;
  return BasePtr();
}

BasePtr Base::GetByName(const std::string& name)
{
  if (name == GetName() || name == GetScopedName())
    return shared_from_this();
  for (const BasePtr& child : children)
    if (BasePtr found = child->GetByName(name))
      return found;
  return BasePtr();
}

std::string Base::GetScopedName(bool prependWorldName) const
{
  std::string name = name_;
  for (const Base* above = parent_; above; above = above->parent_)
    name = above->name_ + "::" + name;
  return prependWorldName && world ? world->Name() + "::" + name : name;
}

std::string Base::StripScopedName(const std::string& name) const
{
  const std::string own = GetScopedName() + "::";
  return name.compare(0, own.size(), own) == 0 ? name.substr(own.size()) : name;
}

std::string Base::StripParentScopedName(const std::string& name) const
{
  return parent_ ? parent_->StripScopedName(name) : name;
}

std::string Base::TypeStr() const
{
  static const std::pair<EntityType, const char*> names[] = { { ACTOR, "actor" }, { MODEL, "model" },
                                                              { LINK, "link" },   { COLLISION, "collision" },
                                                              { LIGHT, "light" }, { JOINT, "joint" },
                                                              { SHAPE, "shape" }, { ENTITY, "entity" } };
  for (const auto& name : names)
    if (HasType(name.first))
      return name.second;
  return "common";
}

void Base::Print(const std::string& prefix)
{
  std::cout << prefix << GetName() << "\n";
  for (const BasePtr& child : children)
    child->Print(prefix + "  ");
}

// -- Entity -------------------------------------------------------------------------------------------------------------------------

bool Entity::IsStatic() const
{
  const BasePtr parent = GetParent();
  const Entity* above = dynamic_cast<Entity*>(parent.get());
  return above && above->IsStatic();
}

ignition::math::Pose3d Entity::RelativePose() const
{
  const BasePtr parent = GetParent();
  const Entity* above = dynamic_cast<Entity*>(parent.get());
  return above ? WorldPose() - above->WorldPose() : WorldPose();
}

void Entity::SetRelativePose(const ignition::math::Pose3d& pose, bool notify, bool publish)
{
  const BasePtr parent = GetParent();
  const Entity* above = dynamic_cast<Entity*>(parent.get());
  SetWorldPose(above ? pose + above->WorldPose() : pose, notify, publish);
}

void Entity::SetWorldPose(const ignition::math::Pose3d& pose, bool, bool)
{
  change(GetScopedName(), [&] { place(pose); });
}

namespace
{

// Entities that move along an animation. Apart from them, so that what was built on the headers fits with and without it.
struct Animated
{
  boost::weak_ptr<Base> entity;
  common::PoseAnimationPtr animation;
  boost::function<void()> on_complete;
  common::Time until;
};

std::map<const Entity*, Animated>& animated()
{
  static auto* all = new std::map<const Entity*, Animated>;  // as long as the process: plugins may ask at its end
  return *all;
}

void animate(Animated& one, const common::UpdateInfo& info)
{
  const BasePtr base = one.entity.lock();
  one.animation->AddTime((info.simTime - one.until).Double());
  one.until = info.simTime;
  common::PoseKeyFrame now(0);
  one.animation->GetInterpolatedKeyFrame(now);
  boost::static_pointer_cast<Entity>(base)->SetWorldPose({ now.Translation(), now.Rotation() });
}

void animate_all(const common::UpdateInfo& info)
{
  const boost::recursive_mutex::scoped_lock lock(step_mutex());
  std::vector<boost::function<void()>> ended;
  for (auto at = animated().begin(); at != animated().end();)
  {
    Animated& one = at->second;
    const bool gone = one.entity.expired();
    if (!gone)
      animate(one, info);
    const bool done = gone || one.animation->GetTime() >= one.animation->GetLength();
    if (done && !gone && one.on_complete)
      ended.push_back(one.on_complete);
    at = done ? animated().erase(at) : std::next(at);
  }
  for (const auto& each : ended)  // which may begin another one
    each();
}

}  // namespace

void Entity::SetAnimation(const common::PoseAnimationPtr& animation, boost::function<void()> on_complete)
{
  const boost::recursive_mutex::scoped_lock lock(step_mutex());
  static auto* every_step = new event::ConnectionPtr(event::Events::ConnectWorldUpdateBegin(&animate_all));
  (void)every_step;
  animated().erase(this);
  if (animation)
    animated()[this] = { shared_from_this(), animation, on_complete, GetWorld() ? GetWorld()->SimTime() : common::Time() };
}

void Entity::StopAnimation()
{
  const boost::recursive_mutex::scoped_lock lock(step_mutex());
  animated().erase(this);
}

ModelPtr Entity::GetParentModel()
{
  for (BasePtr above = shared_from_this(); above; above = above->GetParent())
    if (above->HasType(MODEL))
      return boost::static_pointer_cast<Model>(above);
  return ModelPtr();
}

CollisionPtr Entity::GetChildCollision(const std::string& name)
{
  return boost::dynamic_pointer_cast<Collision>(GetByName(name));
}

LinkPtr Entity::GetChildLink(const std::string& name) { return boost::dynamic_pointer_cast<Link>(GetByName(name)); }

void Entity::GetNearestEntityBelow(double& distance, std::string& name)
{
  const auto box = BoundingBox();
  const auto at = WorldPose().Pos();
  RayShape ray{ CollisionPtr() };
  ray.SetPoints({ at.X(), at.Y(), box.Min().Z() - 1e-5 }, { at.X(), at.Y(), box.Min().Z() - 1000 });
  ray.GetIntersection(distance, name);
  distance += 1e-5;
}

void Entity::PlaceOnNearestEntityBelow()
{
  double distance = 0;
  std::string name;
  GetNearestEntityBelow(distance, name);
  if (name.empty())
    return;
  ignition::math::Pose3d pose = WorldPose();
  pose.Pos().Z(pose.Pos().Z() - distance);
  SetWorldPose(pose);
}

// -- Inertial -----------------------------------------------------------------------------------------------------------------------

Inertial::Inertial(const ignition::math::Inertiald& inertial)
{
  mass_ = inertial.MassMatrix().Mass();
  SetCoG(inertial.Pose());
  principals_ = inertial.MassMatrix().DiagonalMoments();
  products_ = inertial.MassMatrix().OffDiagonalMoments();
}

void Inertial::Load(sdf::ElementPtr sdf)
{
  if (!sdf)
    return;
  mass_ = sdf->Get<double>("mass", mass_).first;
  SetCoG(sdf->Get<ignition::math::Pose3d>("pose", cog_).first);
  if (!sdf->HasElement("inertia"))
    return;
  const sdf::ElementPtr tensor = sdf->GetElement("inertia");
  SetInertiaMatrix(tensor->Get<double>("ixx"), tensor->Get<double>("iyy"), tensor->Get<double>("izz"),
                   tensor->Get<double>("ixy"), tensor->Get<double>("ixz"), tensor->Get<double>("iyz"));
}

ignition::math::Inertiald Inertial::Ign() const
{
  return { ignition::math::MassMatrix3d(mass_, principals_, products_), cog_ };
}

void Inertial::Rotate(const ignition::math::Quaterniond& rotation)
{
  cog_.Pos() = com_ = rotation.RotateVector(com_);
  cog_.Rot() = rotation * cog_.Rot();
}

ignition::math::Matrix3d Inertial::MOI() const { return { IXX(), IXY(), IXZ(), IXY(), IYY(), IYZ(), IXZ(), IYZ(), IZZ() }; }

ignition::math::Matrix3d Inertial::MOI(const ignition::math::Pose3d& pose) const
{
  const auto X = cog_ - pose;
  const ignition::math::Matrix3d R(X.Rot());
  const auto& r = X.Pos();
  const double rr = r.SquaredLength();
  const ignition::math::Matrix3d shift(rr - r.X() * r.X(), -r.X() * r.Y(), -r.X() * r.Z(), -r.X() * r.Y(), rr - r.Y() * r.Y(),
                                       -r.Y() * r.Z(), -r.X() * r.Z(), -r.Y() * r.Z(), rr - r.Z() * r.Z());
  return R * MOI() * R.Transposed() + shift * mass_;
}

void Inertial::SetMOI(const ignition::math::Matrix3d& moi)
{
  principals_.Set(moi(0, 0), moi(1, 1), moi(2, 2));
  products_.Set(moi(0, 1), moi(0, 2), moi(1, 2));
}

}  // namespace physics
}  // namespace gazebo
