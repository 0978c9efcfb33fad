// A link of a robot, with the shapes that collide.
#pragma once

#include <eigen_stl_containers/eigen_stl_vector_container.h>
#include <geometric_shapes/check_isometry.h>

#include <Eigen/Geometry>
#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include <moveit/macros/class_forward.h>

// What check_isometry.h calls is compiled once, in this library, not in each file that includes it: seconds each.
extern template void Eigen::Isometry3d::computeRotationScaling(Eigen::Matrix3d*, Eigen::Matrix3d*) const;

namespace shapes
{
MOVEIT_CLASS_FORWARD(Shape);
}

namespace motion
{
struct LinkModel;
}

namespace moveit
{
namespace core
{
class JointModel;
class LinkModel;

typedef std::map<std::string, LinkModel*> LinkModelMap;
using LinkModelMapConst = std::map<std::string, const LinkModel*>;
using LinkTransformMap = std::map<const LinkModel*, Eigen::Isometry3d, std::less<const LinkModel*>,
                                  Eigen::aligned_allocator<std::pair<const LinkModel* const, Eigen::Isometry3d>>>;

// Made by RobotModel alone.
class LinkModel
{
public:
  EIGEN_MAKE_ALIGNED_OPERATOR_NEW

  ~LinkModel();
  LinkModel(const LinkModel&) = delete;
  LinkModel& operator=(const LinkModel&) = delete;

  const std::string& getName() const { return name_; }
  int getLinkIndex() const { return link_index_; }
  // Index of the first of its shapes among those of all links.
  int getFirstCollisionBodyTransformIndex() const { return first_collision_body_transform_index_; }
  const JointModel* getParentJointModel() const { return parent_joint_model_; }
  const LinkModel* getParentLinkModel() const { return parent_link_model_; }
  const std::vector<const JointModel*>& getChildJointModels() const { return child_joint_models_; }
  bool parentJointIsFixed() const { return is_parent_joint_fixed_; }
  // Of the parent joint in the parent link.
  const Eigen::Isometry3d& getJointOriginTransform() const { return joint_origin_transform_; }
  bool jointOriginTransformIsIdentity() const { return joint_origin_transform_is_identity_; }

  const EigenSTL::vector_Isometry3d& getCollisionOriginTransforms() const { return collision_origin_transform_; }
  const std::vector<int>& areCollisionOriginTransformsIdentity() const { return collision_origin_transform_is_identity_; }
  const std::vector<shapes::ShapeConstPtr>& getShapes() const;
  // Edges of the box around all shapes, and its centre, in the link's frame.
  const Eigen::Vector3d& getShapeExtentsAtOrigin() const { return shape_extents_; }
  const Eigen::Vector3d& getCenteredBoundingBoxOffset() const { return centered_bounding_box_offset_; }
  // Links that fixed joints bolt to this one, and their poses in it.
  const LinkTransformMap& getAssociatedFixedTransforms() const { return associated_fixed_transforms_; }

  const std::string& getVisualMeshFilename() const { return visual_mesh_filename_; }
  const Eigen::Vector3d& getVisualMeshScale() const { return visual_mesh_scale_; }
  const Eigen::Isometry3d& getVisualMeshOrigin() const { return visual_mesh_origin_; }
  void setVisualMesh(const std::string& visual_mesh, const Eigen::Isometry3d& origin, const Eigen::Vector3d& scale);

private:
  friend class RobotModel;
  explicit LinkModel(const motion::LinkModel& core);

  const motion::LinkModel* core_;
  std::string name_;
  const JointModel* parent_joint_model_ = nullptr;
  const LinkModel* parent_link_model_ = nullptr;
  std::vector<const JointModel*> child_joint_models_;
  bool is_parent_joint_fixed_ = false, joint_origin_transform_is_identity_ = true;
  Eigen::Isometry3d joint_origin_transform_ = Eigen::Isometry3d::Identity();
  EigenSTL::vector_Isometry3d collision_origin_transform_;
  std::vector<int> collision_origin_transform_is_identity_;
  LinkTransformMap associated_fixed_transforms_;
  mutable std::once_flag shapes_made_;  // meshes are copied for those who ask only
  mutable std::vector<shapes::ShapeConstPtr> shapes_;
  Eigen::Vector3d shape_extents_ = Eigen::Vector3d::Zero(), centered_bounding_box_offset_ = Eigen::Vector3d::Zero();
  std::string visual_mesh_filename_;
  Eigen::Isometry3d visual_mesh_origin_ = Eigen::Isometry3d::Identity();
  Eigen::Vector3d visual_mesh_scale_ = Eigen::Vector3d::Ones();
  int first_collision_body_transform_index_ = -1;
  int link_index_;
};
}  // namespace core
}  // namespace moveit
