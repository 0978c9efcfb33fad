#include "drag_markers.hpp"

#include <ros/param.h>
#include <tf2_eigen/tf2_eigen.h>
#include <visualization_msgs/InteractiveMarkerControl.h>

#include <cmath>

namespace moveit_rviz_plugin {
namespace {
constexpr double USUAL_SIZE = 0.25;  // m, of markers on links without shapes
constexpr double ALONE = 1.5;        // a single marker is larger

// Twice the norm of the two smaller edges of the link's box; links bolted to others are as large as those.
double markerSize(const moveit::core::LinkModel* link) {
  while (link) {
    Eigen::Vector3d extents = link->getShapeExtentsAtOrigin();
    int largest = 0;
    extents.maxCoeff(&largest);
    extents[largest] = 0.0;
    if (extents.norm() > 0.0) return 2.0 * 1.01 * extents.norm();
    link = link->parentJointIsFixed() ? link->getParentLinkModel() : nullptr;
  }
  return USUAL_SIZE;
}

// The group itself, or the smallest of its subgroups, that has a solver and moves the link.
std::string solverGroup(const moveit::core::RobotModel& model, const moveit::core::JointModelGroup& group,
                        const std::string& link, const std::set<std::string>& solvable) {
  if (solvable.count(group.getName())) return group.getName();
  std::string best;
  for (const std::string& name : group.getSubgroupNames()) {
    const moveit::core::JointModelGroup* sub = model.getJointModelGroup(name);
    if (!sub || !solvable.count(name) || !sub->isLinkUpdated(link)) continue;
    if (best.empty() || sub->getVariableCount() < model.getJointModelGroup(best)->getVariableCount()) best = name;
  }
  return best;
}
}  // namespace

std::set<std::string> solvableGroups(const moveit::core::RobotModel& model, const std::string& robot_description) {
  std::set<std::string> groups;
  std::string key = robot_description;
  ros::param::search(robot_description, key);
  for (const std::string& name : model.getJointModelGroupNames())
    if (ros::param::has(key + "_kinematics/" + name + "/kinematics_solver")) groups.insert(name);
  return groups;
}

std::vector<Tip> tipsOf(const moveit::core::RobotModel& model, const moveit::core::JointModelGroup& group,
                        const std::set<std::string>& solvable) {
  std::set<std::string> links;
  for (const srdf::Model::EndEffector& end : model.getSRDF()->getEndEffectors())
    if (end.component_group_ != group.getName() && group.isLinkUpdated(end.parent_link_) &&
        (end.parent_group_.empty() || end.parent_group_ == group.getName() || group.isSubgroup(end.parent_group_)))
      links.insert(end.parent_link_);
  if (links.empty() && group.isChain() && !group.getLinkModelNames().empty()) links.insert(group.getLinkModelNames().back());
  if (links.empty())
    for (const std::string& name : group.getSubgroupNames()) {
      const moveit::core::JointModelGroup* sub = model.getJointModelGroup(name);
      if (sub && sub->isChain() && solvable.count(name)) links.insert(sub->getLinkModelNames().back());
    }
  std::vector<Tip> tips;
  for (const std::string& link : links) {
    const std::string solver = solverGroup(model, group, link, solvable);
    if (!solver.empty()) tips.push_back({solver, link, markerSize(model.getLinkModel(link))});
  }
  if (tips.size() == 1) tips.front().size *= ALONE;
  return tips;
}

visualization_msgs::InteractiveMarker dragMarker(const std::string& name, const std::string& frame,
                                                 const Eigen::Isometry3d& pose, double size) {
  visualization_msgs::InteractiveMarker marker;
  marker.name = name;
  marker.header.frame_id = frame;
  marker.scale = static_cast<float>(size);
  marker.pose = tf2::toMsg(pose);
  using Control = visualization_msgs::InteractiveMarkerControl;
  Control ball;
  ball.name = "move";
  ball.interaction_mode = Control::MOVE_ROTATE_3D;
  ball.orientation_mode = Control::VIEW_FACING;
  ball.independent_marker_orientation = true;
  ball.always_visible = true;
  ball.markers.resize(1);
  visualization_msgs::Marker& sphere = ball.markers[0];
  sphere.type = visualization_msgs::Marker::SPHERE;
  sphere.pose.orientation.w = 1.0;
  sphere.scale.x = sphere.scale.y = sphere.scale.z = size / 2.0;
  sphere.color.g = sphere.color.b = 1.0f;
  sphere.color.a = 0.5f;
  marker.controls.push_back(ball);
  const double half = std::sqrt(0.5);
  for (const char axis : {'x', 'y', 'z'}) {
    Control control;  // its x axis turned to x, y, z
    control.orientation.w = half;
    (axis == 'x' ? control.orientation.x : axis == 'y' ? control.orientation.z : control.orientation.y) = half;
    control.name = std::string("rotate_") + axis;
    control.interaction_mode = Control::ROTATE_AXIS;
    marker.controls.push_back(control);
    control.name = std::string("move_") + axis;
    control.interaction_mode = Control::MOVE_AXIS;
    marker.controls.push_back(control);
  }
  return marker;
}

}  // namespace moveit_rviz_plugin
