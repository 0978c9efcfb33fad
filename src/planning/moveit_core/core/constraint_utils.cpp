#include <moveit/kinematic_constraints/utils.h>

#include <shape_msgs/SolidPrimitive.h>
#include <tf2_eigen/tf2_eigen.h>

#include <algorithm>

#include <moveit/utils/message_checks.h>

namespace kinematic_constraints
{
namespace
{
using moveit_msgs::Constraints;

moveit_msgs::OrientationConstraint orientation(const std::string& link, const std_msgs::Header& header,
                                               const geometry_msgs::Quaternion& turn, const std::vector<double>& tolerance)
{
  moveit_msgs::OrientationConstraint c;
  c.link_name = link;
  c.header = header;
  c.orientation = turn;
  c.absolute_x_axis_tolerance = tolerance[0];
  c.absolute_y_axis_tolerance = tolerance[1];
  c.absolute_z_axis_tolerance = tolerance[2];
  c.weight = 1.0;
  return c;
}

moveit_msgs::PositionConstraint position(const std::string& link, const std_msgs::Header& header,
                                         const geometry_msgs::Point& point, const shape_msgs::SolidPrimitive& region)
{
  moveit_msgs::PositionConstraint c;
  c.link_name = link;
  c.header = header;
  c.constraint_region.primitives.push_back(region);
  geometry_msgs::Pose pose;
  pose.position = point;
  pose.orientation.w = 1.0;
  c.constraint_region.primitive_poses.push_back(pose);
  c.weight = 1.0;
  return c;
}

shape_msgs::SolidPrimitive sphere(double radius)
{
  shape_msgs::SolidPrimitive region;
  region.type = shape_msgs::SolidPrimitive::SPHERE;
  region.dimensions.assign(1, radius);
  return region;
}

template <typename List>
void append(List& list, const List& more)
{
  list.insert(list.end(), more.begin(), more.end());
}
}  // namespace

Constraints mergeConstraints(const Constraints& first, const Constraints& second)
{
  Constraints merged = first;
  merged.joint_constraints.clear();
  for (const auto& a : first.joint_constraints)
  {
    moveit_msgs::JointConstraint both = a;
    bool possible = true;
    for (const auto& b : second.joint_constraints)
    {
      if (b.joint_name != a.joint_name)
        continue;
      const double low = std::max(a.position - a.tolerance_below, b.position - b.tolerance_below);
      const double high = std::min(a.position + a.tolerance_above, b.position + b.tolerance_above);
      possible = low <= high;
      if (!possible)
      {
        ROS_ERROR_NAMED("kinematic_constraints",
                        "Attempted to merge incompatible constraints for joint '%s'. Discarding constraint.",
                        a.joint_name.c_str());
        break;
      }
      both.position = std::max(low, std::min((a.position + b.position) / 2.0, high));
      both.weight = (a.weight + b.weight) / 2.0;
      both.tolerance_above = std::max(0.0, high - both.position);
      both.tolerance_below = std::max(0.0, both.position - low);
    }
    if (possible)
      merged.joint_constraints.push_back(both);
  }
  for (const auto& b : second.joint_constraints)
    if (std::none_of(first.joint_constraints.begin(), first.joint_constraints.end(),
                     [&b](const moveit_msgs::JointConstraint& a) { return a.joint_name == b.joint_name; }))
      merged.joint_constraints.push_back(b);
  append(merged.position_constraints, second.position_constraints);
  append(merged.orientation_constraints, second.orientation_constraints);
  append(merged.visibility_constraints, second.visibility_constraints);
  return merged;
}

bool isEmpty(const Constraints& constr) { return moveit::core::isEmpty(constr); }

std::size_t countIndividualConstraints(const Constraints& constr)
{
  return constr.position_constraints.size() + constr.orientation_constraints.size() + constr.visibility_constraints.size() +
         constr.joint_constraints.size();
}

Constraints constructGoalConstraints(const moveit::core::RobotState& state, const moveit::core::JointModelGroup* jmg,
                                     double tolerance_below, double tolerance_above)
{
  Constraints goal;
  std::vector<double> values;
  state.copyJointGroupPositions(jmg, values);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    moveit_msgs::JointConstraint c;
    c.joint_name = jmg->getVariableNames()[i];
    c.position = values[i];
    c.tolerance_above = tolerance_above;
    c.tolerance_below = tolerance_below;
    c.weight = 1.0;
    goal.joint_constraints.push_back(c);
  }
  return goal;
}

