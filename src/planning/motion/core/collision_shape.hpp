// Shapes in FCL's terms, and boxes around them.
#pragma once

#include <fcl/geometry/collision_geometry.h>

#include "motion/shapes.hpp"
#include "support.hpp"

namespace motion
{
struct CollisionShape
{
  ShapePtr shape;  // as given; kept so that the cache's key stays valid
  std::shared_ptr<fcl::CollisionGeometryd> geometry;
  std::shared_ptr<const MeshParts> parts;  // of a mesh
  Vector3 centre = Vector3::Zero(), half = Vector3::Zero();
  bool unbounded = false;
};
using CollisionShapePtr = std::shared_ptr<const CollisionShape>;

// Equal requests give the same object while somebody holds it.
CollisionShapePtr collisionShape(const ShapePtr& shape, double scale, double padding);

struct Aabb
{
  Vector3 low, high;

  bool overlaps(const Aabb& other) const
  {
    return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
  }
  // Distance between the two boxes, m.
  double distance(const Aabb& other) const { return (low - other.high).cwiseMax(other.low - high).cwiseMax(0.0).norm(); }
  void extend(const Aabb& other)
  {
    low = low.cwiseMin(other.low);
    high = high.cwiseMax(other.high);
  }
};

inline Aabb boundsOf(const CollisionShape& shape, const Transform& pose)
{
  if (shape.unbounded)
  {
    const Vector3 everywhere = Vector3::Constant(1e30);
    return {-everywhere, everywhere};
  }
  const Vector3 centre = pose * shape.centre, half = pose.linear().cwiseAbs() * shape.half;
  return {centre - half, centre + half};
}

// The widest gap between the shadows of two boxes on the axes of both, m; once it is more than `enough` on those of the first, it is that.
// `turn`: of the second one's axes in the first one's, `size` its absolute values; `off`: from middle to middle; `a`, `b`: half edges.
inline double gapByFaces(const Eigen::Matrix3d& turn, const Eigen::Matrix3d& size, const Vector3& off, const Vector3& a,
                         const Vector3& b, double enough)
{
  const double gap = (off.cwiseAbs() - a - size * b).maxCoeff();
  return gap > enough ? gap : std::max(gap, ((turn.transpose() * off).cwiseAbs() - b - size.transpose() * a).maxCoeff());
}

// A lower bound of the distance of two shapes, m, by the boxes that turn with them: the widest gap between their shadows on the axes of
// both boxes and on those at right angles to one of each (Gottschalk, Lin and Manocha, OBBTree, 1996). Not positive where none is known.
double gapOfBoxes(const CollisionShape& a, const Transform& at_a, const CollisionShape& b, const Transform& at_b);

// Boxes that stay where they are, in a binary tree.
class AabbTree
{
public:
  void build(const std::vector<Aabb>& boxes);
  // Calls visit(index) for each box that overlaps; stops when it returns true.
  template <typename Visit>
  bool query(const Aabb& box, Visit&& visit) const
  {
    if (nodes_.empty())
      return false;
    int stack[64], top = 0;
    stack[top++] = 0;
    while (top)
    {
      const Node& node = nodes_[stack[--top]];
      if (!node.box.overlaps(box))
        continue;
      if (node.item >= 0)
      {
        if (visit(node.item))
          return true;
      }
      else
      {
        stack[top++] = node.left;
        stack[top++] = node.right;
      }
    }
    return false;
  }

private:
  struct Node
  {
    Aabb box;
    int left = -1, right = -1, item = -1;
  };
  int split(std::vector<int>& items, int first, int last, const std::vector<Aabb>& boxes);
  std::vector<Node> nodes_;
};
}  // namespace motion
