#include "object_messages.hpp"

#include <geometric_shapes/shape_operations.h>
#include <ros/console.h>
#include <tf2_eigen/tf2_eigen.h>

#include <boost/variant.hpp>

#include <moveit/utils/message_checks.h>

namespace moveit
{
namespace core
{
ObjectParts partsOf(const collision_detection::World::Object& object)
{
  ObjectParts parts;
  parts.pose = object.pose_;
  parts.shapes = object.shapes_;
  parts.shape_poses = object.shape_poses_;
  parts.subframes = object.subframe_poses_;
  return parts;
}

Eigen::Isometry3d poseFromMessage(const geometry_msgs::Pose& pose)
{
  Eigen::Quaterniond q(pose.orientation.w, pose.orientation.x, pose.orientation.y, pose.orientation.z);
  if (q.squaredNorm() < 1e-12)
    q.setIdentity();
  return Eigen::Translation3d(pose.position.x, pose.position.y, pose.position.z) * q.normalized();
}

bool readObject(const moveit_msgs::CollisionObject& message, ObjectParts& parts)
{
  if (message.primitives.size() < message.primitive_poses.size() || message.meshes.size() < message.mesh_poses.size() ||
      message.planes.size() < message.plane_poses.size())
  {
    ROS_ERROR_NAMED("collision_object", "More shape poses than shapes in collision object message of '%s'.",
                    message.id.c_str());
    return false;
  }
  parts.pose = poseFromMessage(message.pose);
  const auto add = [&](const auto& shapes, const auto& poses) {
    for (std::size_t i = 0; i < shapes.size(); ++i)
    {
      const shapes::ShapeConstPtr shape(shapes::constructShapeFromMsg(shapes[i]));
      if (!shape)
      {
        ROS_ERROR_NAMED("collision_object", "A shape of collision object '%s' is none; left out.", message.id.c_str());
        continue;
      }
      parts.shapes.push_back(shape);
      parts.shape_poses.push_back(i < poses.size() ? poseFromMessage(poses[i]) : Eigen::Isometry3d::Identity());
    }
  };
  add(message.primitives, message.primitive_poses);
  add(message.meshes, message.mesh_poses);
  add(message.planes, message.plane_poses);
  // An object of one shape that says nothing of its own pose is where its shape is.
  if (parts.shapes.size() == 1 && isEmpty(message.pose))
    std::swap(parts.pose, parts.shape_poses[0]);
  for (std::size_t i = 0; i < message.subframe_names.size() && i < message.subframe_poses.size(); ++i)
    parts.subframes[message.subframe_names[i]] = poseFromMessage(message.subframe_poses[i]);
  return true;
}

namespace
{
struct IntoMessage : boost::static_visitor<void>
{
  moveit_msgs::CollisionObject& message;
  const geometry_msgs::Pose pose;
  IntoMessage(moveit_msgs::CollisionObject& message, const geometry_msgs::Pose& pose) : message(message), pose(pose) {}

  void operator()(const shape_msgs::Plane& shape) const
  {
    message.planes.push_back(shape);
    message.plane_poses.push_back(pose);
  }
  void operator()(const shape_msgs::Mesh& shape) const
  {
    message.meshes.push_back(shape);
    message.mesh_poses.push_back(pose);
  }
  void operator()(const shape_msgs::SolidPrimitive& shape) const
  {
    message.primitives.push_back(shape);
    message.primitive_poses.push_back(pose);
  }
};
}  // namespace

void writeObject(const ObjectParts& parts, moveit_msgs::CollisionObject& message)
{
  message.pose = tf2::toMsg(parts.pose);
  for (std::size_t i = 0; i < parts.shapes.size(); ++i)
  {
    shapes::ShapeMsg shape;
    if (shapes::constructMsgFromShape(parts.shapes[i].get(), shape))
      boost::apply_visitor(IntoMessage(message, tf2::toMsg(parts.shape_poses[i])), shape);
  }
  for (const auto& frame : parts.subframes)
  {
    message.subframe_names.push_back(frame.first);
    message.subframe_poses.push_back(tf2::toMsg(frame.second));
  }
}
}  // namespace core
}  // namespace moveit
