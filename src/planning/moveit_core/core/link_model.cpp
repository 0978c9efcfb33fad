#include <moveit/robot_model/aabb.h>
#include <moveit/robot_model/link_model.h>

#include "motion/robot_model.hpp"
#include "shapes.hpp"

template void Eigen::Isometry3d::computeRotationScaling(Eigen::Matrix3d*, Eigen::Matrix3d*) const;

namespace moveit
{
namespace core
{
namespace
{
bool isIdentity(const Eigen::Isometry3d& t)
{
  return t.linear().isIdentity() && t.translation().norm() < std::numeric_limits<double>::epsilon();
}
}  // namespace

LinkModel::LinkModel(const motion::LinkModel& core) : core_(&core), name_(core.name), link_index_(core.index)
{
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < core.shapes.size(); ++i)
  {
    const Eigen::Isometry3d& origin = core.shape_origins[i];
    collision_origin_transform_.push_back(origin);
    collision_origin_transform_is_identity_.push_back(isIdentity(origin) ? 1 : 0);
    motion::Vector3 centre, half;
    if (motion::localBounds(*core.shapes[i], centre, half))
    {
      AABB part;
      part.extendWithTransformedBox(origin * Eigen::Translation3d(centre), 2 * half);
      box.extend(part);
    }
  }
  if (!box.isEmpty())
  {
    shape_extents_ = box.sizes();
    centered_bounding_box_offset_ = box.center();
  }
}

LinkModel::~LinkModel() = default;

const std::vector<shapes::ShapeConstPtr>& LinkModel::getShapes() const
{
  std::call_once(shapes_made_, [this]() {
    for (const motion::ShapePtr& shape : core_->shapes)
      shapes_.push_back(toShape(shape));
  });
  return shapes_;
}

void LinkModel::setVisualMesh(const std::string& visual_mesh, const Eigen::Isometry3d& origin, const Eigen::Vector3d& scale)
{
  visual_mesh_filename_ = visual_mesh;
  visual_mesh_origin_ = origin;
  visual_mesh_scale_ = scale;
}

void AABB::extendWithTransformedBox(const Eigen::Isometry3d& transform, const Eigen::Vector3d& box)
{
  const Eigen::Vector3d half = 0.5 * (transform.linear().cwiseAbs() * box);
  extend(Eigen::Vector3d(transform.translation() - half));
  extend(Eigen::Vector3d(transform.translation() + half));
}
}  // namespace core
}  // namespace moveit
