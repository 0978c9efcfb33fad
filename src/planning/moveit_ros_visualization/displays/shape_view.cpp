#include "shape_view.hpp"

#include <octomap/octomap.h>

#include <OgreSceneManager.h>
#include <OgreSceneNode.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <rviz/ogre_helpers/mesh_shape.h>
#include <rviz/ogre_helpers/point_cloud.h>
#include <rviz/ogre_helpers/shape.h>

namespace moveit_rviz_plugin {
namespace {
// An infinite plane is drawn as a thin square of this edge, m.
constexpr double PLANE_EDGE = 10.0, PLANE_THICKNESS = 0.001;

// From dark blue at 0 to red at 1.
Ogre::ColourValue rainbow(double height) {
  Ogre::ColourValue color;
  color.setHSB(static_cast<Ogre::Real>(0.7 * (1.0 - std::clamp(height, 0.0, 1.0))), 1.0f, 1.0f);
  return color;
}
}  // namespace

Ogre::Vector3 toOgre(const Eigen::Vector3d& vector) {
  return Ogre::Vector3(static_cast<Ogre::Real>(vector.x()), static_cast<Ogre::Real>(vector.y()),
                       static_cast<Ogre::Real>(vector.z()));
}

Ogre::Quaternion toOgre(const Eigen::Quaterniond& quaternion) {
  return Ogre::Quaternion(static_cast<Ogre::Real>(quaternion.w()), static_cast<Ogre::Real>(quaternion.x()),
                          static_cast<Ogre::Real>(quaternion.y()), static_cast<Ogre::Real>(quaternion.z()));
}

void place(Ogre::SceneNode* node, const Eigen::Isometry3d& pose) {
  node->setPosition(toOgre(pose.translation()));
  node->setOrientation(toOgre(Eigen::Quaterniond(pose.linear())));
}

ShapeView::ShapeView(const shapes::Shape& shape, const VoxelStyle& style, Ogre::SceneManager* scene_manager,
                     Ogre::SceneNode* parent)
    : scene_manager_(scene_manager), node_(parent->createChildSceneNode()) {
  make(shape, style);
}

void ShapeView::make(const shapes::Shape& shape, const VoxelStyle& style) {
  const auto make = [this](rviz::Shape::Type type, double x, double y, double z, bool upright) {
    shape_ = std::make_unique<rviz::Shape>(type, scene_manager_, node_);
    // RViz's cylinders and cones point along y.
    if (upright) shape_->setOrientation(Ogre::Quaternion(Ogre::Degree(90), Ogre::Vector3::UNIT_X));
    shape_->setScale(toOgre(upright ? Eigen::Vector3d(x, z, y) : Eigen::Vector3d(x, y, z)));
  };
  switch (shape.type) {
    case shapes::SPHERE: {
      const double d = 2.0 * static_cast<const shapes::Sphere&>(shape).radius;
      return make(rviz::Shape::Sphere, d, d, d, false);
    }
    case shapes::BOX: {
      const double* size = static_cast<const shapes::Box&>(shape).size;
      return make(rviz::Shape::Cube, size[0], size[1], size[2], false);
    }
    case shapes::CYLINDER: {
      const auto& cylinder = static_cast<const shapes::Cylinder&>(shape);
      return make(rviz::Shape::Cylinder, 2.0 * cylinder.radius, 2.0 * cylinder.radius, cylinder.length, true);
    }
    case shapes::CONE: {
      const auto& cone = static_cast<const shapes::Cone&>(shape);
      return make(rviz::Shape::Cone, 2.0 * cone.radius, 2.0 * cone.radius, cone.length, true);
    }
    case shapes::PLANE: {
      const auto& plane = static_cast<const shapes::Plane&>(shape);
      const Eigen::Vector3d normal(plane.a, plane.b, plane.c);
      make(rviz::Shape::Cube, PLANE_EDGE, PLANE_EDGE, PLANE_THICKNESS, false);
      if (normal.norm() < 1e-9) return;
      shape_->setPosition(toOgre(-plane.d * normal / normal.squaredNorm()));
      shape_->setOrientation(Ogre::Vector3::UNIT_Z.getRotationTo(toOgre(normal)));
      return;
    }
    case shapes::MESH: return makeMesh(static_cast<const shapes::Mesh&>(shape));
    case shapes::OCTREE:
      if (const auto& tree = static_cast<const shapes::OcTree&>(shape).octree) makeVoxels(*tree, style);
      return;
    default: return;
  }
}

ShapeView::~ShapeView() {
  shape_.reset();
  node_->detachAllObjects();
  clouds_.clear();
  scene_manager_->destroySceneNode(node_);
}

void ShapeView::setPose(const Eigen::Isometry3d& pose) { place(node_, pose); }

void ShapeView::setColor(const Ogre::ColourValue& color) {
  if (shape_) shape_->setColor(color.r, color.g, color.b, color.a);
  for (const auto& cloud : clouds_) cloud->setAlpha(color.a);
}

void ShapeView::makeMesh(const shapes::Mesh& mesh) {
  if (mesh.triangle_count == 0) return;
  auto view = std::make_unique<rviz::MeshShape>(scene_manager_, node_);
  view->estimateVertexCount(3 * mesh.triangle_count);
  view->beginTriangles();
  // Each triangle has corners of its own, so that edges stay sharp.
  for (unsigned int t = 0; t < mesh.triangle_count; ++t) {
    Eigen::Vector3d corner[3];
    for (int i = 0; i < 3; ++i) corner[i] = Eigen::Map<const Eigen::Vector3d>(mesh.vertices + 3 * mesh.triangles[3 * t + i]);
    const Eigen::Vector3d normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized();
    for (const Eigen::Vector3d& point : corner) view->addVertex(toOgre(point), toOgre(normal));
    view->addTriangle(3 * t, 3 * t + 1, 3 * t + 2);
  }
  view->endTriangles();
  shape_ = std::move(view);
}

// One cloud of boxes for each size of voxel. Voxels between six others of their kind cannot be seen and are left out.
void ShapeView::makeVoxels(const octomap::OcTree& tree, const VoxelStyle& style) {
  std::map<double, std::vector<rviz::PointCloud::Point>> by_size;
  double x, y, low, high;
  tree.getMetricMin(x, y, low);
  tree.getMetricMax(x, y, high);
  const int wanted = static_cast<int>(style.rendering);
  const auto kind = [&tree](const octomap::OcTreeNode& node) { return tree.isNodeOccupied(node) ? 1 : 2; };
  for (auto leaf = tree.begin_leafs(), end = tree.end_leafs(); leaf != end; ++leaf) {
    if (!(kind(*leaf) & wanted)) continue;
    const octomap::point3d centre = leaf.getCoordinate();
    const double size = leaf.getSize();
    bool seen = size > 1.5 * tree.getResolution();
    for (int side = 0; side < 6 && !seen; ++side) {
      octomap::point3d beside = centre;
      beside(side / 2) += static_cast<float>(side % 2 ? size : -size);
      const octomap::OcTreeNode* node = tree.search(beside);
      seen = !node || !(kind(*node) & wanted);
    }
    if (!seen) continue;
    rviz::PointCloud::Point point;
    point.position = Ogre::Vector3(centre.x(), centre.y(), centre.z());
    const double p = leaf->getOccupancy();
    point.color = style.coloring == VoxelColoring::ZAxis
                      ? rainbow(high > low ? (centre.z() - low) / (high - low) : 0.0)
                      : Ogre::ColourValue(static_cast<float>(1.0 - p), static_cast<float>(p), 0.0f);
    by_size[size].push_back(point);
  }
  for (auto& item : by_size) {
    auto cloud = std::make_unique<rviz::PointCloud>();
    cloud->setRenderMode(rviz::PointCloud::RM_BOXES);
    const float size = static_cast<float>(item.first);
    cloud->setDimensions(size, size, size);
    cloud->addPoints(item.second.data(), static_cast<uint32_t>(item.second.size()));
    node_->attachObject(cloud.get());
    clouds_.push_back(std::move(cloud));
  }
}

}  // namespace moveit_rviz_plugin
