// Level tops of objects, and where something can be put down on them.
#pragma once

#include <geometric_shapes/shapes.h>
#include <moveit/collision_detection/world.h>
#include <object_recognition_msgs/Table.h>

#include <Eigen/Geometry>
#include <string>
#include <vector>

namespace moveit_rviz_plugin {

// What an object takes up, in the frame that its vertices were given in, m.
struct Bounds {
  Eigen::Vector3d low = Eigen::Vector3d::Zero(), high = Eigen::Vector3d::Zero();
};

// A convex, level outline, counter-clockwise, in the model frame (z is up), m.
struct Surface {
  std::string id;  // of the object whose top it is
  double height = 0.0;
  std::vector<Eigen::Vector2d> outline;

  double area() const;
  Eigen::Vector2d centre() const;
  // How far a point is from the nearest edge; negative outside.
  double inside(const Eigen::Vector2d& point) const;
};

// Corners of shapes; of round ones those of a mesh around them. Planes and voxels have none.
std::vector<Eigen::Vector3d> cornersOf(const std::vector<shapes::ShapeConstPtr>& shapes,
                                       const EigenSTL::vector_Isometry3d& poses);
Bounds boundsOf(const std::vector<Eigen::Vector3d>& corners);
std::vector<Eigen::Vector2d> convexHull(std::vector<Eigen::Vector2d> points);

// Objects that something could stand on, the largest first.
std::vector<Surface> surfacesOf(const collision_detection::World& world);
// The one that an object stands on, "" if none.
std::string surfaceBelow(const std::vector<Surface>& surfaces, const collision_detection::World::Object& object);
// Where an upright object with these bounds (around its own frame) can stand without reaching over the edge, nearest to `from`
// first; on a surface that is too small for it, in the middle.
std::vector<Eigen::Vector3d> placesOn(const Surface& surface, const Bounds& object, const Eigen::Vector3d& from);
// A board of the outline of a table that was detected; null if it has none. Its frame is the table's.
shapes::ShapeConstPtr boardOf(const object_recognition_msgs::Table& table);

}  // namespace moveit_rviz_plugin
