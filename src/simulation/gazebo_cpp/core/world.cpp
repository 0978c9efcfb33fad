// World, PhysicsEngine.
#include <gazebo/common/common.hh>
#include <gazebo/physics/ode/ODECollision.hh>
#include <gazebo/physics/ode/ODEMultiRayShape.hh>
#include <gazebo/physics/physics.hh>

#include <cmath>
#include <iostream>

#include <limits.hpp>

#include "mirror.hpp"
#include "sdf_text.hpp"
#include "topics.hpp"

namespace gazebo
{
namespace physics
{

using ignition::math::Vector3d;

World::World(const std::string& name)
  : name_(name)
  , place_(new common::SphericalCoordinates)
  , start_(common::Time::GetWallTime())
{
}
World::~World() = default;

const sdf::ElementPtr World::SDF()
{
  if (!sdf_)
    sdf_ = world_element(text_, name_);
  return sdf_;
}

Wind& World::Wind() const
{
  if (!wind_)
  {
    wind_.reset(new class Wind);
    if (text_.find("<wind") != std::string::npos)
      if (const sdf::ElementPtr told = inside(const_cast<World*>(this)->SDF(), "wind"))
        if (told->HasElement("linear_velocity"))
          wind_->SetLinearVel(told->Get<Vector3d>("linear_velocity"));
  }
  return *wind_;
}

Vector3d Wind::WorldLinearVel(const Entity* entity) const { return function_ ? function_(this, entity) : velocity_; }
Vector3d Wind::RelativeLinearVel(const Entity* entity) const
{
  return entity->WorldPose().Rot().RotateVectorReverse(WorldLinearVel(entity));
}

class Atmosphere& World::Atmosphere() const
{
  if (!atmosphere_)
    atmosphere_.reset(
        new AdiabaticAtmosphere(*const_cast<World*>(this), text_.find("<atmosphere") == std::string::npos
                                                               ? sdf::ElementPtr()
                                                               : inside(const_cast<World*>(this)->SDF(), "atmosphere")));
  return *atmosphere_;
}

// The standard atmosphere of ISO 2533 below 11 km, with the world's own gravity.
const double Atmosphere::MOLAR_MASS = 0.0289644;            // kg/mol
const double Atmosphere::IDEAL_GAS_CONSTANT_R = 8.3144621;  // J/(mol K)

Atmosphere::Atmosphere(class World& world, const sdf::ElementPtr& sdf) : world_(world)
{
  const auto number = [&sdf](const char* tag, double& value) {
    if (inside(sdf, tag))
      value = sdf->Get<double>(tag);
  };
  number("temperature", temperature_);
  number("temperature_gradient", gradient_);
  number("pressure", pressure_);
}

double Atmosphere::Temperature(double altitude) const { return temperature_ + gradient_ * altitude; }

double Atmosphere::Pressure(double altitude) const
{
  const double exponent = world_.Gravity().Length() * MOLAR_MASS / IDEAL_GAS_CONSTANT_R;
  if (gradient_ == 0)
    return pressure_ * std::exp(-exponent * altitude / temperature_);
  return pressure_ * std::pow(Temperature(altitude) / temperature_, -exponent / gradient_);
}

double Atmosphere::MassDensity(double altitude) const
{
  return Pressure(altitude) * MOLAR_MASS / (IDEAL_GAS_CONSTANT_R * Temperature(altitude));
}

Vector3d World::Gravity() const { return ign(core_->settings().gravity); }
void World::SetGravity(const Vector3d& gravity)
{
  change(name_, [&] { core_->settings().gravity = ode_sim::limited(ode(gravity), 1e9, "gravity"); });
}

Model_V World::Models() const
{
  const std::lock_guard<std::mutex> lock(models_mutex_);
  return models_;
}
unsigned int World::ModelCount() const { return static_cast<unsigned int>(Models().size()); }
ModelPtr World::ModelByIndex(unsigned int index) const
{
  const Model_V models = Models();
  return index < models.size() ? models[index] : ModelPtr();
}

std::string World::StripWorldName(const std::string& name) const
{
  const std::string own = name_ + "::";
  return name.compare(0, own.size(), own) == 0 ? name.substr(own.size()) : name;
}

ModelPtr World::ModelByName(const std::string& name) const
{
  const std::string own = StripWorldName(name);
  for (const ModelPtr& model : Models())
    if (model->GetName() == own)
      return model;
  return ModelPtr();
}

BasePtr World::BaseByName(const std::string& name) const
{
  const std::string own = StripWorldName(name);
  for (const ModelPtr& model : Models())
    if (BasePtr found = model->GetByName(own))
      return found;
  return BasePtr();
}

EntityPtr World::EntityByName(const std::string& name) const
{
  const std::string own = StripWorldName(name);
  if (const ModelPtr model = ModelByName(own))
    return model;
  return boost::dynamic_pointer_cast<Entity>(BaseByName(own));
}

std::string World::UniqueModelName(const std::string& name)
{
  std::string made = name;
  for (int i = 0; ModelByName(made); ++i)
    made = name + "_" + std::to_string(i);
  return made;
}

EntityPtr World::EntityBelowPoint(const Vector3d& point) const
{
  RayShape ray{ CollisionPtr() };
  ray.SetPoints(point, point - Vector3d(0, 0, 1000));
  double distance = 0;
  std::string name;
  ray.GetIntersection(distance, name);
  return name.empty() ? EntityPtr() : EntityByName(name);
}

ModelPtr World::ModelBelowPoint(const Vector3d& point) const
{
  const EntityPtr entity = EntityBelowPoint(point);
  return entity ? entity->GetParentModel() : ModelPtr();
}

// -- time ---------------------------------------------------------------------------------------------------------------------------

common::Time World::SimTime() const
{
  const int64_t ns = Mirror::Get().Now();
  return { static_cast<int32_t>(ns / 1000000000), static_cast<int32_t>(ns % 1000000000) };
}
common::Time World::RealTime() const { return common::Time::GetWallTime() - start_ - PauseTime(); }
common::Time World::PauseTime() const { return paused_ ? common::Time::GetWallTime() - paused_since_ : common::Time::Zero; }
uint32_t World::Iterations() const { return static_cast<uint32_t>(core_->scene().iterations); }

void World::SetPaused(bool paused)
{
  if (paused == paused_)
    return;
  paused_ = paused;
  if (Mirror::Get().host.order)
    Mirror::Get().host.order(paused ? "pause" : "unpause");
}

void World::Step(unsigned int steps)
{
  if (Mirror::Get().host.step)
    Mirror::Get().host.step(steps);
}

namespace
{
void order(const char* what)
{
  if (Mirror::Get().host.order)
    Mirror::Get().host.order(what);
}
}  // namespace

void World::Reset() { order("reset"); }
void World::ResetTime() { order("reset_time"); }
void World::SetSimTime(const common::Time& time)
{
  const int64_t ns = static_cast<int64_t>(time.sec) * 1000000000 + time.nsec;
  Mirror::Get().SetNow(ns);  // who asks in this step is told so already
  order(("set_time " + std::to_string(ns)).c_str());
}
void World::ResetEntities(Base::EntityType) { order("reset_poses"); }

void World::ResetPhysicsStates()
{
  for (const ModelPtr& model : Models())
    model->ResetPhysicsStates();
}

void World::SetPhysicsEnabled(bool enable)
{
  if (!enable)
    refused("World::SetPhysicsEnabled(false) has no effect here; pause the world (SetPaused)");
}

// -- models -------------------------------------------------------------------------------------------------------------------------

void World::InsertModelString(const std::string& text)
{
  if (Mirror::Get().host.insert)
    Mirror::Get().host.insert(text, {});
}

void World::InsertModelSDF(const sdf::SDF& sdf) { InsertModelString(sdf.ToString()); }

void World::InsertModelFile(const std::string& file)
{
  const std::string text = model_file(file);
  if (!text.empty())
    InsertModelString(text);
}

void World::LoadPlugin(const std::string& filename, const std::string& name, sdf::ElementPtr sdf)
{
  if (Mirror::Get().host.plugin)
    Mirror::Get().host.plugin(filename, name, sdf ? sdf->ToString("") : "");
}

void World::RemoveModel(const std::string& name)
{
  if (Mirror::Get().host.remove)
    Mirror::Get().host.remove(StripWorldName(name));
}

void World::RemoveModel(ModelPtr model)
{
  if (model)
    RemoveModel(model->GetName());
}

void World::ClearModels()
{
  for (const ModelPtr& model : Models())
    RemoveModel(model);
}

void World::EnableAllModels()
{
  for (const ModelPtr& model : Models())
    model->SetEnabled(true);
}

void World::DisableAllModels()
{
  for (const ModelPtr& model : Models())
    model->SetEnabled(false);
}

void World::PrintEntityTree()
{
  for (const ModelPtr& model : Models())
    model->Print("");
}

// -- PhysicsEngine ------------------------------------------------------------------------------------------------------------------

PhysicsEngine::PhysicsEngine(WorldPtr world) : world_(world.get()), contacts_(new ContactManager) {}
PhysicsEngine::~PhysicsEngine() = default;

WorldPtr PhysicsEngine::World() const { return world_->shared_from_this(); }
void PhysicsEngine::SetSeed(uint32_t seed) { world_->core_->settings().seed = seed; }
double PhysicsEngine::GetMaxStepSize() const { return world_->core_->settings().dt; }
double PhysicsEngine::GetUpdatePeriod() { return update_rate_ > 0 ? 1 / update_rate_ : 0; }
void PhysicsEngine::SetGravity(const Vector3d& gravity) { world_->SetGravity(gravity); }
void PhysicsEngine::SetMaxContacts(unsigned int most) { SetParam("max_contacts", static_cast<int>(most)); }

void PhysicsEngine::SetRealTimeUpdateRate(double rate)
{
  update_rate_ = rate;
  if (Mirror::Get().host.parameter)
    Mirror::Get().host.parameter("real_time_update_rate", rate);
}

void PhysicsEngine::SetMaxStepSize(double step)
{
  if (Mirror::Get().host.parameter)
    Mirror::Get().host.parameter("max_step_size", step);
}

sdf::ElementPtr PhysicsEngine::GetSDF() const
{
  const sdf::ElementPtr world = world_->SDF();
  return world && world->HasElement("physics") ? world->GetElement("physics") : sdf::ElementPtr();
}

ShapePtr PhysicsEngine::CreateShape(const std::string& type, CollisionPtr collision)
{
  if (type == "ray")
    return ShapePtr(new RayShape(collision));
  if (type == "multiray")
    return ShapePtr(new ODEMultiRayShape(collision));
  refused("PhysicsEngine::CreateShape(\"" + type + "\"): only rays can be made while the simulation runs");
  return ShapePtr();
}

CollisionPtr PhysicsEngine::CreateCollision(const std::string& type, LinkPtr link)
{
  const CollisionPtr collision(new ODECollision(link));
  const ShapePtr shape = CreateShape(type, collision);
  if (!shape)
    return CollisionPtr();
  collision->SetWorld(World());
  shape->SetWorld(World());
  collision->SetShape(shape);
  return collision;
}

CollisionPtr PhysicsEngine::CreateCollision(const std::string& type, const std::string& link)
{
  const LinkPtr found = boost::dynamic_pointer_cast<Link>(World()->EntityByName(link));
  if (!found)
    gzerr << "PhysicsEngine::CreateCollision(): the world has no link '" << link << "'\n";
  return found ? CreateCollision(type, found) : CollisionPtr();
}

JointPtr PhysicsEngine::CreateJoint(const std::string& type, ModelPtr model)
{
  static const std::map<std::string, Base::EntityType> types = {
    { "revolute", Base::HINGE_JOINT }, { "prismatic", Base::SLIDER_JOINT },    { "fixed", Base::FIXED_JOINT },
    { "ball", Base::BALL_JOINT },      { "universal", Base::UNIVERSAL_JOINT }, { "revolute2", Base::HINGE2_JOINT },
    { "screw", Base::SCREW_JOINT },    { "gearbox", Base::GEARBOX_JOINT }
  };
  const auto found = types.find(type);
  if (found == types.end())
    gzthrow("there is no joint of type '" << type << "'");
  JointPtr joint(new Joint(model));
  joint->AddType(found->second);
  joint->SetWorld(World());
  return joint;
}

namespace
{

/// What a boost::any of some kind of number holds; NaN if it is none.
double number(const boost::any& value)
{
  if (const auto* v = boost::any_cast<double>(&value))
    return *v;
  if (const auto* v = boost::any_cast<float>(&value))
    return *v;
  if (const auto* v = boost::any_cast<int>(&value))
    return *v;
  if (const auto* v = boost::any_cast<unsigned int>(&value))
    return *v;
  if (const auto* v = boost::any_cast<bool>(&value))
    return *v;
  return std::numeric_limits<double>::quiet_NaN();
}

const std::map<std::string, std::string>& settings()
{
  static const std::map<std::string, std::string> names = { { "max_step_size", "max_step_size" },
                                                            { "real_time_update_rate", "real_time_update_rate" },
                                                            { "iters", "iters" },
                                                            { "precon_iters", "precon_iters" },
                                                            { "sor", "sor" },
                                                            { "cfm", "cfm" },
                                                            { "erp", "erp" },
                                                            { "max_contacts", "max_contacts" },
                                                            { "contact_max_correcting_vel", "contact_max_correcting_vel" },
                                                            { "contact_surface_layer", "contact_surface_layer" } };
  return names;
}

}  // namespace

bool PhysicsEngine::SetParam(const std::string& key, const boost::any& value)
{
  if (key == "gravity")
  {
    const auto* gravity = boost::any_cast<Vector3d>(&value);
    if (gravity)
      SetGravity(*gravity);
    return gravity != nullptr;
  }
  const auto name = settings().find(key);
  const double v = number(value);
  if (name == settings().end() || std::isnan(v))
  {
    refused("PhysicsEngine::SetParam(\"" + key + "\") has no effect here" +
            (name == settings().end() ? "" : ": it takes a number"));
    return false;
  }
  if (key == "real_time_update_rate")
    update_rate_ = v;
  if (Mirror::Get().host.parameter)
    Mirror::Get().host.parameter(name->second, v);
  return true;
}

bool PhysicsEngine::GetParam(const std::string& key, boost::any& value) const
{
  const ode_sim::Settings& s = world_->core_->settings();
  const std::map<std::string, boost::any> all = { { "type", std::string("ode") },
                                                  { "max_step_size", s.dt },
                                                  { "real_time_update_rate", update_rate_ },
                                                  { "real_time_factor", target_factor_ },
                                                  { "gravity", ign(s.gravity) },
                                                  { "magnetic_field", world_->magnetic_ },
                                                  { "solver_type", std::string("quick") },
                                                  { "iters", s.iters },
                                                  { "sor", s.sor },
                                                  { "cfm", s.cfm },
                                                  { "erp", s.erp },
                                                  { "max_contacts", s.max_contacts },
                                                  { "contact_max_correcting_vel", s.contact_max_vel },
                                                  { "contact_surface_layer", s.surface_layer },
                                                  { "friction_model", std::string("pyramid_model") } };
  const auto found = all.find(key);
  if (found != all.end())
    value = found->second;
  return found != all.end();
}

boost::any PhysicsEngine::GetParam(const std::string& key) const
{
  boost::any value;
  if (!GetParam(key, value))
    refused("PhysicsEngine::GetParam(\"" + key + "\"): there is no such parameter here");
  return value;
}

}  // namespace physics
}  // namespace gazebo
