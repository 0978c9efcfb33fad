// Collision objects, in the planning scene of the monitor or of move_group.
#include <moveit_visual_tools/moveit_visual_tools.h>

#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>

#include <geometric_shapes/shape_operations.h>
#include <geometric_shapes/shapes.h>
#include <moveit/planning_scene/scene_text.h>

#include "log_name.hpp"

namespace moveit_visual_tools {
namespace {

using moveit_msgs::CollisionObject;
using rviz_visual_tools::colors;
using shape_msgs::SolidPrimitive;

double visible(double length) { return length > 0 ? length : rviz_visual_tools::SMALL_SCALE; }

geometry_msgs::Pose standing(double x, double y, double z, double angle) {
  return rviz_visual_tools::RvizVisualTools::convertPose(
      Eigen::Isometry3d(Eigen::Translation3d(x, y, z) * Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ())));
}

SolidPrimitive primitive(uint8_t type, const std::vector<double>& dimensions) {
  SolidPrimitive result;
  result.type = type;
  result.dimensions.assign(dimensions.begin(), dimensions.end());
  return result;
}

}  // namespace

bool MoveItVisualTools::applyScene(const moveit_msgs::PlanningScene& diff) {
  const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  append(pending_.world.collision_objects, diff.world.collision_objects);
  append(pending_.object_colors, diff.object_colors);
  append(pending_.robot_state.attached_collision_objects, diff.robot_state.attached_collision_objects);
  return mannual_trigger_update_ || triggerPlanningSceneUpdate();
}

bool MoveItVisualTools::triggerPlanningSceneUpdate() {
  pending_.is_diff = pending_.robot_state.is_diff = true;
  if (psm_) {
    const bool applied = psm_->newPlanningSceneMessage(pending_);
    pending_ = moveit_msgs::PlanningScene();
    return applied;
  }
  if (!pub_planning_scene_) {
    pub_planning_scene_ = ros::NodeHandle().advertise<moveit_msgs::PlanningScene>(planning_scene_topic_, 100);
    waitForSubscriber(pub_planning_scene_);
  }
  pub_planning_scene_.publish(pending_);
  pending_ = moveit_msgs::PlanningScene();
  return true;
}

bool MoveItVisualTools::loadPlanningSceneMonitor() {
  if (psm_) {
    ROS_WARN_STREAM_NAMED(LOGNAME, "Will not load a new planning scene monitor when one has already been set for Visual Tools");
    return false;
  }
  const auto monitor = std::make_shared<planning_scene_monitor::PlanningSceneMonitor>(ROBOT_DESCRIPTION);
  if (!monitor->getPlanningScene()) {
    ROS_ERROR_STREAM_NAMED(LOGNAME, "Planning scene not configured");
    return false;
  }
  monitor->startPublishingPlanningScene(planning_scene_monitor::PlanningSceneMonitor::UPDATE_SCENE, planning_scene_topic_);
  psm_ = monitor;
  return true;
}

planning_scene_monitor::PlanningSceneMonitorPtr MoveItVisualTools::getPlanningSceneMonitor() {
  if (!psm_) loadPlanningSceneMonitor();
  return psm_;
}

bool MoveItVisualTools::processCollisionObjectMsg(const CollisionObject& msg, const colors& color) {
  moveit_msgs::PlanningScene diff;
  diff.world.collision_objects.push_back(msg);
  if (msg.operation != CollisionObject::REMOVE) {
    diff.object_colors.resize(1);
    diff.object_colors[0].id = msg.id;
    diff.object_colors[0].color = getColor(color);
  }
  return applyScene(diff);
}

bool MoveItVisualTools::loadCollisionSceneFromFile(const std::string& path) {
  return loadCollisionSceneFromFile(path, Eigen::Isometry3d::Identity());
}
bool MoveItVisualTools::loadCollisionSceneFromFile(const std::string& path, const Eigen::Isometry3d& offset) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  try {
    if (!file) throw std::runtime_error("the file cannot be read");
    moveit_msgs::PlanningScene scene = planning_scene::readScene(text.str(), getRobotModel()->getModelFrame());
    for (CollisionObject& object : scene.world.collision_objects) object.pose = convertPose(offset * convertPose(object.pose));
    return applyScene(scene);
  } catch (const std::runtime_error& error) {
    ROS_WARN_NAMED(LOGNAME, "Unable to load scene geometry from '%s': %s", path.c_str(), error.what());
    return false;
  }
}

bool MoveItVisualTools::processAttachedCollisionObjectMsg(const moveit_msgs::AttachedCollisionObject& msg) {
  moveit_msgs::PlanningScene diff;
  diff.robot_state.attached_collision_objects.push_back(msg);
  return applyScene(diff);
}

