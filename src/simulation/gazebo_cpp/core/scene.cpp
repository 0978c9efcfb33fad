// What plugins ask of what is drawn: the cameras, and where visuals are.
#include <gazebo/rendering/Scene.hh>

#include <algorithm>

#include <gazebo/physics/physics.hh>
#include <gazebo/rendering/Camera.hh>
#include <gazebo/rendering/RenderEvents.hh>
#include <gazebo/rendering/RenderingIface.hh>
#include <gazebo/rendering/Visual.hh>

#include "mirror.hpp"

namespace gazebo
{
namespace rendering
{

using ignition::math::Color;
using ignition::math::Pose3d;
using ignition::math::Quaterniond;
using ignition::math::Vector3d;
using Lock = std::lock_guard<std::mutex>;

event::EventT<void(const std::string&)>& Events::createScene = *new event::EventT<void(const std::string&)>;
event::EventT<void(const std::string&)>& Events::removeScene = *new event::EventT<void(const std::string&)>;

ScenePtr get_scene(const std::string&)
{
  static std::mutex* mutex = new std::mutex;
  static ScenePtr* one = new ScenePtr;
  const Lock lock(*mutex);
  const physics::WorldPtr world = physics::Mirror::Get().GetWorld();
  if (!*one && world)
    one->reset(new Scene(world->Name()));
  return *one;
}

// -- Scene --------------------------------------------------------------------------------------------------------------------------

Scene::~Scene() = default;

common::Time Scene::SimTime() const
{
  const int64_t* const ns = Camera::During::Time();
  return ns ? common::Time(static_cast<int32_t>(*ns / 1000000000), static_cast<int32_t>(*ns % 1000000000))
            : physics::get_world()->SimTime();
}

namespace
{

void not_drawn(const std::string& what)
{
  physics::refused(what +
                   "() of what is drawn has no effect: a plugin sees here where visuals are, and cannot change how they look");
}

VisualPtr of_entity(const physics::EntityPtr& entity)
{
  return entity ? std::make_shared<Visual>(entity->GetScopedName(), entity, Pose3d(), entity->GetSDF()) : VisualPtr();
}

/// The <visual> of a link's SDF.
VisualPtr of_element(const physics::EntityPtr& link, const std::string& name)
{
  const physics::ModelPtr model = link->GetParentModel();
  const sdf::ElementPtr sdf = model ? model->GetSDF() : sdf::ElementPtr();
  for (auto each = sdf && sdf->HasElement("link") ? sdf->GetElement("link") : sdf::ElementPtr(); each;
       each = each->GetNextElement("link"))
  {
    if (each->Get<std::string>("name") != link->GetName() || !each->HasElement("visual"))
      continue;
    for (auto visual = each->GetElement("visual"); visual; visual = visual->GetNextElement("visual"))
      if (visual->Get<std::string>("name") == name)
        return std::make_shared<Visual>(link->GetScopedName() + "::" + name, link,
                                        visual->HasElement("pose") ? visual->Get<Pose3d>("pose") : Pose3d(), visual);
  }
  return VisualPtr();
}

}  // namespace

VisualPtr Scene::GetVisual(const std::string& name) const
{
  const physics::WorldPtr world = physics::get_world();
  if (const VisualPtr found = of_entity(world->EntityByName(name)))
    return found;
  const std::size_t end = name.rfind("::");
  const physics::EntityPtr link = end == std::string::npos ? physics::EntityPtr() : world->EntityByName(name.substr(0, end));
  return link && link->HasType(physics::Base::LINK) ? of_element(link, name.substr(end + 2)) : VisualPtr();
}

VisualPtr Scene::GetVisual(uint32_t id) const
{
  for (const physics::ModelPtr& model : physics::get_world()->Models())
  {
    if (model->GetId() == id)
      return of_entity(model);
    for (const physics::LinkPtr& link : model->GetLinks())
      if (link->GetId() == id)
        return of_entity(link);
  }
  return VisualPtr();
}

uint32_t Scene::VisualCount() const
{
  std::size_t count = 0;
  for (const physics::ModelPtr& model : physics::get_world()->Models())
    count += 1 + model->GetLinks().size();
  return static_cast<uint32_t>(count);
}

void Scene::AddVisual(VisualPtr) { not_drawn("AddVisual"); }
void Scene::RemoveVisual(VisualPtr) { not_drawn("RemoveVisual"); }

std::vector<CameraPtr> Scene::cameras() const
{
  const Lock lock(mutex_);
  std::vector<CameraPtr> left;
  for (const auto& each : cameras_)
    if (const CameraPtr camera = each.lock())
      left.push_back(camera);
  return left;
}

CameraPtr Scene::GetCamera(uint32_t index) const
{
  const auto all = cameras();
  return index < all.size() ? all[index] : CameraPtr();
}

CameraPtr Scene::GetCamera(const std::string& name) const
{
  for (const CameraPtr& camera : cameras())
    if (camera->Name() == name)
      return camera;
  return CameraPtr();
}

void Scene::Add(const CameraPtr& camera)
{
  bool first = false;
  {
    const Lock lock(mutex_);
    first = cameras_.empty();
    cameras_.erase(std::remove_if(cameras_.begin(), cameras_.end(), [](const auto& each) { return each.expired(); }),
                   cameras_.end());
    cameras_.push_back(camera);
  }
  if (first)
    Events::createScene(name_);
}

// -- Visual -------------------------------------------------------------------------------------------------------------------------

Visual::Visual(const std::string& name, physics::EntityPtr entity, const Pose3d& X_EV, sdf::ElementPtr sdf)
  : name_(name)
  , entity_(entity)
  , X_EV_(X_EV)
  , sdf_(sdf)
{
}

Visual::~Visual() = default;

uint32_t Visual::GetId() const
{
  const physics::EntityPtr entity = entity_.lock();
  return entity ? entity->GetId() : 0;
}

ScenePtr Visual::GetScene() const { return get_scene(); }
sdf::ElementPtr Visual::GetSDF() const { return sdf_; }

VisualPtr Visual::GetParent() const
{
  const std::size_t end = name_.rfind("::");
  return end == std::string::npos ? VisualPtr() : get_scene()->GetVisual(name_.substr(0, end));
}

VisualPtr Visual::GetRootVisual() { return get_scene()->GetVisual(name_.substr(0, name_.find("::"))); }

unsigned int Visual::GetChildCount()
{
  const auto model = boost::dynamic_pointer_cast<physics::Model>(entity_.lock());
  return model ? static_cast<unsigned int>(model->GetLinks().size()) : 0;
}

VisualPtr Visual::GetChild(unsigned int index)
{
  const auto model = boost::dynamic_pointer_cast<physics::Model>(entity_.lock());
  return model && index < model->GetLinks().size() ? of_entity(model->GetLinks()[index]) : VisualPtr();
}

Pose3d Visual::WorldPose() const
{
  const physics::EntityPtr entity = entity_.lock();
  return entity ? X_EV_ + entity->WorldPose() : X_EV_;
}

Pose3d Visual::Pose() const
{
  const VisualPtr parent = GetParent();
  return parent ? WorldPose() - parent->WorldPose() : WorldPose();
}

Vector3d Visual::Position() const { return Pose().Pos(); }
Quaterniond Visual::Rotation() const { return Pose().Rot(); }
Vector3d Visual::Scale() const { return Vector3d::One; }
bool Visual::GetVisible() const { return true; }
float Visual::GetTransparency() { return 0; }
std::string Visual::GetMaterialName() const { return ""; }

void Visual::AttachVisual(VisualPtr) { not_drawn("AttachVisual"); }
void Visual::DetachVisual(VisualPtr) { not_drawn("DetachVisual"); }
void Visual::SetVisible(bool, bool) { not_drawn("SetVisible"); }
void Visual::ToggleVisible() { not_drawn("ToggleVisible"); }
void Visual::SetVisibilityFlags(uint32_t) { not_drawn("SetVisibilityFlags"); }
void Visual::SetCastShadows(bool) { not_drawn("SetCastShadows"); }
void Visual::SetMaterial(const std::string&, bool, bool) { not_drawn("SetMaterial"); }
void Visual::SetAmbient(const Color&, bool) { not_drawn("SetAmbient"); }
void Visual::SetDiffuse(const Color&, bool) { not_drawn("SetDiffuse"); }
void Visual::SetSpecular(const Color&, bool) { not_drawn("SetSpecular"); }
void Visual::SetEmissive(const Color&, bool) { not_drawn("SetEmissive"); }
void Visual::SetTransparency(float, bool) { not_drawn("SetTransparency"); }
void Visual::SetScale(const Vector3d&) { not_drawn("SetScale"); }
void Visual::SetPose(const Pose3d&) { not_drawn("SetPose"); }
void Visual::SetPosition(const Vector3d&) { not_drawn("SetPosition"); }
void Visual::SetRotation(const Quaterniond&) { not_drawn("SetRotation"); }
void Visual::SetWorldPose(const Pose3d&) { not_drawn("SetWorldPose"); }

DynamicLines* Visual::CreateDynamicLine(RenderOpType type)
{
  not_drawn("CreateDynamicLine");
  lines_.emplace_back(new DynamicLines(type));
  return lines_.back().get();
}

void Visual::DeleteDynamicLine(DynamicLines* line)
{
  lines_.erase(std::remove_if(lines_.begin(), lines_.end(), [&](const auto& each) { return each.get() == line; }),
               lines_.end());
}

// -- DynamicLines -------------------------------------------------------------------------------------------------------------------

DynamicLines::DynamicLines(RenderOpType) {}
DynamicLines::~DynamicLines() = default;
void DynamicLines::AddPoint(const Vector3d& point, const Color&) { points_.push_back(point); }
void DynamicLines::AddPoint(double x, double y, double z, const Color&) { points_.emplace_back(x, y, z); }
unsigned int DynamicLines::GetPointCount() const { return static_cast<unsigned int>(points_.size()); }
Vector3d DynamicLines::Point(unsigned int index) const { return index < points_.size() ? points_[index] : Vector3d(); }
void DynamicLines::Clear() { points_.clear(); }
void DynamicLines::SetColor(unsigned int, const Color&) {}
void DynamicLines::Update() {}
void DynamicLines::setMaterial(const std::string&) {}
void DynamicLines::setVisibilityFlags(uint32_t) {}

void DynamicLines::SetPoint(unsigned int index, const Vector3d& point)
{
  if (index < points_.size())
    points_[index] = point;
}

}  // namespace rendering
}  // namespace gazebo
