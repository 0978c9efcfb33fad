// Objects in move_group's planning scene.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include <moveit/macros/class_forward.h>
#include <moveit/robot_state/robot_state.h>
#include <moveit_msgs/AttachedCollisionObject.h>
#include <moveit_msgs/CollisionObject.h>
#include <moveit_msgs/ObjectColor.h>
#include <moveit_msgs/PlanningScene.h>

namespace moveit {
namespace planning_interface {

MOVEIT_CLASS_FORWARD(PlanningSceneInterface);

/// The functions named apply and get call move_group's services and return when it has answered; add and remove only send.
class PlanningSceneInterface {
 public:
  /// @param ns namespace of move_group
  /// @param wait for its services; without, std::runtime_error when they are not there
  explicit PlanningSceneInterface(const std::string& ns = "", bool wait = true, bool persistent_connections = false);
  ~PlanningSceneInterface();

  /// @param with_type only objects whose type is known
  std::vector<std::string> getKnownObjectNames(bool with_type = false);

  /// Objects all of whose shapes have their origin in the box (m, in the frame that the scene gives objects in).
  std::vector<std::string> getKnownObjectNamesInROI(double minx, double miny, double minz, double maxx, double maxy,
                                                    double maxz, bool with_type, std::vector<std::string>& types);
  std::vector<std::string> getKnownObjectNamesInROI(double minx, double miny, double minz, double maxx, double maxy,
                                                    double maxz, bool with_type = false) {
    std::vector<std::string> types;
    return getKnownObjectNamesInROI(minx, miny, minz, maxx, maxy, maxz, with_type, types);
  }

  // By name; unknown names are left out. All objects when no name is given, but getObjectPoses gives none then.
  std::map<std::string, geometry_msgs::Pose> getObjectPoses(const std::vector<std::string>& object_ids);
  std::map<std::string, moveit_msgs::CollisionObject> getObjects(
      const std::vector<std::string>& object_ids = std::vector<std::string>());
  std::map<std::string, moveit_msgs::AttachedCollisionObject> getAttachedObjects(
      const std::vector<std::string>& object_ids = std::vector<std::string>());

  bool applyCollisionObject(const moveit_msgs::CollisionObject& collision_object);
  bool applyCollisionObject(const moveit_msgs::CollisionObject& collision_object, const std_msgs::ColorRGBA& object_color);
  /// A color without an id belongs to the object at the same place of the list.
  bool applyCollisionObjects(
      const std::vector<moveit_msgs::CollisionObject>& collision_objects,
      const std::vector<moveit_msgs::ObjectColor>& object_colors = std::vector<moveit_msgs::ObjectColor>());
  bool applyAttachedCollisionObject(const moveit_msgs::AttachedCollisionObject& attached_collision_object);
  bool applyAttachedCollisionObjects(const std::vector<moveit_msgs::AttachedCollisionObject>& attached_collision_objects);

  /// @param components bits of moveit_msgs/PlanningSceneComponents, 0 for all
  moveit_msgs::PlanningScene getPlanningSceneMsg(uint32_t components);
  bool applyPlanningScene(const moveit_msgs::PlanningScene& ps);

  void addCollisionObjects(
      const std::vector<moveit_msgs::CollisionObject>& collision_objects,
      const std::vector<moveit_msgs::ObjectColor>& object_colors = std::vector<moveit_msgs::ObjectColor>()) const;
  void removeCollisionObjects(const std::vector<std::string>& object_ids) const;

  /// Remove all objects, attached ones too.
  bool clear();

 private:
  struct Impl;
  std::shared_ptr<Impl> impl_;
};

}  // namespace planning_interface
}  // namespace moveit