CollisionObject MoveItVisualTools::object(const std::string& name, int8_t operation) const {
  CollisionObject result;
  result.header.stamp = ros::Time::now();
  result.header.frame_id = base_frame_;
  result.id = name;
  result.operation = operation;
  return result;
}

bool MoveItVisualTools::addPrimitive(const std::string& name, uint8_t type, const std::vector<double>& dimensions,
                                     const geometry_msgs::Pose& pose, const colors& color) {
  CollisionObject added = object(name, CollisionObject::ADD);
  added.primitives.push_back(primitive(type, dimensions));
  added.primitive_poses.push_back(pose);
  return processCollisionObjectMsg(added, color);
}

bool MoveItVisualTools::moveCollisionObject(const Eigen::Isometry3d& pose, const std::string& name, const colors& color) {
  return moveCollisionObject(convertPose(pose), name, color);
}
bool MoveItVisualTools::moveCollisionObject(const geometry_msgs::Pose& pose, const std::string& name, const colors& color) {
  CollisionObject moved = object(name, CollisionObject::MOVE);
  moved.pose = pose;
  return processCollisionObjectMsg(moved, color);
}

bool MoveItVisualTools::removeAllCollisionObjects() { return processCollisionObjectMsg(object("", CollisionObject::REMOVE)); }
bool MoveItVisualTools::cleanupCO(const std::string& name) {
  return processCollisionObjectMsg(object(name, CollisionObject::REMOVE));
}
bool MoveItVisualTools::cleanupACO(const std::string&) {
  moveit_msgs::AttachedCollisionObject detached;
  detached.object = object("", CollisionObject::REMOVE);
  return processAttachedCollisionObjectMsg(detached);
}
bool MoveItVisualTools::attachCO(const std::string& name, const std::string& ee_parent_link) {
  moveit_msgs::AttachedCollisionObject attached;
  attached.object = object(name, CollisionObject::ADD);
  attached.link_name = ee_parent_link;
  return processAttachedCollisionObjectMsg(attached);
}

bool MoveItVisualTools::publishCollisionFloor(double z, const std::string& plane_name, const colors& color) {
  const double far = rviz_visual_tools::LARGE_SCALE;
  return publishCollisionCuboid(Eigen::Vector3d(far, far, z), Eigen::Vector3d(-far, -far, z - rviz_visual_tools::SMALL_SCALE),
                                plane_name, color);
}
bool MoveItVisualTools::publishCollisionBlock(const geometry_msgs::Pose& block_pose, const std::string& block_name,
                                              double block_size, const colors& color) {
  return publishCollisionCuboid(block_pose, block_size, block_size, block_size, block_name, color);
}
bool MoveItVisualTools::publishCollisionCuboid(const geometry_msgs::Point& point1, const geometry_msgs::Point& point2,
                                               const std::string& name, const colors& color) {
  return publishCollisionCuboid(convertPoint(point1), convertPoint(point2), name, color);
}
bool MoveItVisualTools::publishCollisionCuboid(const Eigen::Vector3d& point1, const Eigen::Vector3d& point2,
                                               const std::string& name, const colors& color) {
  const Eigen::Vector3d size = (point1 - point2).cwiseAbs();
  return publishCollisionCuboid(convertPointToPose(convertPoint(getCenterPoint(point1, point2))), size.x(), size.y(), size.z(),
                                name, color);
}
bool MoveItVisualTools::publishCollisionCuboid(const Eigen::Isometry3d& pose, double width, double depth, double height,
                                               const std::string& name, const colors& color) {
  return publishCollisionCuboid(convertPose(pose), width, depth, height, name, color);
}
bool MoveItVisualTools::publishCollisionCuboid(const geometry_msgs::Pose& pose, double width, double depth, double height,
                                               const std::string& name, const colors& color) {
  return addPrimitive(name, SolidPrimitive::BOX, {visible(width), visible(depth), visible(height)}, pose, color);
}

Eigen::Isometry3d MoveItVisualTools::between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const {
  return getVectorBetweenPoints(getCenterPoint(a, b), b) * Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitY());
}
bool MoveItVisualTools::publishCollisionCylinder(const geometry_msgs::Point& a, const geometry_msgs::Point& b,
                                                 const std::string& object_name, double radius, const colors& color) {
  return publishCollisionCylinder(convertPoint(a), convertPoint(b), object_name, radius, color);
}
bool MoveItVisualTools::publishCollisionCylinder(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                                 const std::string& object_name, double radius, const colors& color) {
  return publishCollisionCylinder(convertPose(between(a, b)), object_name, radius, (a - b).norm(), color);
}
bool MoveItVisualTools::publishCollisionCylinder(const Eigen::Isometry3d& object_pose, const std::string& object_name,
                                                 double radius, double height, const colors& color) {
  return publishCollisionCylinder(convertPose(object_pose), object_name, radius, height, color);
}
bool MoveItVisualTools::publishCollisionCylinder(const geometry_msgs::Pose& object_pose, const std::string& object_name,
                                                 double radius, double height, const colors& color) {
  return addPrimitive(object_name, SolidPrimitive::CYLINDER, {visible(height), visible(radius)}, object_pose, color);
}

