// Collision, surfaces, contacts.
#include <gazebo/physics/physics.hh>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <sstream>

#include <limits.hpp>

#include "contacts.hpp"
#include "mirror.hpp"
#include "topics.hpp"

namespace gazebo
{
namespace physics
{

using ignition::math::Pose3d;
using ignition::math::Vector3d;

// -- Collision ----------------------------------------------------------------------------------------------------------------------

Collision::Collision(LinkPtr link) : Entity(link) { AddType(COLLISION); }

const Pose3d& Collision::WorldPose() const
{
  if (core_)
    return worldPose = ign(core_->link->X_WL * core_->X_LC);
  const LinkPtr link = GetLink();
  return worldPose = link ? X_LC_ + link->WorldPose() : X_LC_;
}

void Collision::place(const Pose3d& X_WC)
{
  const LinkPtr link = GetLink();
  if (!core_)
    X_LC_ = link ? X_WC - link->WorldPose() : X_WC;
  Entity::place(X_WC);
}

ignition::math::AxisAlignedBox Collision::BoundingBox() const
{
  dReal b[6];
  const ode_sim::OdeScope scope;
  if (!core_ || !core_->geom)
    return {};
  dGeomGetAABB(core_->geom, b);
  return { Vector3d(b[0], b[2], b[4]), Vector3d(b[1], b[3], b[5]) };
}

Vector3d Collision::WorldLinearVel() const
{
  if (core_)
    return ign(core_->link->velocity_at((core_->link->X_WL * core_->X_LC).p));
  const LinkPtr link = GetLink();
  return link ? link->WorldLinearVel(X_LC_.Pos()) : Vector3d();
}
Vector3d Collision::WorldAngularVel() const
{
  if (core_)
    return ign(core_->link->w);
  const LinkPtr link = GetLink();
  return link ? link->WorldAngularVel() : Vector3d();
}

void Collision::SetInitialRelativePose(const Pose3d& pose)
{
  Entity::SetInitialRelativePose(pose);
  if (!core_)
    X_LC_ = pose;
  ode_sim::World* const core = core_ ? world_of(core_->link->model) : nullptr;
  if (!core || pose == ign(core_->X_LC))
    return;
  change(GetScopedName(), [&] {
    core_->X_LC = ode_sim::normalized(ode_sim::checked(ode(pose), "a pose", ode_sim::kFarthestPart));
    core_->link->model->dirty = true;
    core->refresh();
  });
}

LinkPtr Collision::GetLink() const { return boost::dynamic_pointer_cast<Link>(GetParent()); }
ModelPtr Collision::GetModel() const
{
  const LinkPtr link = GetLink();
  return link ? link->GetModel() : ModelPtr();
}
unsigned int Collision::GetShapeType() const { return shape_ ? shape_->GetType() & ~SHAPE : 0; }
void Collision::SetCollideBits(unsigned int bits)
{
  if (!core_)
    return;
  core_->surface.collide_bitmask = bits;
  core_->link->model->changed = true;
}
unsigned int Collision::GetMaxContacts() { return core_ ? static_cast<unsigned int>(core_->max_contacts) : 0; }
void Collision::SetMaxContacts(unsigned int most)
{
  if (!core_)
    return;
  core_->max_contacts = static_cast<int>(std::min(most, static_cast<unsigned int>(MAX_CONTACT_JOINTS)));
  core_->link->model->changed = true;
}

SurfaceParams::SurfaceParams(std::shared_ptr<ode_sim::Shape> core)
  : collideWithoutContact(core->surface.collide_without_contact)
  , collideBitmask(core->surface.collide_bitmask)
  , pyramid_(new class FrictionPyramid(std::move(core)))
{
}
namespace
{

void set(ode_sim::Shape& shape, double ode_sim::Surface::*field, double value, double most)
{
  shape.surface.*field = value >= 0 ? std::min(value, most) : 0;
  shape.link->model->changed = true;
}

}  // namespace

double FrictionPyramid::MuPrimary() { return core_->surface.mu; }
double FrictionPyramid::MuSecondary() { return core_->surface.mu2; }
double FrictionPyramid::MuTorsion() { return core_->surface.torsional_mu; }
bool FrictionPyramid::UsePatchRadius() { return core_->surface.use_patch_radius; }
double FrictionPyramid::PatchRadius() { return core_->surface.patch_radius; }
double FrictionPyramid::SurfaceRadius() { return core_->surface.surface_radius; }
void FrictionPyramid::SetMuPrimary(double mu) { set(*core_, &ode_sim::Surface::mu, mu, ode_sim::kRoughest); }
void FrictionPyramid::SetMuSecondary(double mu) { set(*core_, &ode_sim::Surface::mu2, mu, ode_sim::kRoughest); }
void FrictionPyramid::SetMuTorsion(double mu) { set(*core_, &ode_sim::Surface::torsional_mu, mu, ode_sim::kRoughest); }
void FrictionPyramid::SetPatchRadius(double radius)
{
  set(*core_, &ode_sim::Surface::patch_radius, radius, ode_sim::kFarthest);
}
void FrictionPyramid::SetSurfaceRadius(double radius)
{
  set(*core_, &ode_sim::Surface::surface_radius, radius, ode_sim::kRoughest);
}
void FrictionPyramid::SetUsePatchRadius(bool use)
{
  core_->surface.use_patch_radius = use;
  core_->link->model->changed = true;
}

// -- contacts -----------------------------------------------------------------------------------------------------------------------

namespace
{

std::mutex& numbers_mutex()
{
  static std::mutex* mutex = new std::mutex;
  return *mutex;
}

std::map<int, Collision*>& by_number()
{
  static auto* all = new std::map<int, Collision*>;
  return *all;
}

}  // namespace

Collision* collision_of(int shape)
{
  const std::lock_guard<std::mutex> lock(numbers_mutex());
  const auto found = by_number().find(shape);
  return found == by_number().end() ? nullptr : found->second;
}

void number_collision(int shape, Collision* collision)
{
  const std::lock_guard<std::mutex> lock(numbers_mutex());
  if (collision)
    by_number()[shape] = collision;
  else
    by_number().erase(shape);
}

std::string Contact::DebugString() const
{
  std::ostringstream text;
  text << "World [" << (world ? world->Name() : "") << "]\nCollision 1[" << (collision1 ? collision1->GetScopedName() : "")
       << "]\nCollision 2[" << (collision2 ? collision2->GetScopedName() : "") << "]\nTime[" << time << "]\n";
  for (int i = 0; i < count; ++i)
    text << "Position " << positions[i] << " normal " << normals[i] << " depth " << depths[i] << "\n";
  return text.str();
}

namespace
{

void fill(msgs::JointWrench& message, const JointWrench& wrench, const Collision& one, const Collision& two)
{
  message.set_body_1_name(one.GetScopedName()), message.set_body_1_id(one.GetId());
  message.set_body_2_name(two.GetScopedName()), message.set_body_2_id(two.GetId());
  msgs::Set(message.mutable_body_1_wrench()->mutable_force(), wrench.body1Force);
  msgs::Set(message.mutable_body_1_wrench()->mutable_torque(), wrench.body1Torque);
  msgs::Set(message.mutable_body_2_wrench()->mutable_force(), wrench.body2Force);
  msgs::Set(message.mutable_body_2_wrench()->mutable_torque(), wrench.body2Torque);
}

}  // namespace

void Contact::FillMsg(msgs::Contact& message) const
{
  message.set_collision1(collision1->GetScopedName());
  message.set_collision2(collision2->GetScopedName());
  message.set_world(world->Name());
  msgs::Set(message.mutable_time(), time);
  for (int i = 0; i < count; ++i)
  {
    msgs::Set(message.add_position(), positions[i]);
    msgs::Set(message.add_normal(), normals[i]);
    message.add_depth(depths[i]);
    fill(*message.add_wrench(), wrench[i], *collision1, *collision2);
  }
}

Contact& Contact::operator=(const msgs::Contact& message)
{
  world = Mirror::Get().GetWorld();
  const auto named = [&](const std::string& name) { return dynamic_cast<Collision*>(world->BaseByName(name).get()); };
  collision1 = named(message.collision1()), collision2 = named(message.collision2());
  time = msgs::Convert(message.time());
  count = std::min(message.position_size(), MAX_CONTACT_JOINTS);
  for (int i = 0; i < count; ++i)
  {
    positions[i] = msgs::ConvertIgn(message.position(i));
    normals[i] = i < message.normal_size() ? msgs::ConvertIgn(message.normal(i)) : Vector3d();
    depths[i] = i < message.depth_size() ? message.depth(i) : 0;
    if (i >= message.wrench_size())
      continue;
    const msgs::Wrench &one = message.wrench(i).body_1_wrench(), &two = message.wrench(i).body_2_wrench();
    wrench[i].body1Force = msgs::ConvertIgn(one.force()), wrench[i].body1Torque = msgs::ConvertIgn(one.torque());
    wrench[i].body2Force = msgs::ConvertIgn(two.force()), wrench[i].body2Torque = msgs::ConvertIgn(two.torque());
  }
  return *this;
}

// Which of two collisions that touch Gazebo names first: `pair_order.py` of gazebo_plugins says by which rule.
class PairOrder
{
public:
  bool InOrder(const ode_sim::Shape& one, const ode_sim::Shape& other)
  {
    const int first = ClassOf(*one.link), second = ClassOf(*other.link);
    if (first != second)
      return first < second;
    if (one.link->model->is_static != other.link->model->is_static)
      return one.link->model->is_static;
    return one.id > other.id;
  }

private:
  using Box = std::array<double, 6>;  // as ODE has it: low x, high x, low y ...

