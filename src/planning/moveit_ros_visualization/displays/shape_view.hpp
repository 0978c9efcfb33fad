// Shapes of a planning scene as RViz draws them.
#pragma once

#include <geometric_shapes/shapes.h>

#include <Eigen/Geometry>
#include <OgreColourValue.h>
#include <OgreQuaternion.h>
#include <memory>
#include <rviz/ogre_helpers/ogre_vector.h>
#include <vector>

namespace Ogre {
class SceneManager;
class SceneNode;
}  // namespace Ogre
namespace rviz {
class PointCloud;
class Shape;
}  // namespace rviz
namespace octomap {
class OcTree;
}

namespace moveit_rviz_plugin {

Ogre::Vector3 toOgre(const Eigen::Vector3d& vector);
Ogre::Quaternion toOgre(const Eigen::Quaterniond& quaternion);
void place(Ogre::SceneNode* node, const Eigen::Isometry3d& pose);

enum class VoxelRendering { Occupied = 1, Free = 2, All = 3 };
enum class VoxelColoring { ZAxis, Probability };
struct VoxelStyle {
  VoxelRendering rendering = VoxelRendering::Occupied;
  VoxelColoring coloring = VoxelColoring::ZAxis;
  bool operator==(const VoxelStyle& other) const { return rendering == other.rendering && coloring == other.coloring; }
};

// One shape below a scene node.
class ShapeView {
 public:
  ShapeView(const shapes::Shape& shape, const VoxelStyle& style, Ogre::SceneManager* scene_manager, Ogre::SceneNode* parent);
  ~ShapeView();
  ShapeView(const ShapeView&) = delete;
  ShapeView& operator=(const ShapeView&) = delete;

  // In the frame of the node; colours of voxels are their own, their alpha is that of the colour.
  void setPose(const Eigen::Isometry3d& pose);
  void setColor(const Ogre::ColourValue& color);

 private:
  void make(const shapes::Shape& shape, const VoxelStyle& style);
  void makeMesh(const shapes::Mesh& mesh);
  void makeVoxels(const octomap::OcTree& tree, const VoxelStyle& style);

  Ogre::SceneManager* scene_manager_;
  Ogre::SceneNode* node_;
  std::unique_ptr<rviz::Shape> shape_;
  std::vector<std::unique_ptr<rviz::PointCloud>> clouds_;
};

}  // namespace moveit_rviz_plugin
