#include <urdf_geometry_parser/urdf_geometry_parser.h>

#include <algorithm>
#include <cmath>

#include <ros/console.h>

namespace urdf_geometry_parser
{

UrdfGeometryParser::UrdfGeometryParser(ros::NodeHandle& root_nh, const std::string& base_link) : base_link_(base_link)
{
  std::string text;
  if (!root_nh.getParam("robot_description", text) || text.empty())
    ROS_ERROR("parameter %s is not set: load the robot's description in the launch file",
              root_nh.resolveName("robot_description").c_str());
  else if (!(model_ = urdf::parseURDF(text)))
    ROS_ERROR("the robot's description in parameter %s cannot be read", root_nh.resolveName("robot_description").c_str());
}

urdf::JointConstSharedPtr UrdfGeometryParser::joint(const std::string& name) const
{
  const urdf::JointConstSharedPtr found = model_ ? model_->getJoint(name) : nullptr;
  if (model_ && !found)
    ROS_ERROR("joint '%s' is not in the robot's description", name.c_str());
  return found;
}

bool UrdfGeometryParser::getTransformVector(const std::string& joint_name, const std::string& parent_link_name,
                                            urdf::Vector3& transform_vector)
{
  urdf::JointConstSharedPtr at = joint(joint_name);
  if (!at)
    return false;
  urdf::Vector3 sum = at->parent_to_joint_origin_transform.position;
  while (at->parent_link_name != parent_link_name)
  {
    const urdf::LinkConstSharedPtr link = model_->getLink(at->parent_link_name);
    at = link ? link->parent_joint : nullptr;
    if (!at)
    {
      ROS_ERROR("link '%s' is not above joint '%s' in the robot's description", parent_link_name.c_str(), joint_name.c_str());
      return false;
    }
    sum = sum + at->parent_to_joint_origin_transform.position;
  }
  transform_vector = sum;
  return true;
}

bool UrdfGeometryParser::getDistanceBetweenJoints(const std::string& first_joint_name, const std::string& second_joint_name,
                                                  double& distance)
{
  urdf::Vector3 first, second;
  if (!getTransformVector(first_joint_name, base_link_, first) || !getTransformVector(second_joint_name, base_link_, second))
    return false;
  distance = std::hypot(first.x - second.x, first.y - second.y);
  return true;
}

bool UrdfGeometryParser::getJointRadius(const std::string& joint_name, double& radius)
{
  const urdf::JointConstSharedPtr turned_by = joint(joint_name);
  if (!turned_by)
    return false;
  const urdf::LinkConstSharedPtr wheel = model_->getLink(turned_by->child_link_name);
  if (!wheel || !wheel->collision || !wheel->collision->geometry ||
      wheel->collision->geometry->type != urdf::Geometry::CYLINDER)
  {
    ROS_ERROR("wheel link '%s' of joint '%s' needs a collision geometry that is a cylinder", turned_by->child_link_name.c_str(),
              joint_name.c_str());
    return false;
  }
  radius = static_cast<const urdf::Cylinder&>(*wheel->collision->geometry).radius;
  return true;
}

bool UrdfGeometryParser::getJointSteeringLimits(const std::string& joint_name, double& steering_limit)
{
  const urdf::JointConstSharedPtr steered = joint(joint_name);
  if (!steered)
    return false;
  if (steered->type != urdf::Joint::REVOLUTE || !steered->limits)
  {
    ROS_ERROR("joint '%s' has no steering limit: it is not of type revolute, with a <limit>", joint_name.c_str());
    return false;
  }
  steering_limit = std::min(std::fabs(steered->limits->lower), std::fabs(steered->limits->upper));
  return true;
}

}  // namespace urdf_geometry_parser