  static void Widen(Box& box, const ode_sim::Link& link)
  {
    for (const auto& shape : link.shapes)
    {
      if (!shape->geom)
        continue;
      dReal b[6];
      dGeomGetAABB(shape->geom, b);
      for (int i = 0; i < 6; i += 2)
        box[i] = std::min(box[i], b[i]), box[i + 1] = std::max(box[i + 1], b[i + 1]);
    }
  }

  static int SizeClass(const Box& box)
  {
    constexpr int kLeast = -2, kMost = 8, kBeyond = 99;
    const double side = std::max({ box[1] - box[0], box[3] - box[2], box[5] - box[4] });
    if (!std::isfinite(side))
      return kBeyond;
    int exponent = 0;
    std::frexp(side, &exponent);
    return exponent > kMost ? kBeyond : std::max(exponent, kLeast);
  }

  int ClassOf(const ode_sim::Link& link)
  {
    const void* const unit = link.self_collide ? static_cast<const void*>(&link) : link.model;
    const auto known = classes_.find(unit);
    if (known != classes_.end())
      return known->second;
    constexpr double kFar = std::numeric_limits<double>::infinity();
    Box box{ kFar, -kFar, kFar, -kFar, kFar, -kFar };
    if (link.self_collide)
      Widen(box, link);
    else
      for (const auto& each : link.model->links)
        if (!each->self_collide)
          Widen(box, *each);
    return classes_[unit] = SizeClass(box);
  }

