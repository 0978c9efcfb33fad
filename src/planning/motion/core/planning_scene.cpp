#include "motion/planning_scene.hpp"

#include "checker.hpp"

namespace motion
{
const char* const PlanningScene::OCTOMAP = "<octomap>";

PlanningScene::PlanningScene(RobotModelPtr model)
  : model_(std::move(model))
  , state_(model_)
  , world_(std::make_shared<World>())
  , acm_(std::make_shared<AllowedCollisionMatrix>(*model_))
{
  rebuildRobotGeometry();
  state_.linkPoses();
}

PlanningScene::PlanningScene(const PlanningScene& other)
  : name(other.name)
  , colors(other.colors)
  , model_(other.model_)
  , state_(other.state_)
  , transforms_(other.transforms_)
  , world_(other.world_)
  , acm_(other.acm_)
  , robot_(other.robot_)
  , padding_(other.padding_)
  , scale_(other.scale_)
{
  std::lock_guard<std::mutex> lock(other.cache_lock_);
  cache_ = other.cache_;
}

PlanningScene::~PlanningScene() = default;

void PlanningScene::setState(const RobotState& state)
{
  if (state.model() != model_)
    throw InvalidInput("the state is of robot '" + state.model()->name + "', not of the scene's model");
  state_ = state;
  state_.linkPoses();
}

// ---------------------------------------------------------------- frames

namespace
{
std::string bare(const std::string& frame) { return !frame.empty() && frame[0] == '/' ? frame.substr(1) : frame; }
}  // namespace

void PlanningScene::setTransform(const std::string& frame, const Transform& pose) { transforms_[bare(frame)] = pose; }

bool PlanningScene::framePose(const std::string& given, const RobotState& state, Transform& pose) const
{
  const std::string name = bare(given);
  if (name.empty() || name == model_->frame)
  {
    pose.setIdentity();
    return true;
  }
  if (state.framePose(name, pose))
    return true;
  if (const WorldObject* object = findObject(name))
  {
    pose = object->pose;
    return true;
  }
  for (std::size_t at = name.rfind('/'); at != std::string::npos && at > 0; at = name.rfind('/', at - 1))
    if (const WorldObject* object = findObject(name.substr(0, at)))
    {
      const auto frame = object->subframes.find(name.substr(at + 1));
      if (frame == object->subframes.end())
        continue;
      pose = object->pose * frame->second;
      return true;
    }
  const auto known = transforms_.find(name);
  if (known == transforms_.end())
    return false;
  pose = known->second;
  return true;
}

std::vector<std::string> PlanningScene::frameNames() const
{
  std::vector<std::string> names{model_->frame};
  for (const auto& [name, pose] : transforms_)
    names.push_back(name);
  for (const auto& [id, object] : world_->objects)
    names.push_back(id);
  for (const LinkModel& link : model_->links)
    if (link.name != model_->frame)
      names.push_back(link.name);
  return names;
}

// ---------------------------------------------------------------- objects

World& PlanningScene::worldToWrite()
{
  {
    std::lock_guard<std::mutex> lock(cache_lock_);
    cache_.clear();  // they hold the world
  }
  if (world_.use_count() > 1)
    world_ = std::make_shared<World>(*world_);
  return *world_;
}

void PlanningScene::addToWorld(const WorldObject& object)
{
  if (!isFinite(object.pose))
    throw InvalidInput("object '" + object.id + "': its pose is not finite");
  auto ready = std::make_shared<World::Object>();
  ready->object = object;
  for (std::size_t i = 0; i < object.shapes.size(); ++i)
  {
    World::Part part;
    part.shape = collisionShape(object.shapes[i], 1.0, 0.0);
    part.pose = object.pose * object.shape_poses[i];
    if (!isFinite(part.pose))
      throw InvalidInput("object '" + object.id + "': the pose of a shape is not finite");
    part.box = boundsOf(*part.shape, part.pose);
    ready->parts.push_back(part);
  }
  worldToWrite().objects[object.id] = ready;
}

void PlanningScene::addObject(const WorldObject& given)
{
  if (given.id.empty())
    throw InvalidInput("a world object needs an id");
  if (given.id == OCTOMAP)
    throw InvalidInput("the id '<octomap>' is reserved for the octomap");
  if (given.shapes.empty())
    throw InvalidInput("object '" + given.id + "' has no shapes");
  if (given.shape_poses.size() > given.shapes.size())
    throw InvalidInput("object '" + given.id + "' has " + std::to_string(given.shape_poses.size()) + " shape poses for " +
                       std::to_string(given.shapes.size()) + " shapes");
  WorldObject object = given;
  object.shape_poses.resize(object.shapes.size(), Transform::Identity());
  addToWorld(object);
}

void PlanningScene::appendShapes(const std::string& id, const std::vector<ShapePtr>& shapes,
                                 const std::vector<Transform>& poses)
{
  WorldObject object = this->object(id);
  object.shapes.insert(object.shapes.end(), shapes.begin(), shapes.end());
  for (std::size_t i = 0; i < shapes.size(); ++i)
    object.shape_poses.push_back(i < poses.size() ? poses[i] : Transform::Identity());
  addToWorld(object);
}

void PlanningScene::moveObject(const std::string& id, const Transform& pose)
{
  WorldObject object = this->object(id);
  object.pose = pose;
  addToWorld(object);
}

void PlanningScene::moveShapes(const std::string& id, const std::vector<Transform>& poses)
{
  WorldObject object = this->object(id);
  if (poses.size() != object.shapes.size())
    throw InvalidInput("object '" + id + "' has " + std::to_string(object.shapes.size()) + " shapes, but " +
                       std::to_string(poses.size()) + " poses were given");
  object.shape_poses = poses;
  addToWorld(object);
}

bool PlanningScene::removeObject(const std::string& id)
{
  if (!world_->objects.count(id))
    return false;
  worldToWrite().objects.erase(id);
  return true;
}

void PlanningScene::forget(const std::string& id)
{
  if (findObject(id) || model_->findLink(id) || state_.attached().count(id))
    return;
  colors.erase(id);
  if (!acm_->knows(id))
    return;
  AllowedCollisionMatrix without = *acm_;
  without.remove(id);
  setAcm(without);
}

void PlanningScene::clearObjects()
{
  World& world = worldToWrite();
  for (auto it = world.objects.begin(); it != world.objects.end();)
    it = it->first == OCTOMAP ? std::next(it) : world.objects.erase(it);
}

std::vector<std::string> PlanningScene::objectNames() const
{
  std::vector<std::string> names;
  for (const auto& [id, object] : world_->objects)
    if (id != OCTOMAP)
      names.push_back(id);
  return names;
}

const WorldObject* PlanningScene::findObject(const std::string& id) const
{
  const auto found = world_->objects.find(id);
  return found == world_->objects.end() ? nullptr : &found->second->object;
}

const WorldObject& PlanningScene::object(const std::string& id) const
{
  if (const WorldObject* found = findObject(id))
    return *found;
  throwUnknown("object", id, "the planning scene", objectNames());
}

void PlanningScene::setOctomap(std::shared_ptr<const OcTreeShape> tree, const Transform& pose)
{
  if (!tree || tree->nodes() == 0)
  {
    removeObject(OCTOMAP);
    return;
  }
  WorldObject object;
  object.id = OCTOMAP;
  object.pose = pose;
  object.shapes = {std::move(tree)};
  object.shape_poses = {Transform::Identity()};
  addToWorld(object);
}

void PlanningScene::attach(AttachedBodyPtr body) { state_.attach(std::move(body)); }

void PlanningScene::attachObject(const std::string& id, const std::string& link, const std::set<std::string>& touch_links)
{
  const WorldObject& object = this->object(id);
  const int index = model_->link(link).index;
  auto body = std::make_shared<AttachedBody>();
  body->id = id;
  body->type = object.type;
  body->link = link;
  body->pose = state_.linkPose(index).inverse() * object.pose;
  body->shapes = object.shapes;
  body->shape_poses = object.shape_poses;
  body->subframes = object.subframes;
  body->touch_links = touch_links;
  state_.attach(body);
  removeObject(id);
}

bool PlanningScene::detachObject(const std::string& id)
{
  const AttachedBodyPtr body = state_.detach(id);
  if (!body)
    return false;
  WorldObject object;
  object.id = id;
  object.type = body->type;
  object.pose = state_.linkPose(model_->link(body->link).index) * body->pose;
  object.shapes = body->shapes;
  object.shape_poses = body->shape_poses;
  object.subframes = body->subframes;
  addToWorld(object);
  return true;
}

// ---------------------------------------------------------------- collision

void PlanningScene::setAcm(const AllowedCollisionMatrix& acm) { acm_ = std::make_shared<AllowedCollisionMatrix>(acm); }

void PlanningScene::setPadding(const std::map<std::string, double>& by_link)
{
  const auto before = padding_;
  for (const auto& [link, value] : by_link)
    padding_[model_->link(link).name] = value;
  try
  {
    rebuildRobotGeometry();
  }
  catch (const InvalidInput&)
  {
    padding_ = before;
    throw;
  }
}

void PlanningScene::setScale(const std::map<std::string, double>& by_link)
{
  const auto before = scale_;
  for (const auto& [link, value] : by_link)
    scale_[model_->link(link).name] = value;
  try
  {
    rebuildRobotGeometry();
  }
  catch (const InvalidInput&)
  {
    scale_ = before;
    throw;
  }
}

void PlanningScene::rebuildRobotGeometry()
{
  auto geometry = std::make_shared<RobotGeometry>();
  for (const LinkModel& link : model_->links)
  {
    const auto padding = padding_.find(link.name), scale = scale_.find(link.name);
    geometry->padding.push_back(padding == padding_.end() ? 0.0 : padding->second);
    geometry->scale.push_back(scale == scale_.end() ? 1.0 : scale->second);
    for (std::size_t i = 0; i < link.shapes.size(); ++i)
    {
      RobotGeometry::Part part{link.index, link.shape_origins[i], collisionShape(link.shapes[i], 1.0, 0.0), nullptr};
      part.padded = collisionShape(link.shapes[i], geometry->scale.back(), geometry->padding.back());
      geometry->parts.push_back(part);
    }
  }
  robot_ = geometry;
}

std::shared_ptr<const CollisionChecker> PlanningScene::checker(const RobotState& state, const std::string& group, bool padded,
                                                               const AllowedCollisionMatrix* acm) const
{
  CollisionChecker::Inputs inputs{model_, world_, acm_, robot_, state.attachedShared(), group, padded};
  if (acm)
  {
    inputs.acm = std::make_shared<AllowedCollisionMatrix>(*acm);
    return std::make_shared<CollisionChecker>(std::move(inputs));
  }
  {
    std::lock_guard<std::mutex> lock(cache_lock_);
    for (const auto& known : cache_)
      if (known->inputs() == inputs)
        return known;
  }
  auto made = std::make_shared<const CollisionChecker>(std::move(inputs));
  std::lock_guard<std::mutex> lock(cache_lock_);
  // Those of an older world or robot are never asked for again.
  for (auto it = cache_.begin(); it != cache_.end();)
  {
    const auto& old = (*it)->inputs();
    it = old.world != world_ || old.acm != acm_ || old.robot != robot_ ? cache_.erase(it) : std::next(it);
  }
  if (cache_.size() >= 8)
    cache_.erase(cache_.begin());
  cache_.push_back(made);
  return made;
}

bool CollisionFree::operator()(const RobotState& state) const { return !checker_->collides(state); }

CollisionResult PlanningScene::check(const RobotState& state, const CollisionRequest& request,
                                     const AllowedCollisionMatrix* acm) const
{
  return checker(state, request.group, request.padded, acm)->check(state, request);
}

DistanceResult PlanningScene::distance(const RobotState& state, const std::string& group, double max_distance) const
{
  return checker(state, group)->distance(state, max_distance);
}
}  // namespace motion
