// The markers by which the tips of a planning group are dragged.
#pragma once

#include <visualization_msgs/InteractiveMarker.h>

#include <Eigen/Geometry>
#include <moveit/robot_model/robot_model.h>
#include <set>
#include <string>
#include <vector>

namespace moveit_rviz_plugin {

struct Tip {
  std::string group;  // the group, or its subgroup, that inverse kinematics is asked for
  std::string link;
  double size;  // of its marker, m
};

// Where a group can be dragged: where its end effectors are mounted, or the end of a chain. `solvable`: groups that have a
// solver of inverse kinematics.
std::vector<Tip> tipsOf(const moveit::core::RobotModel& model, const moveit::core::JointModelGroup& group,
                        const std::set<std::string>& solvable);

// Groups with a solver, by the parameters below <robot_description>_kinematics.
std::set<std::string> solvableGroups(const moveit::core::RobotModel& model, const std::string& robot_description);

// Six arrows and rings and a ball.
visualization_msgs::InteractiveMarker dragMarker(const std::string& name, const std::string& frame,
                                                 const Eigen::Isometry3d& pose, double size);

}  // namespace moveit_rviz_plugin