  std::map<const void*, int> classes_;
};

struct ContactManager::Private
{
  std::vector<std::unique_ptr<Contact>> pool;
  std::vector<Contact*> contacts;
  std::map<std::string, std::vector<std::string>> filters;
  int64_t time = -1;
  uint64_t iterations = ~0ull;
  bool watching = false;

  void watch(ode_sim::World& core)
  {
    for (auto& model : core.scene().models)
      for (auto& link : model->links)
        for (auto& shape : link->shapes)
          shape->watched = true;
  }

  Contact& contact(std::size_t index)
  {
    while (pool.size() <= index)
      pool.emplace_back(new Contact);
    return *pool[index];
  }

  void add(const ode_sim::ContactRecord& r, std::map<std::pair<int, int>, Contact*>& pairs, PairOrder& order,
           const WorldPtr& world)
  {
    Collision *one = collision_of(r.collision1), *two = collision_of(r.collision2);
    if (!one || !two)
      return;
    const bool swapped = !order.InOrder(*one->Core(), *two->Core());
    const double sign = swapped ? -1 : 1;
    if (swapped)
      std::swap(one, two);
    Contact*& c = pairs[{ r.collision1, r.collision2 }];
    if (!c)
    {
      c = &contact(contacts.size());
      c->collision1 = one, c->collision2 = two, c->count = 0, c->world = world, c->time = world->SimTime();
      contacts.push_back(c);
    }
    if (c->count >= MAX_CONTACT_JOINTS)
      return;
    const int i = c->count++;
    c->positions[i].Set(r.position[0], r.position[1], r.position[2]);
    c->normals[i].Set(sign * r.normal[0], sign * r.normal[1], sign * r.normal[2]);
    c->depths[i] = r.depth;
    const Vector3d force(sign * r.force[0], sign * r.force[1], sign * r.force[2]);
    const auto turned = [&](const Collision& on, const Vector3d& f, const Vector3d& arm, Vector3d& f_L, Vector3d& t_L) {
      const auto rotation = on.GetLink()->WorldPose().Rot();
      f_L = rotation.RotateVectorReverse(f);
      t_L = rotation.RotateVectorReverse(arm.Cross(f));
    };
    turned(*one, force, c->positions[i] - one->GetLink()->WorldCoGPose().Pos(), c->wrench[i].body1Force,
           c->wrench[i].body1Torque);
    turned(*two, -force, c->positions[i] - two->GetLink()->WorldCoGPose().Pos(), c->wrench[i].body2Force,
           c->wrench[i].body2Torque);
  }
};

ContactManager::ContactManager() : data_(new Private) {}
ContactManager::~ContactManager() = default;

const std::vector<Contact*>& ContactManager::GetContacts() const
{
  const WorldPtr world = Mirror::Get().GetWorld();
  Private& d = *data_;
  if (!world || (d.iterations == world->Core()->scene().iterations && d.time == world->Core()->scene().time_ns))
    return d.contacts;
  const boost::recursive_mutex::scoped_lock lock(step_mutex());
  d.watch(*world->Core());
  d.time = world->Core()->scene().time_ns, d.iterations = world->Core()->scene().iterations;
  d.contacts.clear();
  std::map<std::pair<int, int>, Contact*> pairs;
  PairOrder order;
  const ode_sim::OdeScope scope;
  for (const auto& record : world->Core()->contacts())
    d.add(record, pairs, order, world);
  return d.contacts;
}

Contact* ContactManager::GetContact(unsigned int index) const
{
  const auto& all = GetContacts();
  return index < all.size() ? all[index] : nullptr;
}

namespace
{

std::string topic_of(std::string name)
{
  for (std::size_t at; (at = name.find("::")) != std::string::npos;)
    name.replace(at, 2, "/");
  return "~/" + name + "/contacts";
}

}  // namespace

std::string ContactManager::CreateFilter(const std::string& name, const std::vector<std::string>& collisions)
{
  const boost::recursive_mutex::scoped_lock lock(step_mutex());
  data_->filters[name] = collisions;
  Mirror::Get().GetTopics()->AddFilter(topic_of(name), collisions);
  return topic_of(name);
}

std::string ContactManager::CreateFilter(const std::string& name, const std::string& collision)
{
  return CreateFilter(name, std::vector<std::string>{ collision });
}

std::string ContactManager::CreateFilter(const std::string& name, const std::map<std::string, CollisionPtr>& collisions)
{
  std::vector<std::string> names;
  for (const auto& collision : collisions)
    names.push_back(collision.second->GetScopedName());
  return CreateFilter(name, names);
}

void ContactManager::RemoveFilter(const std::string& name)
{
  const boost::recursive_mutex::scoped_lock lock(step_mutex());
  data_->filters.erase(name);
  Mirror::Get().GetTopics()->RemoveFilter(topic_of(name));
}
unsigned int ContactManager::GetFilterCount() { return static_cast<unsigned int>(data_->filters.size()); }
bool ContactManager::HasFilter(const std::string& name) { return data_->filters.count(name) > 0; }
void ContactManager::PublishContacts() {}

}  // namespace physics
}  // namespace gazebo
