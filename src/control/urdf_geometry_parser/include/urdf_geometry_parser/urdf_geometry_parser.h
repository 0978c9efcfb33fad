// What controllers in C++ want to know from a robot's description.
#pragma once

#include <string>

#include <ros/node_handle.h>
#include <urdf/urdfdom_compatibility.h>
#include <urdf_parser/urdf_parser.h>

namespace urdf_geometry_parser
{

/// Lengths in m, angles in rad. Whatever cannot be answered is false, with an ERROR line that says why.
class UrdfGeometryParser
{
public:
  /// \param root_nh its robot_description is read \param base_link distances are between positions in its frame
  UrdfGeometryParser(ros::NodeHandle& root_nh, const std::string& base_link);

  /// Where a joint is in the frame of a link above it. The origins on the way are added up; rotations between them do not count.
  bool getTransformVector(const std::string& joint_name, const std::string& parent_link_name, urdf::Vector3& transform_vector);

  /// Seen from above.
  bool getDistanceBetweenJoints(const std::string& first_joint_name, const std::string& second_joint_name, double& distance);

  /// Radius of the link that a joint turns; its collision shape is a cylinder.
  bool getJointRadius(const std::string& joint_name, double& radius);

  /// The smaller one of a revolute joint's limits, without its sign.
  bool getJointSteeringLimits(const std::string& joint_name, double& steering_limit);

private:
  urdf::JointConstSharedPtr joint(const std::string& name) const;

  std::string base_link_;
  urdf::ModelInterfaceSharedPtr model_;
};

}  // namespace urdf_geometry_parser
