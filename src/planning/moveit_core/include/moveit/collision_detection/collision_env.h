// The collision checks of a planning scene, and the padding and scale of its links.
#pragma once

#include <moveit_msgs/LinkPadding.h>
#include <moveit_msgs/LinkScale.h>

#include <moveit/collision_detection/collision_matrix.h>
#include <moveit/collision_detection/world.h>
#include <moveit/macros/class_forward.h>
#include <moveit/robot_state/robot_state.h>

namespace planning_scene
{
class PlanningScene;
}

namespace collision_detection
{
MOVEIT_CLASS_FORWARD(CollisionEnv);

// Belongs to its scene and is not to outlive it.
class CollisionEnv
{
public:
  virtual ~CollisionEnv() {}

  void checkSelfCollision(const CollisionRequest& req, CollisionResult& res, const moveit::core::RobotState& state) const;
  void checkSelfCollision(const CollisionRequest& req, CollisionResult& res, const moveit::core::RobotState& state,
                          const AllowedCollisionMatrix& acm) const;
  void checkRobotCollision(const CollisionRequest& req, CollisionResult& res, const moveit::core::RobotState& state) const;
  void checkRobotCollision(const CollisionRequest& req, CollisionResult& res, const moveit::core::RobotState& state,
                           const AllowedCollisionMatrix& acm) const;
  // All along the way between two states, looked at in steps of 0.01 rad or m at most of any variable.
  void checkRobotCollision(const CollisionRequest& req, CollisionResult& res, const moveit::core::RobotState& state1,
                           const moveit::core::RobotState& state2) const;
  void checkRobotCollision(const CollisionRequest& req, CollisionResult& res, const moveit::core::RobotState& state1,
                           const moveit::core::RobotState& state2, const AllowedCollisionMatrix& acm) const;
  void checkCollision(const CollisionRequest& req, CollisionResult& res, const moveit::core::RobotState& state) const;
  void checkCollision(const CollisionRequest& req, CollisionResult& res, const moveit::core::RobotState& state,
                      const AllowedCollisionMatrix& acm) const;
  double distanceSelf(const moveit::core::RobotState& state) const;
  double distanceSelf(const moveit::core::RobotState& state, const AllowedCollisionMatrix& acm) const;
  double distanceRobot(const moveit::core::RobotState& state, bool verbose = false) const;
  double distanceRobot(const moveit::core::RobotState& state, const AllowedCollisionMatrix& acm, bool verbose = false) const;

  // Of the links of the request's group, each pair once unless the request is GLOBAL. 0 where bodies touch: how deep, and
  // gradients, are not told.
  void distanceSelf(const DistanceRequest& req, DistanceResult& res, const moveit::core::RobotState& state) const;
  void distanceRobot(const DistanceRequest& req, DistanceResult& res, const moveit::core::RobotState& state) const;

  const WorldPtr& getWorld();
  const moveit::core::RobotModelConstPtr& getRobotModel() const;

  // ------------------------------------------------------------ padding (m) and scale, of all links or of one
  void setPadding(double padding);
  void setScale(double scale);
  void setLinkPadding(const std::string& link_name, double padding);
  void setLinkPadding(const std::map<std::string, double>& padding);
  void setLinkScale(const std::string& link_name, double scale);
  void setLinkScale(const std::map<std::string, double>& scale);
  double getLinkPadding(const std::string& link_name) const;
  double getLinkScale(const std::string& link_name) const;
  const std::map<std::string, double>& getLinkPadding() const;
  const std::map<std::string, double>& getLinkScale() const;
  void setPadding(const std::vector<moveit_msgs::LinkPadding>& padding);
  void setScale(const std::vector<moveit_msgs::LinkScale>& scale);
  void getPadding(std::vector<moveit_msgs::LinkPadding>& padding) const;
  void getScale(std::vector<moveit_msgs::LinkScale>& scale) const;

private:
  friend class planning_scene::PlanningScene;
  CollisionEnv(planning_scene::PlanningScene& scene, bool padded) : scene_(scene), padded_(padded) {}

  planning_scene::PlanningScene& scene_;
  bool padded_;
};
}  // namespace collision_detection
