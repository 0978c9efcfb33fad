// Scenes: objects and messages.
#include <geometric_shapes/shapes.h>
#include <moveit/planning_scene/planning_scene.h>
#include <tf2_eigen/tf2_eigen.h>

#include <moveit/robot_state/conversions.h>
#include <moveit/utils/message_checks.h>

#include "log_names.hpp"
#include "motion/planning_scene.hpp"
#include "object_messages.hpp"

namespace planning_scene
{
using collision_detection::World;
using moveit_msgs::CollisionObject;
using Components = moveit_msgs::PlanningSceneComponents;

namespace
{
bool isReserved(const std::string& id)
{
  if (id != PlanningScene::OCTOMAP_NS)
    return false;
  ROS_ERROR_NAMED(log_names::PLANNING_SCENE, "The ID '%s' cannot be used for collision objects (name reserved)", id.c_str());
  return true;
}

// What was carried is put down where it is.
void putDown(const moveit::core::AttachedBody& body, World& world)
{
  const std::string& name = body.getName();
  if (world.hasObject(name))
  {
    ROS_WARN_NAMED(log_names::PLANNING_SCENE,
                   "The collision world already has an object with the same name as the body about to be detached: '%s'",
                   name.c_str());
    return;
  }
  world.addToObject(name, body.getGlobalPose(), body.getShapes(), body.getShapePoses());
  world.setSubframesOfObject(name, body.getSubframes());
}

// The bodies that a message detaches; false, with a line, where it names what is not there.
bool bodiesToDetach(const moveit_msgs::AttachedCollisionObject& object, const moveit::core::RobotState& state,
                    std::vector<const moveit::core::AttachedBody*>& bodies)
{
  const std::string &id = object.object.id, &link = object.link_name;
  if (!link.empty() && !state.getRobotModel()->hasLinkModel(link))
  {
    ROS_ERROR_NAMED(log_names::PLANNING_SCENE, "The robot has no link '%s' to detach '%s' from", link.c_str(), id.c_str());
    return false;
  }
  if (id.empty() && link.empty())
    state.getAttachedBodies(bodies);
  else if (id.empty())
    state.getAttachedBodies(bodies, state.getRobotModel()->getLinkModel(link));
  if (id.empty())
    return true;
  if (!state.hasAttachedBody(id))
  {
    ROS_WARN_NAMED(log_names::PLANNING_SCENE, "Cannot remove attached body '%s': there is none", id.c_str());
    return false;
  }
  bodies.push_back(state.getAttachedBody(id));
  const std::string& held_by = bodies[0]->getAttachedLinkName();
  if (link.empty() || link == held_by)
    return true;
  ROS_ERROR_NAMED(log_names::PLANNING_SCENE, "'%s' is attached to link '%s', not to '%s'", id.c_str(), held_by.c_str(),
                  link.c_str());
  return false;
}

// The shapes, subframes and touch links that a body had before, added to what it has now.
void addTo(moveit::core::RobotState& state, const moveit::core::AttachedBody& before)
{
  const moveit::core::AttachedBody& now = *state.getAttachedBody(before.getName());
  const Eigen::Isometry3d moved = now.getGlobalPose().inverse() * before.getGlobalPose();
  auto shapes = now.getShapes();
  auto poses = now.getShapePoses();
  auto subframes = now.getSubframes();
  auto touch_links = now.getTouchLinks();
  shapes.insert(shapes.end(), before.getShapes().begin(), before.getShapes().end());
  for (const Eigen::Isometry3d& pose : before.getShapePoses())
    poses.push_back(moved * pose);
  for (const auto& [name, pose] : before.getSubframes())
    subframes.emplace(name, moved * pose);
  touch_links.insert(before.getTouchLinks().begin(), before.getTouchLinks().end());
  const auto& posture = now.getDetachPosture().joint_names.empty() ? before.getDetachPosture() : now.getDetachPosture();
  state.attachBody(now.getName(), Eigen::Isometry3d(now.getPose()), shapes, poses, touch_links, now.getAttachedLinkName(),
                   trajectory_msgs::JointTrajectory(posture), subframes);
}
}  // namespace

// ---------------------------------------------------------------- objects

bool PlanningScene::shapesAndPosesFromCollisionObjectMessage(const CollisionObject& object,
                                                             Eigen::Isometry3d& object_pose_in_header_frame,
                                                             std::vector<shapes::ShapeConstPtr>& shapes,
                                                             EigenSTL::vector_Isometry3d& shape_poses)
{
  moveit::core::ObjectParts parts;
  if (!moveit::core::readObject(object, parts))
    return false;
  object_pose_in_header_frame = parts.pose;
  shapes = parts.shapes;
  shape_poses = parts.shape_poses;
  return true;
}

bool PlanningScene::processCollisionObjectMsg(const CollisionObject& object)
{
  if (isReserved(object.id))
    return false;
  switch (object.operation)
  {
    case CollisionObject::ADD:
    case CollisionObject::APPEND:
      return addObject(object);
    case CollisionObject::MOVE:
      return moveObject(object);
    case CollisionObject::REMOVE:
      if (object.id.empty())
      {
        removeAllCollisionObjects();
        return true;
      }
      if (world_->removeObject(object.id))
      {
        forget(object.id);
        return true;
      }
      ROS_WARN_NAMED(log_names::PLANNING_SCENE, "Tried to remove world object '%s', but it does not exist in this scene.",
                     object.id.c_str());
      return false;
    default:
      ROS_ERROR_NAMED(log_names::PLANNING_SCENE, "Unknown collision object operation: %d", object.operation);
      return false;
  }
}

bool PlanningScene::addObject(const CollisionObject& object)
{
  if (!knowsFrameTransform(object.header.frame_id))
  {
    ROS_ERROR_NAMED(log_names::PLANNING_SCENE, "Unknown frame: %s", object.header.frame_id.c_str());
    return false;
  }
  moveit::core::ObjectParts parts;
  if (object.id.empty() || (object.primitives.empty() && object.meshes.empty() && object.planes.empty()) ||
      !moveit::core::readObject(object, parts) || parts.shapes.empty())
  {
    ROS_ERROR_NAMED(log_names::PLANNING_SCENE, "There are no shapes specified in the collision object message of '%s'",
                    object.id.c_str());
    return false;
  }
  if (object.operation == CollisionObject::ADD)
    world_->removeObject(object.id);
  world_->addToObject(object.id, getFrameTransform(object.header.frame_id) * parts.pose, parts.shapes, parts.shape_poses);
  if (!parts.subframes.empty())
    world_->setSubframesOfObject(object.id, parts.subframes);
  if (!object.type.key.empty() || !object.type.db.empty())
    setObjectType(object.id, object.type);
  return true;
}

bool PlanningScene::moveObject(const CollisionObject& object)
{
  const World::ObjectConstPtr known = world_->getObject(object.id);
  if (!known || !knowsFrameTransform(object.header.frame_id))
  {
    ROS_ERROR_NAMED(log_names::PLANNING_SCENE, "World object '%s' does not exist, or the frame '%s' does not. Cannot move.",
                    object.id.c_str(), object.header.frame_id.c_str());
    return false;
  }
  if (!object.primitives.empty() || !object.meshes.empty() || !object.planes.empty())
    ROS_WARN_NAMED(log_names::PLANNING_SCENE, "Move operation for object '%s' ignores the geometry specified in the message.",
                   object.id.c_str());
  EigenSTL::vector_Isometry3d poses;
  for (const auto* list : { &object.primitive_poses, &object.mesh_poses, &object.plane_poses })
    for (const geometry_msgs::Pose& pose : *list)
      poses.push_back(moveit::core::poseFromMessage(pose));
  Eigen::Isometry3d pose = moveit::core::poseFromMessage(object.pose);
  if (poses.size() == 1 && known->shapes_.size() == 1 && moveit::core::isEmpty(object.pose))
    std::swap(pose, poses[0]);
  if (!poses.empty() && !world_->moveShapesInObject(object.id, poses))
  {
    ROS_ERROR_NAMED(log_names::PLANNING_SCENE,
                    "Number of supplied poses (%zu) for object '%s' does not match number of shapes (%zu). Not moving.",
                    poses.size(), object.id.c_str(), known->shapes_.size());
    return false;
  }
  return world_->setObjectPose(object.id, getFrameTransform(object.header.frame_id) * pose);
}

void PlanningScene::setCurrentState(const moveit_msgs::RobotState& state)
{
  // Bodies of a message that is no difference are all there are.
  std::vector<const moveit::core::AttachedBody*> held;
  robot_state_->getAttachedBodies(held);
  std::vector<std::string> names;
  for (const moveit::core::AttachedBody* body : held)
    names.push_back(body->getName());
  moveit::core::robotStateMsgToRobotState(*transforms_, state, *robot_state_);
  for (const std::string& name : names)
    if (!world_->hasObject(name))
      forget(name);
}

bool PlanningScene::processAttachedCollisionObjectMsg(const moveit_msgs::AttachedCollisionObject& object)
{
  const std::string& id = object.object.id;
  if (object.object.operation == CollisionObject::REMOVE)
  {
    std::vector<const moveit::core::AttachedBody*> bodies;
    if (!bodiesToDetach(object, *robot_state_, bodies))
      return false;
    for (const moveit::core::AttachedBody* body : bodies)
    {
      const std::string name = body->getName();
      putDown(*body, *world_);
      robot_state_->clearAttachedBody(name);
    }
    return true;
  }
  if (isReserved(id))
    return false;
  moveit_msgs::AttachedCollisionObject whole = object;
  if (!robot_model_->hasLinkModel(object.link_name))
  {
    ROS_ERROR_NAMED(log_names::PLANNING_SCENE,
                    "Robot state is not compatible with robot model: there is no link '%s' to attach '%s' to.",
                    object.link_name.c_str(), id.c_str());
    return false;
  }
  const World::ObjectConstPtr from_world = world_->getObject(id);
  if (whole.object.primitives.empty() && whole.object.meshes.empty() && whole.object.planes.empty())
  {
    if (!from_world)
    {
      ROS_ERROR_NAMED(log_names::PLANNING_SCENE,
                      "Attempting to attach object '%s' to link '%s' but no geometry specified and such an object does "
                      "not exist in the collision world",
                      id.c_str(), object.link_name.c_str());
      return false;
    }
    moveit::core::writeObject(moveit::core::partsOf(*from_world), whole.object);
    whole.object.header.frame_id = getPlanningFrame();
  }
  whole.object.operation = CollisionObject::ADD;
  if (whole.touch_links.empty())
    whole.touch_links.push_back(object.link_name);
  const bool more = object.object.operation == CollisionObject::APPEND && robot_state_->hasAttachedBody(id);
  const moveit::core::RobotState before(*robot_state_);
  moveit_msgs::RobotState change;
  change.is_diff = true;
  change.attached_collision_objects.push_back(whole);
  moveit::core::robotStateMsgToRobotState(*transforms_, change, *robot_state_);
  if (!robot_state_->hasAttachedBody(id))
    return false;
  if (more)
    addTo(*robot_state_, *before.getAttachedBody(id));
  if (from_world)
    world_->removeObject(id);
  return true;
}

bool PlanningScene::processPlanningSceneWorldMsg(const moveit_msgs::PlanningSceneWorld& world)
{
  bool good = true;
  for (const CollisionObject& object : world.collision_objects)
    good = processCollisionObjectMsg(object) && good;
  processOctomapMsg(world.octomap);
  return good;
}

void PlanningScene::removeAllCollisionObjects()
{
  for (const std::string& id : world_->getObjectIds())
  {
    if (id == OCTOMAP_NS)
      continue;
    world_->removeObject(id);
    forget(id);
  }
}

// What was said of an object that is no more; links and attached bodies keep theirs.
void PlanningScene::forget(const std::string& id)
{
  if (robot_model_->hasLinkModel(id) || robot_state_->hasAttachedBody(id))
    return;
  removeObjectColor(id);
  removeObjectType(id);
  acm_.removeEntry(id);
}

void PlanningScene::processOctomapMsg(const octomap_msgs::Octomap& map)
{
  octomap_msgs::OctomapWithPose placed;
  placed.header = map.header;
  placed.octomap = map;
  placed.origin.orientation.w = 1.0;
  processOctomapMsg(placed);
}

// Each map replaces the one before; one without data takes it away.
void PlanningScene::processOctomapMsg(const octomap_msgs::OctomapWithPose& map)
{
  world_->removeObject(OCTOMAP_NS);
  if (map.octomap.data.empty())
    return;
  try
  {
    const auto shape = motion::OcTreeShape::fromMessage(std::string(map.octomap.data.begin(), map.octomap.data.end()),
                                                        map.octomap.resolution, map.octomap.binary, map.octomap.id);
    const std::string& frame = map.header.frame_id.empty() ? getPlanningFrame() : map.header.frame_id;
    processOctomapPtr(shape->tree, getFrameTransform(frame) * moveit::core::poseFromMessage(map.origin));
  }
  catch (const motion::Error& error)
  {
    ROS_ERROR_NAMED(log_names::PLANNING_SCENE, "the octomap is left out: %s", error.what());
  }
}

void PlanningScene::processOctomapPtr(const std::shared_ptr<const octomap::OcTree>& octree, const Eigen::Isometry3d& t)
{
  world_->removeObject(OCTOMAP_NS);
  if (octree)
    world_->addToObject(OCTOMAP_NS, t, std::make_shared<shapes::OcTree>(octree), Eigen::Isometry3d::Identity());
}

void PlanningScene::setAttachedBodyUpdateCallback(const moveit::core::AttachedBodyCallback& callback)
{
  robot_state_->setAttachedBodyUpdateCallback(callback);
}

void PlanningScene::setCollisionObjectUpdateCallback(const World::ObserverCallbackFn& callback)
{
  if (observed_)
    world_->removeObserver(observer_);
  observed_ = static_cast<bool>(callback);
  if (observed_)
    observer_ = world_->addObserver(callback);
}

const std_msgs::ColorRGBA& PlanningScene::getObjectColor(const std::string& id) const
{
  static const std_msgs::ColorRGBA none;
  const auto found = colors_.find(id);
  return found == colors_.end() ? none : found->second;
}

const object_recognition_msgs::ObjectType& PlanningScene::getObjectType(const std::string& id) const
{
  static const object_recognition_msgs::ObjectType none;
  const auto found = types_.find(id);
  return found == types_.end() ? none : found->second;
}

void PlanningScene::printKnownObjects(std::ostream& out) const
{
  out << "Collision World Objects:\n";
  for (const std::string& id : world_->getObjectIds())
    out << "\t- " << id << '\n';
  out << "Attached Bodies:\n";
  std::vector<const moveit::core::AttachedBody*> bodies;
  robot_state_->getAttachedBodies(bodies);
  for (const moveit::core::AttachedBody* body : bodies)
    out << "\t- " << body->getName() << '\n';
}

// ---------------------------------------------------------------- from messages

bool PlanningScene::usePlanningSceneMsg(const moveit_msgs::PlanningScene& scene)
{
  return scene.is_diff ? setPlanningSceneDiffMsg(scene) : setPlanningSceneMsg(scene);
}

bool PlanningScene::setPlanningSceneMsg(const moveit_msgs::PlanningScene& scene)
{
  if (!scene.robot_model_name.empty() && scene.robot_model_name != robot_model_->getName())
    ROS_WARN_NAMED(log_names::PLANNING_SCENE, "Setting the scene for model '%s' but model '%s' is loaded.",
                   scene.robot_model_name.c_str(), robot_model_->getName().c_str());
  decoupleParent();
  name_ = scene.name;
  removeAllCollisionObjects();
  world_->removeObject(OCTOMAP_NS);
  colors_.clear();
  types_.clear();
  moveit_msgs::PlanningScene difference = scene;
  acm_ = collision_detection::AllowedCollisionMatrix(scene.allowed_collision_matrix);
  difference.allowed_collision_matrix = moveit_msgs::AllowedCollisionMatrix();
  return setPlanningSceneDiffMsg(difference);
}

bool PlanningScene::setPlanningSceneDiffMsg(const moveit_msgs::PlanningScene& scene)
{
  bool good = true;
  if (!scene.name.empty())
    name_ = scene.name;
  transforms_->setTransforms(scene.fixed_frame_transforms);
  if (!moveit::core::isEmpty(scene.robot_state))
  {
    // Attached objects may be those of the world: they are taken one by one.
    moveit_msgs::RobotState state = scene.robot_state;
    state.attached_collision_objects.clear();
    if (!state.is_diff)
      robot_state_->clearAttachedBodies();
    if (!state.joint_state.name.empty() || !state.multi_dof_joint_state.joint_names.empty())
      moveit::core::robotStateMsgToRobotState(*transforms_, state, *robot_state_, false);
    for (const auto& object : scene.robot_state.attached_collision_objects)
      good = processAttachedCollisionObjectMsg(object) && good;
  }
  if (!scene.allowed_collision_matrix.entry_names.empty())
    acm_ = collision_detection::AllowedCollisionMatrix(scene.allowed_collision_matrix);
  if (!scene.link_padding.empty())
    env_->setPadding(scene.link_padding);
  if (!scene.link_scale.empty())
    env_->setScale(scene.link_scale);
  for (const auto& color : scene.object_colors)
    setObjectColor(color.id, color.color);
  for (const CollisionObject& object : scene.world.collision_objects)
    good = processCollisionObjectMsg(object) && good;
  if (!scene.world.octomap.octomap.id.empty())  // a difference without one says nothing of it
    processOctomapMsg(scene.world.octomap);
  return good;
}
}  // namespace planning_scene
