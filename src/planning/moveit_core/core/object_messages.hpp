// Shapes and poses of objects in messages.
#pragma once

#include <geometric_shapes/shapes.h>
#include <moveit_msgs/CollisionObject.h>

#include <moveit/collision_detection/world.h>
#include <moveit/transforms/transforms.h>

#include <eigen_stl_containers/eigen_stl_vector_container.h>

namespace moveit
{
namespace core
{
struct ObjectParts
{
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  // of the object, in the message's frame
  std::vector<shapes::ShapeConstPtr> shapes;
  EigenSTL::vector_Isometry3d shape_poses;  // in the object
  FixedTransformsMap subframes;             // in the object
};

ObjectParts partsOf(const collision_detection::World::Object& object);

// A quaternion of zeros counts as no rotation, any other is normalised.
Eigen::Isometry3d poseFromMessage(const geometry_msgs::Pose& pose);

// Shapes that are none (no size, no triangles) are left out, with a line in the log; false if the lists do not fit each other.
bool readObject(const moveit_msgs::CollisionObject& message, ObjectParts& parts);
void writeObject(const ObjectParts& parts, moveit_msgs::CollisionObject& message);
}  // namespace core
}  // namespace moveit
