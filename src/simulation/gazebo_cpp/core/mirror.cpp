#include "mirror.hpp"

#include <mutex>
#include <set>

#include <gazebo/physics/ode/ODELink.hh>
#include <gazebo/physics/ode/ODEPhysics.hh>

#include "contacts.hpp"
#include "sdf_text.hpp"
#include "topics.hpp"
#include "transport.hpp"

namespace gazebo
{
namespace physics
{

boost::recursive_mutex& step_mutex()
{
  const WorldPtr world = Mirror::Get().GetWorld();
  static boost::recursive_mutex* none = new boost::recursive_mutex;
  return world ? *world->Physics()->GetPhysicsUpdateMutex() : *none;
}

void refused(const std::string& text)
{
  static std::mutex* mutex = new std::mutex;
  static auto* said = new std::set<std::string>;
  const std::lock_guard<std::mutex> lock(*mutex);
  const char* who = internal::CurrentPlugin();
  const std::string line = (who ? std::string(who) + ": " : "") + text;
  if (said->size() < 1000 && said->insert(line).second)
    internal::Report(false, line);
}

namespace
{
thread_local int held_by_thread = 0;
}  // namespace

void WorldLock::Take()
{
  step_mutex().lock();
  ++held_by_thread;
}

bool WorldLock::TakeAtOnce()
{
  const bool taken = step_mutex().try_lock();
  held_by_thread += taken;
  return taken;
}

void WorldLock::Give()
{
  --held_by_thread;
  step_mutex().unlock();
}

WorldLock::Without::Without() : held(held_by_thread)
{
  while (held_by_thread)
    Give();
}

WorldLock::Without::~Without()
{
  for (int i = 0; i < held; ++i)
    Take();
}

void change(const std::string& who, const std::function<void()>& f)
{
  const boost::recursive_mutex::scoped_lock lock(step_mutex());
  try
  {
    f();
  }
  catch (const std::exception& error)
  {
    refused(who + ": " + error.what() + "; nothing is changed");
  }
}

// -- the world ----------------------------------------------------------------------------------------------------------------------

Mirror& Mirror::Get()
{
  static Mirror* one = new Mirror;
  return *one;
}

void Mirror::Start(ode_sim::World* core, const std::string& name, const std::string& text, double update_rate)
{
  const WorldPtr world(new World(name));
  world->core_ = core;
  world->text_ = text;
  world->physics_.reset(new ODEPhysics(world));
  world->physics_->update_rate_ = update_rate;
  if (began != common::Time::Zero)
    world->start_ = began;
  sdf::setFindCallback([](const std::string& file) { return common::SystemPaths::Instance()->FindFile(file); });
  world_ = world;
  now_ns_ = core->scene().time_ns;
  transport::set_world(name);
  topics_ = new Topics(name);
  core->observer = this;
  event::Events::worldCreated(name);
}

void Mirror::Describe(const std::vector<double>& magnetic_field, const std::vector<double>& place)
{
  world_->magnetic_.Set(magnetic_field.at(0), magnetic_field.at(1), magnetic_field.at(2));
  common::SphericalCoordinates& there = *world_->place_;
  constexpr double degree = 3.14159265358979323846 / 180;
  there.SetLatitudeReference(place.at(0) * degree), there.SetLongitudeReference(place.at(1) * degree);
  there.SetElevationReference(place.at(2)), there.SetHeadingOffset(place.at(3) * degree);
}

void Mirror::Stop()
{
  if (world_)
    world_->core_->observer = nullptr;
}

bool Mirror::Mentions(const Model& model, const std::string& element)
{
  return model.text_.find('<' + element) != std::string::npos;
}

void Mirror::SetPaused(bool paused)
{
  if (!world_ || world_->paused_ == paused)
    return;
  world_->paused_ = paused;
  const WorldLock::Without unlocked;
  event::Events::pause(paused);
}

void Mirror::WasReset(bool time)
{
  last_ns_ = world_->core_->scene().time_ns;
  now_ns_ = last_ns_;
  const WorldLock::Without unlocked;
  if (time)
    event::Events::timeReset();
  else
    event::Events::worldReset();
}

// -- models -------------------------------------------------------------------------------------------------------------------------

namespace
{

ShapePtr make_shape(const CollisionPtr& collision, const CollisionRecord& r)
{
  const auto n = [&](std::size_t i) { return i < r.numbers.size() ? r.numbers[i] : 0.0; };
  if (r.kind == "box")
    return ShapePtr(new BoxShape(collision, { n(0), n(1), n(2) }));
  if (r.kind == "sphere")
    return ShapePtr(new SphereShape(collision, n(0)));
  if (r.kind == "cylinder" || r.kind == "capsule")
    return ShapePtr(new CylinderShape(collision, n(0), n(1)));
  if (r.kind == "plane")
    return ShapePtr(new PlaneShape(collision, { n(0), n(1), n(2) }, { n(3), n(4) }));
  if (r.kind == "mesh")
    return ShapePtr(new MeshShape(collision, r.uri, { n(0), n(1), n(2) }));
  if (r.kind == "heightmap")
    return ShapePtr(new HeightmapShape(collision, r.uri, { n(0), n(1), n(2) }, { n(3), n(4), n(5) }, static_cast<int>(n(6))));
  std::vector<ignition::math::Vector2d> corners;
  for (std::size_t i = 1; i + 1 < r.numbers.size(); i += 2)
    corners.emplace_back(n(i), n(i + 1));
  return ShapePtr(new PolylineShape(collision, n(0), corners));
}

Base::EntityType type_of(const std::string& type)
{
  static const std::map<std::string, Base::EntityType> types = {
    { "prismatic", Base::SLIDER_JOINT },    { "fixed", Base::FIXED_JOINT },      { "ball", Base::BALL_JOINT },
    { "universal", Base::UNIVERSAL_JOINT }, { "revolute2", Base::HINGE2_JOINT }, { "screw", Base::SCREW_JOINT },
    { "gearbox", Base::GEARBOX_JOINT }
  };
  const auto found = types.find(type);
  return found == types.end() ? Base::HINGE_JOINT : found->second;
}

template <class T, class Items>
T* with_id(const Items& items, int id)
{
  for (const auto& item : items)
    if (item->id == id)
      return item.get();
  throw std::runtime_error("the simulator's core has no part with this number");
}

}  // namespace

void Mirror::addLink(Model& model, const LinkRecord& record)
{
  const LinkPtr link(new ODELink(model.shared_from_this()));
  link->SetName(record.name);
  // Whoever has the link keeps the whole model of the core: it points into it.
  link->core_ = std::shared_ptr<ode_sim::Link>(model.core_, with_id<ode_sim::Link>(model.core_->links, record.id));
  for (const std::string& sensor : record.sensors)
    link->sensors_.push_back(link->GetScopedName(true) + "::" + sensor);
  link->SetCanonicalLink(model.links_.empty());
  link->SetInitialRelativePose(link->WorldPose() - ign(model.core_->links.front()->X_WL));
  const ode_sim::Sym3& I = link->core_->inertia;
  link->inertial->SetMass(link->core_->mass);
  link->inertial->SetCoG(ign(link->core_->com));
  link->inertial->SetInertiaMatrix(I.xx, I.yy, I.zz, I.xy, I.xz, I.yz);
  for (const CollisionRecord& each : record.collisions)
  {
    const CollisionPtr collision(new Collision(link));
    collision->SetName(each.name);
    collision->core_ = std::shared_ptr<ode_sim::Shape>(model.core_, with_id<ode_sim::Shape>(link->core_->shapes, each.shape));
    collision->SetInitialRelativePose(ign(collision->core_->X_LC));
    collision->shape_ = make_shape(collision, each);
    collision->shape_->SetName(each.kind);
    collision->surface_.reset(new SurfaceParams(collision->core_));
    collision->retro_ = static_cast<float>(each.retro);
    number_collision(each.shape, collision.get());
    link->collisions_.push_back(collision);
    link->AddChild(collision);
  }
  model.links_.push_back(link);
  model.AddChild(link);
}

void Mirror::addJoint(Model& model, const JointRecord& record)
{
  const JointPtr joint(new Joint(model.shared_from_this()));
  joint->SetName(record.name);
  joint->AddType(type_of(record.type));
  joint->core_ = std::shared_ptr<ode_sim::Joint>(model.core_, with_id<ode_sim::Joint>(model.core_->joints, record.id));
  for (const LinkPtr& link : model.links_)
  {
    if (link->core_.get() == joint->core_->parent)
      joint->parent_ = link;
    if (link->core_.get() == joint->core_->child)
      joint->child_ = link;
  }
  model.joints_.push_back(joint);
  model.AddChild(joint);
}

namespace
{

void read_wind_mode(const sdf::ElementPtr& element, bool& windy)
{
  if (element && element->HasElement("enable_wind"))
    windy = element->Get<bool>("enable_wind");
}

}  // namespace

// Its text is read for nothing else.
void Mirror::readWindModes(Model& model)
{
  const sdf::ElementPtr element = model.GetSDF();
  bool all = false;
  read_wind_mode(element, all);
  for (auto each = inside(element, "link"); each; each = each->GetNextElement("link"))
    if (const LinkPtr link = model.GetLink(each->Get<std::string>("name")))
    {
      bool windy = all;
      read_wind_mode(each, windy);
      link->SetWindMode(windy);
    }
}

void Mirror::readBatteries(Model& model)
{
  for (auto each = inside(model.GetSDF(), "link"); each; each = each->GetNextElement("link"))
    if (const LinkPtr link = model.GetLink(each->Get<std::string>("name")))
      for (auto battery = inside(each, "battery"); battery; battery = battery->GetNextElement("battery"))
      {
        link->batteries_.push_back(std::make_shared<common::Battery>());
        link->batteries_.back()->Load(battery);
        batteries_.push_back(link->batteries_.back());
      }
}

void Mirror::Add(const ModelRecord& record)
{
  const boost::shared_ptr<Actor> actor(record.actor ? new Actor(BasePtr()) : nullptr);
  const ModelPtr model = actor ? ModelPtr(actor) : ModelPtr(new Model(BasePtr()));
  for (const auto& [name, length] : record.animations)
    actor->animations_.emplace(name, new common::SkeletonAnimation(name, length));
  model->SetWorld(world_);
  model->SetName(record.name);
  model->text_ = record.text;
  for (const auto& core : world_->core_->scene().models)
    if (core->id == record.id)
      model->core_ = core;
  if (!model->core_)
    throw std::runtime_error("the simulator's core has no model '" + record.name + "'");
  for (const LinkRecord& link : record.links)
    addLink(*model, link);
  for (const JointRecord& joint : record.joints)
    addJoint(*model, joint);
  if (!model->links_.empty())
    model->X_LM_ = ign(record.X_WM) - model->links_.front()->WorldPose();
  model->SetInitialRelativePose(ign(record.X_WM));
  if (model->text_.find("<enable_wind") != std::string::npos)
    readWindModes(*model);
  if (record.text.find("<battery") != std::string::npos)
    readBatteries(*model);
  {
    const std::lock_guard<std::mutex> lock(world_->models_mutex_);
    world_->models_.push_back(model);
  }
  const WorldLock::Without unlocked;
  event::Events::addEntity(record.name);
  topics_->TellOf(*model);
}

ActorPtr Mirror::FindActor(const std::string& name) const
{
  return boost::dynamic_pointer_cast<Actor>(world_ ? world_->ModelByName(name) : ModelPtr());
}

void Mirror::Remove(const std::string& name)
{
  const ModelPtr model = world_->ModelByName(name);
  if (!model)
    return;
  {
    const std::lock_guard<std::mutex> lock(world_->models_mutex_);
    auto& models = world_->models_;
    models.erase(std::find(models.begin(), models.end(), model));
  }
  for (const LinkPtr& link : model->links_)
  {
    for (const CollisionPtr& collision : link->collisions_)
      number_collision(collision->core_->id, nullptr);
    for (const common::BatteryPtr& battery : link->batteries_)
      batteries_.erase(std::find(batteries_.begin(), batteries_.end(), battery));
  }
  const WorldLock::Without unlocked;
  event::Events::deleteEntity(name);
}

// -- every step ---------------------------------------------------------------------------------------------------------------------

void Mirror::Watch(const LinkPtr& link)
{
  const boost::recursive_mutex::scoped_lock lock(step_mutex());
  link->watched_ = true;
  link->v_ = link->WorldCoGLinearVel(), link->w_ = link->WorldAngularVel();
  watched_.push_back(link);
}

void Mirror::accelerations()
{
  const double dt = (now_ns_ - last_ns_) * 1e-9;
  for (auto& weak : watched_)
  {
    const LinkPtr link = weak.lock();
    if (!link || !(dt > 0))
      continue;
    const auto v = link->WorldCoGLinearVel(), w = link->WorldAngularVel();
    link->a_ = (v - link->v_) / dt, link->alpha_ = (w - link->w_) / dt;
    link->v_ = v, link->w_ = w;
  }
}

void Mirror::before(int64_t time_ns)
{
  frozen_.reset();  // of a step that never ended
  last_ns_ = world_->core_->scene().time_ns;
  now_ns_ = time_ns;
  if (host.clock)
    host.clock(time_ns * 1e-9);
  common::UpdateInfo info;
  info.worldName = world_->Name();
  info.simTime = world_->SimTime();
  info.realTime = world_->RealTime();
  event::Events::worldUpdateBegin(info);
  for (const ModelPtr& model : world_->models_)
    if (model->controller_)
      model->controller_->Update();
  for (const common::BatteryPtr& battery : batteries_)
    battery->Update();
  event::Events::beforePhysicsUpdate(info);
  frozen_.reset(new boost::recursive_mutex::scoped_lock(step_mutex()));
}

void Mirror::after(int64_t)
{
  accelerations();
  topics_->Publish(*world_);
  frozen_.reset();
  event::Events::worldUpdateEnd();
}

// -- free functions -----------------------------------------------------------------------------------------------------------------

WorldPtr get_world(const std::string& name)
{
  const WorldPtr world = Mirror::Get().GetWorld();
  if (!world || (!name.empty() && name != world->Name()))
    gzthrow("there is no world" << (name.empty() ? "" : " named '" + name + "'")
                                << (world ? "; it is '" + world->Name() + "'" : ""));
  return world;
}

bool has_world(const std::string& name)
{
  const WorldPtr world = Mirror::Get().GetWorld();
  return world && (name.empty() || name == world->Name());
}

void pause_world(WorldPtr world, bool pause)
{
  if (world)
    world->SetPaused(pause);
}

void pause_worlds(bool pause) { pause_world(Mirror::Get().GetWorld(), pause); }

}  // namespace physics
}  // namespace gazebo
