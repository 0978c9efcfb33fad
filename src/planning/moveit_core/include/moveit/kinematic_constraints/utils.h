// Messages of constraints, made of what one has.
#pragma once

#include <geometry_msgs/PointStamped.h>
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/QuaternionStamped.h>
#include <moveit_msgs/Constraints.h>

#include <limits>

#include <moveit/robot_state/robot_state.h>

namespace kinematic_constraints
{
// Joint constraints on the same joint become one, which allows what both allow.
moveit_msgs::Constraints mergeConstraints(const moveit_msgs::Constraints& first, const moveit_msgs::Constraints& second);
bool isEmpty(const moveit_msgs::Constraints& constr);
std::size_t countIndividualConstraints(const moveit_msgs::Constraints& constr);

// The joints of the group where they are in the state.
moveit_msgs::Constraints constructGoalConstraints(const moveit::core::RobotState& state,
                                                  const moveit::core::JointModelGroup* jmg, double tolerance_below,
                                                  double tolerance_above);
moveit_msgs::Constraints constructGoalConstraints(const moveit::core::RobotState& state,
                                                  const moveit::core::JointModelGroup* jmg,
                                                  double tolerance = std::numeric_limits<double>::epsilon());
// A link at a pose: within a sphere or a box (m) and angles about the axes (rad).
moveit_msgs::Constraints constructGoalConstraints(const std::string& link_name, const geometry_msgs::PoseStamped& pose,
                                                  double tolerance_pos = 1e-3, double tolerance_angle = 1e-2);
moveit_msgs::Constraints constructGoalConstraints(const std::string& link_name, const geometry_msgs::PoseStamped& pose,
                                                  const std::vector<double>& tolerance_pos,
                                                  const std::vector<double>& tolerance_angle);
moveit_msgs::Constraints constructGoalConstraints(const std::string& link_name, const geometry_msgs::QuaternionStamped& quat,
                                                  double tolerance = 1e-2);
// A point of a link.
moveit_msgs::Constraints constructGoalConstraints(const std::string& link_name, const geometry_msgs::Point& reference_point,
                                                  const geometry_msgs::PointStamped& goal_point, double tolerance = 1e-3);
moveit_msgs::Constraints constructGoalConstraints(const std::string& link_name, const geometry_msgs::PointStamped& goal_point,
                                                  double tolerance = 1e-3);

// Frames of attached bodies and subframes become links. False when a frame is not known.
bool resolveConstraintFrames(const moveit::core::RobotState& state, moveit_msgs::Constraints& constraints);
}  // namespace kinematic_constraints