Constraints constructGoalConstraints(const moveit::core::RobotState& state, const moveit::core::JointModelGroup* jmg,
                                     double tolerance)
{
  return constructGoalConstraints(state, jmg, tolerance, tolerance);
}

Constraints constructGoalConstraints(const std::string& link_name, const geometry_msgs::PoseStamped& pose, double tolerance_pos,
                                     double tolerance_angle)
{
  Constraints goal;
  goal.position_constraints.push_back(position(link_name, pose.header, pose.pose.position, sphere(tolerance_pos)));
  goal.orientation_constraints.push_back(
      orientation(link_name, pose.header, pose.pose.orientation, std::vector<double>(3, tolerance_angle)));
  return goal;
}

Constraints constructGoalConstraints(const std::string& link_name, const geometry_msgs::PoseStamped& pose,
                                     const std::vector<double>& tolerance_pos, const std::vector<double>& tolerance_angle)
{
  if (tolerance_pos.size() != 3 || tolerance_angle.size() != 3)
    throw moveit::Exception("constructGoalConstraints: three tolerances each are needed for position and orientation");
  Constraints goal;
  shape_msgs::SolidPrimitive box;
  box.type = shape_msgs::SolidPrimitive::BOX;
  box.dimensions = tolerance_pos;
  goal.position_constraints.push_back(position(link_name, pose.header, pose.pose.position, box));
  goal.orientation_constraints.push_back(orientation(link_name, pose.header, pose.pose.orientation, tolerance_angle));
  return goal;
}

Constraints constructGoalConstraints(const std::string& link_name, const geometry_msgs::QuaternionStamped& quat,
                                     double tolerance)
{
  Constraints goal;
  goal.orientation_constraints.push_back(
      orientation(link_name, quat.header, quat.quaternion, std::vector<double>(3, tolerance)));
  return goal;
}

Constraints constructGoalConstraints(const std::string& link_name, const geometry_msgs::Point& reference_point,
                                     const geometry_msgs::PointStamped& goal_point, double tolerance)
{
  Constraints goal;
  goal.position_constraints.push_back(position(link_name, goal_point.header, goal_point.point, sphere(tolerance)));
  goal.position_constraints[0].target_point_offset.x = reference_point.x;
  goal.position_constraints[0].target_point_offset.y = reference_point.y;
  goal.position_constraints[0].target_point_offset.z = reference_point.z;
  return goal;
}

Constraints constructGoalConstraints(const std::string& link_name, const geometry_msgs::PointStamped& goal_point,
                                     double tolerance)
{
  return constructGoalConstraints(link_name, geometry_msgs::Point(), goal_point, tolerance);
}

bool resolveConstraintFrames(const moveit::core::RobotState& state, Constraints& constraints)
{
  const auto link = [&state](const std::string& name, Eigen::Isometry3d& in_link) -> const moveit::core::LinkModel* {
    const moveit::core::LinkModel* robot_link;
    bool found;
    const Eigen::Isometry3d pose = state.getFrameInfo(name, robot_link, found);
    if (!found || !robot_link)
      return nullptr;
    in_link = state.getGlobalLinkTransform(robot_link).inverse() * pose;
    return robot_link;
  };
  for (auto& c : constraints.position_constraints)
  {
    Eigen::Isometry3d in_link;
    const moveit::core::LinkModel* robot_link = link(c.link_name, in_link);
    if (!robot_link)
      return false;
    if (robot_link->getName() == c.link_name)
      continue;
    const Eigen::Vector3d offset =
        in_link * Eigen::Vector3d(c.target_point_offset.x, c.target_point_offset.y, c.target_point_offset.z);
    c.link_name = robot_link->getName();
    c.target_point_offset.x = offset.x();
    c.target_point_offset.y = offset.y();
    c.target_point_offset.z = offset.z();
  }
  for (auto& c : constraints.orientation_constraints)
  {
    Eigen::Isometry3d in_link;
    const moveit::core::LinkModel* robot_link = link(c.link_name, in_link);
    if (!robot_link)
      return false;
    if (robot_link->getName() == c.link_name)
      continue;
    Eigen::Quaterniond turn;
    tf2::fromMsg(c.orientation, turn);
    c.link_name = robot_link->getName();
    c.orientation = tf2::toMsg(Eigen::Quaterniond(turn * Eigen::Quaterniond(in_link.linear()).inverse()));
  }
  return true;
}
}  // namespace kinematic_constraints
