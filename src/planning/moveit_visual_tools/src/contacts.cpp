// Where a state touches itself or the scene.
#include <moveit_visual_tools/moveit_visual_tools.h>

#include <moveit/planning_scene/planning_scene.h>

namespace moveit_visual_tools {
namespace {

const double CONTACT_SIZE = 0.04;  // m

collision_detection::CollisionResult check(const planning_scene::PlanningScene& scene, const moveit::core::RobotState& state) {
  collision_detection::CollisionRequest request;
  request.contacts = true;
  request.max_contacts = 10;
  request.max_contacts_per_pair = 3;
  collision_detection::CollisionResult result;
  scene.checkCollision(request, result, state);
  return result;
}

}  // namespace

bool MoveItVisualTools::checkAndPublishCollision(const moveit::core::RobotState& robot_state,
                                                 const planning_scene::PlanningScene* planning_scene,
                                                 const rviz_visual_tools::colors& highlight_link_color,
                                                 const rviz_visual_tools::colors& contact_point_color) {
  const collision_detection::CollisionResult result = check(*planning_scene, robot_state);
  std::vector<std::string> touching;
  for (const auto& [names, contacts] : result.contacts) touching.insert(touching.end(), {names.first, names.second});
  publishRobotState(robot_state, highlight_link_color, touching);
  publishContactPoints(result.contacts, planning_scene, contact_point_color);
  return result.collision;
}

bool MoveItVisualTools::publishContactPoints(const moveit::core::RobotState& robot_state,
                                             const planning_scene::PlanningScene* planning_scene,
                                             const rviz_visual_tools::colors& color) {
  return publishContactPoints(check(*planning_scene, robot_state).contacts, planning_scene, color);
}

bool MoveItVisualTools::publishContactPoints(const collision_detection::CollisionResult::ContactMap& contacts,
                                             const planning_scene::PlanningScene* planning_scene,
                                             const rviz_visual_tools::colors& color) {
  visualization_msgs::MarkerArray points;
  for (const auto& [names, touches] : contacts)
    for (const collision_detection::Contact& contact : touches) {
      visualization_msgs::Marker point;
      point.header.frame_id = planning_scene->getPlanningFrame();
      point.header.stamp = ros::Time::now();
      point.ns = "Collision";
      point.id = points.markers.size();
      point.type = visualization_msgs::Marker::SPHERE;
      point.pose = convertPointToPose(convertPoint(contact.pos));
      point.scale.x = point.scale.y = point.scale.z = CONTACT_SIZE;
      point.color = getColor(color);
      point.lifetime = marker_lifetime_;
      points.markers.push_back(point);
    }
  return points.markers.empty() || publishMarkers(points);
}

}  // namespace moveit_visual_tools
