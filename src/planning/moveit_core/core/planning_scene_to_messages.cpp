// Scenes: into messages.
#include <geometric_shapes/shapes.h>
#include <moveit/planning_scene/scene_difference.h>
#include <tf2_eigen/tf2_eigen.h>

#include <moveit/robot_state/conversions.h>

#include "motion/planning_scene.hpp"
#include "object_messages.hpp"

namespace planning_scene
{
using collision_detection::World;
using moveit_msgs::CollisionObject;
using Components = moveit_msgs::PlanningSceneComponents;

bool PlanningScene::getCollisionObjectMsg(CollisionObject& collision_obj, const std::string& ns) const
{
  const World::ObjectConstPtr object = world_->getObject(ns);
  if (!object)
    return false;
  collision_obj = CollisionObject();
  collision_obj.id = ns;
  collision_obj.header.frame_id = getPlanningFrame();
  collision_obj.operation = CollisionObject::ADD;
  moveit::core::writeObject(moveit::core::partsOf(*object), collision_obj);
  if (hasObjectType(ns))
    collision_obj.type = getObjectType(ns);
  return true;
}

void PlanningScene::getCollisionObjectMsgs(std::vector<CollisionObject>& collision_objs) const
{
  collision_objs.clear();
  for (const std::string& id : world_->getObjectIds())
    if (id != OCTOMAP_NS)
    {
      collision_objs.emplace_back();
      getCollisionObjectMsg(collision_objs.back(), id);
    }
}

bool PlanningScene::getAttachedCollisionObjectMsg(moveit_msgs::AttachedCollisionObject& attached_collision_obj,
                                                  const std::string& ns) const
{
  std::vector<moveit_msgs::AttachedCollisionObject> all;
  getAttachedCollisionObjectMsgs(all);
  for (const auto& object : all)
    if (object.object.id == ns)
    {
      attached_collision_obj = object;
      return true;
    }
  return false;
}

void PlanningScene::getAttachedCollisionObjectMsgs(
    std::vector<moveit_msgs::AttachedCollisionObject>& attached_collision_objs) const
{
  std::vector<const moveit::core::AttachedBody*> bodies;
  robot_state_->getAttachedBodies(bodies);
  moveit::core::attachedBodiesToAttachedCollisionObjectMsgs(bodies, attached_collision_objs);
}

bool PlanningScene::getOctomapMsg(octomap_msgs::OctomapWithPose& octomap) const
{
  octomap.header.frame_id = getPlanningFrame();
  octomap.octomap = octomap_msgs::Octomap();
  const World::ObjectConstPtr object = world_->getObject(OCTOMAP_NS);
  if (!object || object->shapes_.size() != 1 || object->shapes_[0]->type != shapes::OCTREE)
    return false;
  const motion::OcTreeShape tree(static_cast<const shapes::OcTree&>(*object->shapes_[0]).octree);
  const std::string data = tree.message(false);
  octomap.octomap.header = octomap.header;
  octomap.octomap.id = "OcTree";
  octomap.octomap.binary = false;
  octomap.octomap.resolution = tree.resolution();
  octomap.octomap.data.assign(data.begin(), data.end());
  octomap.origin = tf2::toMsg(Eigen::Isometry3d(object->pose_ * object->shape_poses_[0]));
  return true;
}

void PlanningScene::getObjectColorMsgs(std::vector<moveit_msgs::ObjectColor>& object_colors) const
{
  object_colors.clear();
  for (const auto& color : colors_)
  {
    object_colors.emplace_back();
    object_colors.back().id = color.first;
    object_colors.back().color = color.second;
  }
}

void PlanningScene::getPlanningSceneMsg(moveit_msgs::PlanningScene& scene) const
{
  scene = moveit_msgs::PlanningScene();
  scene.name = name_;
  scene.is_diff = false;
  scene.robot_model_name = robot_model_->getName();
  transforms_->copyTransforms(scene.fixed_frame_transforms);
  moveit::core::robotStateToRobotStateMsg(*robot_state_, scene.robot_state);
  acm_.getMessage(scene.allowed_collision_matrix);
  env_->getPadding(scene.link_padding);
  env_->getScale(scene.link_scale);
  getObjectColorMsgs(scene.object_colors);
  getCollisionObjectMsgs(scene.world.collision_objects);
  getOctomapMsg(scene.world.octomap);
}

void PlanningScene::getPlanningSceneMsg(moveit_msgs::PlanningScene& scene, const Components& comp) const
{
  moveit_msgs::PlanningScene all;
  getPlanningSceneMsg(all);
  const auto wanted = [&comp](std::uint32_t part) { return (comp.components & part) != 0; };
  scene = moveit_msgs::PlanningScene();
  scene.is_diff = false;
  if (wanted(Components::SCENE_SETTINGS))
  {
    scene.name = all.name;
    scene.robot_model_name = all.robot_model_name;
  }
  if (wanted(Components::TRANSFORMS))
    scene.fixed_frame_transforms = all.fixed_frame_transforms;
  if (wanted(Components::ROBOT_STATE | Components::ROBOT_STATE_ATTACHED_OBJECTS))
  {
    scene.robot_state = all.robot_state;
    if (!wanted(Components::ROBOT_STATE_ATTACHED_OBJECTS))
      scene.robot_state.attached_collision_objects.clear();
  }
  if (wanted(Components::ALLOWED_COLLISION_MATRIX))
    scene.allowed_collision_matrix = all.allowed_collision_matrix;
  if (wanted(Components::LINK_PADDING_AND_SCALING))
  {
    scene.link_padding = all.link_padding;
    scene.link_scale = all.link_scale;
  }
  if (wanted(Components::OBJECT_COLORS))
    scene.object_colors = all.object_colors;
  if (wanted(Components::WORLD_OBJECT_GEOMETRY))
    scene.world.collision_objects = all.world.collision_objects;
  else if (wanted(Components::WORLD_OBJECT_NAMES))
    for (const CollisionObject& object : all.world.collision_objects)
    {
      scene.world.collision_objects.emplace_back();
      scene.world.collision_objects.back().id = object.id;
      scene.world.collision_objects.back().type = object.type;
    }
  if (wanted(Components::OCTOMAP))
    scene.world.octomap = all.world.octomap;
}

// The state, frames and name as they are, of the rest what differs from the parent.
void PlanningScene::getPlanningSceneDiffMsg(moveit_msgs::PlanningScene& scene) const
{
  if (parent_)
  {
    scene = difference(*parent_, *this);
    const auto attached = scene.robot_state.attached_collision_objects;
    moveit::core::robotStateToRobotStateMsg(*robot_state_, scene.robot_state);
    scene.robot_state.attached_collision_objects = attached;
    scene.name = name_;
    scene.robot_model_name = robot_model_->getName();
    transforms_->copyTransforms(scene.fixed_frame_transforms);
  }
  else
    getPlanningSceneMsg(scene);
  scene.is_diff = scene.robot_state.is_diff = true;
}
}  // namespace planning_scene
