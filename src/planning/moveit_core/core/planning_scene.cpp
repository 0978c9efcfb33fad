// Scenes: frames, collisions.
#include <moveit/planning_scene/planning_scene.h>

#include <geometric_shapes/shapes.h>

#include <moveit/robot_state/conversions.h>

#include "costs.hpp"
#include "frames.hpp"
#include "log_names.hpp"
#include "shapes.hpp"

namespace planning_scene
{
using collision_detection::AllowedCollisionMatrix;
using collision_detection::CollisionEnv;
using collision_detection::CollisionRequest;
using collision_detection::CollisionResult;
using collision_detection::World;
using moveit::core::RobotState;

namespace
{
collision_detection::BodyType typeOf(motion::BodyType type)
{
  return type == motion::BodyType::RobotLink  ? collision_detection::BodyTypes::ROBOT_LINK
         : type == motion::BodyType::Attached ? collision_detection::BodyTypes::ROBOT_ATTACHED
                                              : collision_detection::BodyTypes::WORLD_OBJECT;
}
}  // namespace

const std::string PlanningScene::OCTOMAP_NS = "<octomap>";
const std::string PlanningScene::DEFAULT_SCENE_NAME = "(noname)";

// Fixed transforms, and all that the scene knows.
class PlanningScene::SceneTransforms : public moveit::core::Transforms
{
public:
  explicit SceneTransforms(const PlanningScene& scene) : Transforms(scene.getPlanningFrame()), scene_(scene) {}
  bool canTransform(const std::string& from_frame) const override { return scene_.knowsFrameTransform(from_frame); }
  bool isFixedFrame(const std::string& frame) const override
  {
    return Transforms::isFixedFrame(frame) || scene_.world_->knowsTransform(frames::withoutSlash(frame));
  }
  const Eigen::Isometry3d& getTransform(const std::string& from_frame) const override
  {
    return scene_.getFrameTransform(from_frame);
  }

private:
  const PlanningScene& scene_;
};

PlanningScene::PlanningScene(const moveit::core::RobotModelConstPtr& robot_model, const collision_detection::WorldPtr& world)
  : name_(DEFAULT_SCENE_NAME)
  , robot_model_(robot_model)
  , robot_state_(std::make_shared<RobotState>(robot_model))
  , transforms_(std::make_shared<SceneTransforms>(*this))
  , world_(world)
  , acm_(motion::AllowedCollisionMatrix(*robot_model->core()))
  , env_(new CollisionEnv(*this, true))
  , env_unpadded_(new CollisionEnv(*this, false))
  , core_(new motion::PlanningScene(robot_model->core()))
{
}

PlanningScene::PlanningScene(const urdf::ModelInterfaceSharedPtr& urdf_model, const srdf::ModelConstSharedPtr& srdf_model,
                             const collision_detection::WorldPtr& world)
  : PlanningScene(std::make_shared<moveit::core::RobotModel>(urdf_model, srdf_model), world)
{
}

PlanningScene::PlanningScene(const PlanningSceneConstPtr& parent)
  : name_(parent->name_ + "+")
  , parent_(parent)
  , robot_model_(parent->robot_model_)
  , robot_state_(std::make_shared<RobotState>(*parent->robot_state_))
  , transforms_(std::make_shared<SceneTransforms>(*this))
  , world_(std::make_shared<World>(*parent->world_))
  , acm_(parent->acm_)
  , env_(new CollisionEnv(*this, true))
  , env_unpadded_(new CollisionEnv(*this, false))
  , colors_(parent->colors_)
  , types_(parent->types_)
  , state_feasibility_(parent->state_feasibility_)
  , motion_feasibility_(parent->motion_feasibility_)
{
  transforms_->setAllTransforms(parent->transforms_->getAllTransforms());
  core_.reset(new motion::PlanningScene(parent->core()));
  std::lock_guard<std::mutex> lock(parent->core_lock_);
  in_core_ = parent->in_core_;
  acm_in_core_ = parent->acm_in_core_;
}

PlanningScene::~PlanningScene()
{
  if (observed_)
    world_->removeObserver(observer_);
}

PlanningScenePtr PlanningScene::diff() const { return PlanningScenePtr(new PlanningScene(shared_from_this())); }

PlanningScenePtr PlanningScene::diff(const moveit_msgs::PlanningScene& msg) const
{
  const PlanningScenePtr scene = diff();
  scene->setPlanningSceneDiffMsg(msg);
  return scene;
}

PlanningScenePtr PlanningScene::clone(const PlanningSceneConstPtr& scene)
{
  const PlanningScenePtr copy = scene->diff();
  copy->decoupleParent();
  copy->setName(scene->getName());
  return copy;
}

void PlanningScene::clearDiffs()
{
  if (!parent_)
    return;
  *robot_state_ = *parent_->robot_state_;
  transforms_->setAllTransforms(parent_->transforms_->getAllTransforms());
  acm_ = parent_->acm_;
  colors_ = parent_->colors_;
  types_ = parent_->types_;
  world_ = std::make_shared<World>(*parent_->world_);
}

void PlanningScene::pushDiffs(const PlanningScenePtr& scene)
{
  if (!parent_)
    return;
  moveit_msgs::PlanningScene message;
  getPlanningSceneDiffMsg(message);
  scene->setPlanningSceneDiffMsg(message);
}

// Objects that changed since the last check are handed on; how they are shared tells which.
const motion::PlanningScene& PlanningScene::core() const
{
  std::lock_guard<std::mutex> lock(core_lock_);
  for (auto it = in_core_.begin(); it != in_core_.end();)
  {
    const bool gone = !world_->hasObject(it->first);
    if (gone)
      core_->removeObject(it->first);
    it = gone ? in_core_.erase(it) : std::next(it);
  }
  for (const auto& item : *world_)
  {
    World::ObjectConstPtr& known = in_core_[item.first];
    if (known == item.second)
      continue;
    known = item.second;
    motion::WorldObject object;
    object.id = item.first;
    object.pose = known->pose_;
    object.shape_poses.assign(known->shape_poses_.begin(), known->shape_poses_.end());
    object.subframes.insert(known->subframe_poses_.begin(), known->subframe_poses_.end());
    try
    {
      for (const shapes::ShapeConstPtr& shape : known->shapes_)
        object.shapes.push_back(moveit::core::fromShape(shape));
      if (object.shapes.size() == 1 && object.shapes[0]->type == motion::ShapeType::OcTree && item.first == OCTOMAP_NS)
        core_->setOctomap(std::static_pointer_cast<const motion::OcTreeShape>(object.shapes[0]),
                          object.pose * object.shape_poses[0]);
      else
        core_->addObject(object);
    }
    catch (const motion::Error& error)
    {
      ROS_ERROR_NAMED(log_names::PLANNING_SCENE, "object '%s' is left out of collision checks: %s", item.first.c_str(),
                      error.what());
      core_->removeObject(item.first);
    }
  }
  if (acm_in_core_ != acm_.version())
  {
    core_->setAcm(acm_.core());
    acm_in_core_ = acm_.version();
  }
  return *core_;
}

// ---------------------------------------------------------------- states, frames

moveit::core::RobotStatePtr PlanningScene::getCurrentStateUpdated(const moveit_msgs::RobotState& update) const
{
  const auto state = std::make_shared<RobotState>(*robot_state_);
  moveit::core::robotStateMsgToRobotState(*transforms_, update, *state);
  return state;
}

void PlanningScene::setCurrentState(const RobotState& state) { *robot_state_ = state; }

const Eigen::Isometry3d& PlanningScene::getFrameTransform(const RobotState& state, const std::string& id) const
{
  const std::string name = frames::withoutSlash(id);
  bool found;
  const Eigen::Isometry3d& of_robot = state.getFrameTransform(name, &found);
  if (found)
    return of_robot;
  const Eigen::Isometry3d& of_world = world_->getTransform(name, found);
  if (found)
    return of_world;
  return transforms_->Transforms::getTransform(name);
}

bool PlanningScene::knowsFrameTransform(const RobotState& state, const std::string& id) const
{
  const std::string name = frames::withoutSlash(id);
  bool found;
  state.getFrameTransform(name, &found);
  return found || world_->knowsTransform(name) || transforms_->getAllTransforms().count(name);
}

// ---------------------------------------------------------------- collisions

const std::string& PlanningScene::getActiveCollisionDetectorName() const
{
  static const std::string name = "FCL";
  return name;
}

void PlanningScene::getCollisionDetectorNames(std::vector<std::string>& names) const
{
  names = { getActiveCollisionDetectorName() };
}

void PlanningScene::setActiveCollisionDetector(const collision_detection::CollisionDetectorAllocatorPtr& allocator,
                                               bool /*exclusive*/)
{
  if (allocator)
    setActiveCollisionDetector(allocator->getName());
}

bool PlanningScene::setActiveCollisionDetector(const std::string& collision_detector_name)
{
  const bool known = collision_detector_name == getActiveCollisionDetectorName();
  if (!known)
    ROS_WARN_NAMED(log_names::PLANNING_SCENE, "There is no collision detector '%s' here: FCL goes on checking",
                   collision_detector_name.c_str());
  return known;
}

void PlanningScene::addCollisionDetector(const collision_detection::CollisionDetectorAllocatorPtr& allocator)
{
  if (allocator && allocator->getName() != getActiveCollisionDetectorName())
    ROS_WARN_NAMED(log_names::PLANNING_SCENE, "There is no collision detector '%s' here: FCL goes on checking",
                   allocator->getName().c_str());
}

void PlanningScene::check(int parts, bool padded, const CollisionRequest& req, CollisionResult& res, const RobotState& state,
                          const AllowedCollisionMatrix& acm) const
{
  const motion::PlanningScene& scene = core();
  motion::CollisionRequest request;
  request.group = robot_model_->hasJointModelGroup(req.group_name) ? req.group_name : "";
  if (request.group.empty() && !req.group_name.empty())
    ROS_ERROR_NAMED(log_names::PLANNING_SCENE, "Group '%s' not found in model '%s': the whole robot is checked",
                    req.group_name.c_str(), robot_model_->getName().c_str());
  request.padded = padded;
  request.self = parts & SELF;
  request.world = parts & WORLD;
  request.distance = req.distance;
  if (req.contacts || acm.hasConditions())
  {
    request.contacts = acm.hasConditions() ? std::numeric_limits<std::size_t>::max() : req.max_contacts;
    request.contacts_per_pair =
        acm.hasConditions() ? std::max<std::size_t>(req.max_contacts_per_pair, 10) : req.max_contacts_per_pair;
  }
  const bool own = acm.version() == acm_in_core_;
  const motion::CollisionResult found = scene.check(state.core(), request, own ? nullptr : &acm.core());
  bool collision = found.collision && !acm.hasConditions();
  for (const motion::Contact& c : found.contacts)
  {
    collision_detection::Contact contact;
    contact.pos = c.position;
    contact.normal = c.normal;
    contact.depth = c.depth;
    contact.body_name_1 = c.body_1;
    contact.body_name_2 = c.body_2;
    contact.body_type_1 = typeOf(c.type_1);
    contact.body_type_2 = typeOf(c.type_2);
    contact.nearest_points[0] = contact.nearest_points[1] = c.position;
    collision_detection::DecideContactFn allowed;
    if (acm.hasConditions() && acm.getAllowedCollision(c.body_1, c.body_2, allowed) && allowed && allowed(contact))
      continue;
    collision = true;
    if (!req.contacts || res.contact_count >= req.max_contacts)
      continue;
    auto& list = res.contacts[c.body_1 < c.body_2 ? std::make_pair(c.body_1, c.body_2) : std::make_pair(c.body_2, c.body_1)];
    if (list.size() >= req.max_contacts_per_pair)
      continue;
    list.push_back(contact);
    ++res.contact_count;
    if (req.verbose)
      ROS_INFO_NAMED(log_names::PLANNING_SCENE, "Found a contact between '%s' and '%s'", c.body_1.c_str(), c.body_2.c_str());
  }
  res.collision = res.collision || collision;
  if (req.distance)
    res.distance = std::min(res.distance, found.distance);
  if (req.cost)
    addCosts(motion::costSources(scene, state.core(), request, req.max_cost_sources, own ? nullptr : &acm.core()),
             req.max_cost_sources, res.cost_sources);
}

void PlanningScene::checkCollision(const CollisionRequest& req, CollisionResult& res, const RobotState& state,
                                   const AllowedCollisionMatrix& acm) const
{
  check(SELF | WORLD, true, req, res, state, acm);
}

void PlanningScene::checkCollisionUnpadded(const CollisionRequest& req, CollisionResult& res, const RobotState& state,
                                           const AllowedCollisionMatrix& acm) const
{
  check(SELF | WORLD, false, req, res, state, acm);
}

void PlanningScene::checkSelfCollision(const CollisionRequest& req, CollisionResult& res, const RobotState& state,
                                       const AllowedCollisionMatrix& acm) const
{
  check(SELF, false, req, res, state, acm);
}

bool PlanningScene::isStateColliding(const RobotState& state, const std::string& group, bool verbose) const
{
  CollisionRequest request;
  CollisionResult result;
  request.verbose = request.contacts = verbose;
  request.group_name = group;
  checkCollision(request, result, state);
  return result.collision;
}

bool PlanningScene::isStateColliding(const moveit_msgs::RobotState& state, const std::string& group, bool verbose) const
{
  return isStateColliding(*getCurrentStateUpdated(state), group, verbose);
}

void PlanningScene::getCollidingPairs(CollisionResult::ContactMap& contacts, const RobotState& state,
                                      const AllowedCollisionMatrix& acm, const std::string& group_name) const
{
  CollisionRequest request;
  CollisionResult result;
  request.contacts = true;
  request.max_contacts = 1000;
  request.group_name = group_name;
  checkCollision(request, result, state, acm);
  contacts.swap(result.contacts);
}

void PlanningScene::getCollidingLinks(std::vector<std::string>& links, const RobotState& state,
                                      const AllowedCollisionMatrix& acm) const
{
  CollisionResult::ContactMap contacts;
  getCollidingPairs(contacts, state, acm);
  std::set<std::string> found;
  for (const auto& pair : contacts)
    for (const collision_detection::Contact& contact : pair.second)
    {
      if (contact.body_type_1 == collision_detection::BodyTypes::ROBOT_LINK)
        found.insert(contact.body_name_1);
      if (contact.body_type_2 == collision_detection::BodyTypes::ROBOT_LINK)
        found.insert(contact.body_name_2);
    }
  links.assign(found.begin(), found.end());
}
}  // namespace planning_scene
