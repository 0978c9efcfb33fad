#include <moveit/planning_scene_interface/planning_scene_interface.h>

#include <algorithm>

#include <moveit_msgs/ApplyPlanningScene.h>
#include <moveit_msgs/GetPlanningScene.h>
#include <ros/ros.h>
#include <tf2_eigen/tf2_eigen.h>

#include "action_queue.h"

namespace moveit {
namespace planning_interface {
namespace {

const char LOGNAME[] = "planning_scene_interface";
const double SAY_SO_AFTER = 5.0;  // s

using Components = moveit_msgs::PlanningSceneComponents;

void nameColors(const std::vector<moveit_msgs::CollisionObject>& objects, std::vector<moveit_msgs::ObjectColor>& colors) {
  for (std::size_t i = 0; i < colors.size() && i < objects.size() && colors[i].id.empty(); ++i) colors[i].id = objects[i].id;
}

moveit_msgs::PlanningScene diff() {
  moveit_msgs::PlanningScene scene;
  scene.is_diff = true;
  scene.robot_state.is_diff = true;
  return scene;
}

bool isAsked(const std::vector<std::string>& names, const std::string& name) {
  return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

struct PlanningSceneInterface::Impl {
  Impl(const std::string& ns, bool wait, bool persistent) : nh(ns), wait(wait), persistent(persistent) {
    publisher = nh.advertise<moveit_msgs::PlanningScene>("planning_scene", 1);
    if (persistent && !wait) {
      ROS_WARN_NAMED(LOGNAME, "To create persistent service clients, wait is set to true");
      this->wait = true;
    }
    connect<moveit_msgs::GetPlanningScene>(get_service, "get_planning_scene");
    connect<moveit_msgs::ApplyPlanningScene>(apply_service, "apply_planning_scene");
  }

  template <class Service>
  void connect(ros::ServiceClient& client, const std::string& name) {
    client = nh.serviceClient<Service>(name);
    if (wait && !client.waitForExistence(ros::Duration(SAY_SO_AFTER)) && ros::ok()) {
      ROS_WARN_STREAM_NAMED(LOGNAME, "service '" << client.getService() << "' not advertised yet. Continue waiting...");
      client.waitForExistence();
    }
    if (!wait && !client.exists()) throw std::runtime_error("ROS service not available");
    if (persistent) client = nh.serviceClient<Service>(name, true);
  }

  // A persistent connection is gone when move_group was started again.
  template <class Service>
  bool call(ros::ServiceClient& client, const std::string& name, Service& service) {
    if (!client.isValid()) connect<Service>(client, name);
    return client.call(service);
  }

  /// An empty scene when the service does not answer.
  moveit_msgs::PlanningScene get(uint32_t components) {
    moveit_msgs::GetPlanningScene service;
    service.request.components.components = components;
    if (!call(get_service, "get_planning_scene", service)) {
      ROS_WARN_NAMED(LOGNAME, "Could not call planning scene service");
      return moveit_msgs::PlanningScene();
    }
    return service.response.scene;
  }

  ros::NodeHandle nh;
  bool wait, persistent;
  ros::ServiceClient get_service, apply_service;
  ros::Publisher publisher;
};

PlanningSceneInterface::PlanningSceneInterface(const std::string& ns, bool wait, bool persistent_connections)
    : impl_(std::make_shared<Impl>(ns, wait, persistent_connections)) {}

PlanningSceneInterface::~PlanningSceneInterface() = default;

std::vector<std::string> PlanningSceneInterface::getKnownObjectNames(bool with_type) {
  std::vector<std::string> names;
  for (const moveit_msgs::CollisionObject& object : impl_->get(Components::WORLD_OBJECT_NAMES).world.collision_objects)
    if (!with_type || !object.type.key.empty()) names.push_back(object.id);
  return names;
}

std::vector<std::string> PlanningSceneInterface::getKnownObjectNamesInROI(double minx, double miny, double minz, double maxx,
                                                                          double maxy, double maxz, bool with_type,
                                                                          std::vector<std::string>& types) {
  const Eigen::AlignedBox3d box(Eigen::Vector3d(minx, miny, minz), Eigen::Vector3d(maxx, maxy, maxz));
  std::vector<std::string> names;
  for (const moveit_msgs::CollisionObject& object : impl_->get(Components::WORLD_OBJECT_GEOMETRY).world.collision_objects) {
    std::vector<geometry_msgs::Pose> poses = object.mesh_poses;
    poses.insert(poses.end(), object.primitive_poses.begin(), object.primitive_poses.end());
    if (poses.empty() || (with_type && object.type.key.empty())) continue;
    Eigen::Isometry3d X_WO;
    tf2::fromMsg(object.pose, X_WO);
    const bool inside = std::all_of(poses.begin(), poses.end(), [&](const geometry_msgs::Pose& pose) {
      return box.contains(X_WO * Eigen::Vector3d(pose.position.x, pose.position.y, pose.position.z));
    });
    if (!inside) continue;
    names.push_back(object.id);
    if (with_type) types.push_back(object.type.key);
  }
  return names;
}

std::map<std::string, geometry_msgs::Pose> PlanningSceneInterface::getObjectPoses(const std::vector<std::string>& object_ids) {
  std::map<std::string, geometry_msgs::Pose> poses;
  if (!object_ids.empty())
    for (const auto& [name, object] : getObjects(object_ids)) poses[name] = object.pose;
  return poses;
}

std::map<std::string, moveit_msgs::CollisionObject> PlanningSceneInterface::getObjects(
    const std::vector<std::string>& object_ids) {
  std::map<std::string, moveit_msgs::CollisionObject> objects;
  for (const moveit_msgs::CollisionObject& object : impl_->get(Components::WORLD_OBJECT_GEOMETRY).world.collision_objects)
    if (isAsked(object_ids, object.id)) objects[object.id] = object;
  return objects;
}

std::map<std::string, moveit_msgs::AttachedCollisionObject> PlanningSceneInterface::getAttachedObjects(
    const std::vector<std::string>& object_ids) {
  std::map<std::string, moveit_msgs::AttachedCollisionObject> objects;
  for (const moveit_msgs::AttachedCollisionObject& attached :
       impl_->get(Components::ROBOT_STATE_ATTACHED_OBJECTS).robot_state.attached_collision_objects)
    if (isAsked(object_ids, attached.object.id)) objects[attached.object.id] = attached;
  return objects;
}

bool PlanningSceneInterface::applyCollisionObject(const moveit_msgs::CollisionObject& collision_object) {
  return applyCollisionObjects({collision_object});
}

bool PlanningSceneInterface::applyCollisionObject(const moveit_msgs::CollisionObject& collision_object,
                                                  const std_msgs::ColorRGBA& object_color) {
  moveit_msgs::ObjectColor color;
  color.id = collision_object.id;
  color.color = object_color;
  return applyCollisionObjects({collision_object}, {color});
}

bool PlanningSceneInterface::applyCollisionObjects(const std::vector<moveit_msgs::CollisionObject>& collision_objects,
                                                   const std::vector<moveit_msgs::ObjectColor>& object_colors) {
  moveit_msgs::PlanningScene scene = diff();
  scene.world.collision_objects = collision_objects;
  scene.object_colors = object_colors;
  nameColors(collision_objects, scene.object_colors);
  return applyPlanningScene(scene);
}

bool PlanningSceneInterface::applyAttachedCollisionObject(const moveit_msgs::AttachedCollisionObject& attached) {
  return applyAttachedCollisionObjects({attached});
}

bool PlanningSceneInterface::applyAttachedCollisionObjects(const std::vector<moveit_msgs::AttachedCollisionObject>& attached) {
  moveit_msgs::PlanningScene scene = diff();
  scene.robot_state.attached_collision_objects = attached;
  return applyPlanningScene(scene);
}

moveit_msgs::PlanningScene PlanningSceneInterface::getPlanningSceneMsg(uint32_t components) { return impl_->get(components); }

bool PlanningSceneInterface::applyPlanningScene(const moveit_msgs::PlanningScene& ps) {
  moveit_msgs::ApplyPlanningScene service;
  service.request.scene = ps;
  if (impl_->call(impl_->apply_service, "apply_planning_scene", service)) return service.response.success;
  ROS_WARN_NAMED(LOGNAME, "Failed to call ApplyPlanningScene service");
  return false;
}

void PlanningSceneInterface::addCollisionObjects(const std::vector<moveit_msgs::CollisionObject>& collision_objects,
                                                 const std::vector<moveit_msgs::ObjectColor>& object_colors) const {
  moveit_msgs::PlanningScene scene = diff();
  scene.world.collision_objects = collision_objects;
  scene.object_colors = object_colors;
  nameColors(collision_objects, scene.object_colors);
  waitForSubscriber(impl_->publisher);
  impl_->publisher.publish(scene);
}

void PlanningSceneInterface::removeCollisionObjects(const std::vector<std::string>& object_ids) const {
  moveit_msgs::PlanningScene scene = diff();
  for (const std::string& id : object_ids) {
    scene.world.collision_objects.emplace_back();
    scene.world.collision_objects.back().id = id;
    scene.world.collision_objects.back().operation = moveit_msgs::CollisionObject::REMOVE;
  }
  waitForSubscriber(impl_->publisher);
  impl_->publisher.publish(scene);
}

bool PlanningSceneInterface::clear() {
  moveit_msgs::PlanningScene scene = diff();
  scene.robot_state.attached_collision_objects.resize(1);
  scene.robot_state.attached_collision_objects[0].object.operation = moveit_msgs::CollisionObject::REMOVE;
  scene.world.collision_objects.resize(1);
  scene.world.collision_objects[0].operation = moveit_msgs::CollisionObject::REMOVE;
  return applyPlanningScene(scene);
}

}  // namespace planning_interface
}  // namespace moveit