bool MoveItVisualTools::publishCollisionMesh(const Eigen::Isometry3d& object_pose, const std::string& object_name,
                                             const std::string& mesh_path, const colors& color) {
  return publishCollisionMesh(convertPose(object_pose), object_name, mesh_path, color);
}
bool MoveItVisualTools::publishCollisionMesh(const geometry_msgs::Pose& object_pose, const std::string& object_name,
                                             const std::string& mesh_path, const colors& color) {
  const std::unique_ptr<shapes::Mesh> mesh(shapes::createMeshFromResource(mesh_path));
  shapes::ShapeMsg message;
  if (!mesh || !shapes::constructMsgFromShape(mesh.get(), message)) {
    ROS_ERROR_STREAM_NAMED(LOGNAME, "Unable to create mesh shape message from resource " << mesh_path);
    return false;
  }
  return publishCollisionMesh(object_pose, object_name, boost::get<shape_msgs::Mesh>(message), color);
}
bool MoveItVisualTools::publishCollisionMesh(const Eigen::Isometry3d& object_pose, const std::string& object_name,
                                             const shape_msgs::Mesh& mesh_msg, const colors& color) {
  return publishCollisionMesh(convertPose(object_pose), object_name, mesh_msg, color);
}
bool MoveItVisualTools::publishCollisionMesh(const geometry_msgs::Pose& object_pose, const std::string& object_name,
                                             const shape_msgs::Mesh& mesh_msg, const colors& color) {
  CollisionObject added = object(object_name, CollisionObject::ADD);
  added.meshes.push_back(mesh_msg);
  added.mesh_poses.push_back(object_pose);
  return processCollisionObjectMsg(added, color);
}

bool MoveItVisualTools::publishCollisionGraph(const graph_msgs::GeometryGraph& graph, const std::string& object_name,
                                              double radius, const colors& color) {
  CollisionObject added = object(object_name, CollisionObject::ADD);
  std::set<std::pair<std::size_t, std::size_t>> drawn;
  for (std::size_t i = 0; i < graph.nodes.size() && i < graph.edges.size(); ++i)
    for (const std::size_t j : graph.edges[i].node_ids) {
      if (j >= graph.nodes.size() || !drawn.insert({std::min(i, j), std::max(i, j)}).second) continue;
      const Eigen::Vector3d a = convertPoint(graph.nodes[i]), b = convertPoint(graph.nodes[j]);
      added.primitives.push_back(primitive(SolidPrimitive::CYLINDER, {visible((a - b).norm()), radius}));
      added.primitive_poses.push_back(convertPose(between(a, b)));
    }
  return processCollisionObjectMsg(added, color);
}

void MoveItVisualTools::getCollisionWallMsg(double x, double y, double z, double angle, double width, double height,
                                            const std::string& name, CollisionObject& collision_obj) {
  collision_obj = object(name, CollisionObject::ADD);
  collision_obj.primitives = {primitive(SolidPrimitive::BOX, {0.1, width, height})};
  collision_obj.primitive_poses = {standing(x, y, z + height / 2, angle)};
}
bool MoveItVisualTools::publishCollisionWall(double x, double y, double angle, double width, double height,
                                             const std::string& name, const colors& color) {
  return publishCollisionWall(x, y, 0.0, angle, width, height, name, color);
}
bool MoveItVisualTools::publishCollisionWall(double x, double y, double z, double angle, double width, double height,
                                             const std::string& name, const colors& color) {
  CollisionObject wall;
  getCollisionWallMsg(x, y, z, angle, width, height, name, wall);
  return processCollisionObjectMsg(wall, color);
}
bool MoveItVisualTools::publishCollisionTable(double x, double y, double z, double angle, double width, double height,
                                              double depth, const std::string& name, const colors& color) {
  return addPrimitive(name, SolidPrimitive::BOX, {depth, width, height}, standing(x, y, z + height / 2, angle), color);
}

bool MoveItVisualTools::publishWorkspaceParameters(const moveit_msgs::WorkspaceParameters& params) {
  return publishCuboid(convertPoint(params.min_corner), convertPoint(params.max_corner), rviz_visual_tools::TRANSLUCENT,
                       "Planning_Workspace", 1);
}

}  // namespace moveit_visual_tools
