#pragma once

#include <Eigen/Geometry>

namespace moveit
{
namespace core
{
// A box along the axes that grows over what it is given.
class AABB : public Eigen::AlignedBox3d
{
public:
  // A box of these edges, its centre at the transform's origin.
  void extendWithTransformedBox(const Eigen::Isometry3d& transform, const Eigen::Vector3d& box);
};
}  // namespace core
}  // namespace moveit
