// An object that a link carries.
#pragma once

#include <eigen_stl_containers/eigen_stl_containers.h>
#include <trajectory_msgs/JointTrajectory.h>

#include <boost/function.hpp>
#include <set>

#include <moveit/robot_model/link_model.h>
#include <moveit/transforms/transforms.h>

namespace motion
{
struct AttachedBody;
class RobotState;
}  // namespace motion

namespace moveit
{
namespace core
{
class AttachedBody;
typedef boost::function<void(AttachedBody* body, bool attached)> AttachedBodyCallback;

class AttachedBody
{
public:
  EIGEN_MAKE_ALIGNED_OPERATOR_NEW

  // `pose`: of the object in the link; `shape_poses` and `subframe_poses` in the object.
  AttachedBody(const LinkModel* parent, const std::string& id, const Eigen::Isometry3d& pose,
               const std::vector<shapes::ShapeConstPtr>& shapes, const EigenSTL::vector_Isometry3d& shape_poses,
               const std::set<std::string>& touch_links, const trajectory_msgs::JointTrajectory& detach_posture,
               const FixedTransformsMap& subframe_poses = FixedTransformsMap());
  ~AttachedBody();

  const std::string& getName() const { return id_; }
  const std::string& getAttachedLinkName() const { return parent_link_model_->getName(); }
  const LinkModel* getAttachedLink() const { return parent_link_model_; }
  const std::vector<shapes::ShapeConstPtr>& getShapes() const { return shapes_; }
  const std::set<std::string>& getTouchLinks() const { return touch_links_; }
  const trajectory_msgs::JointTrajectory& getDetachPosture() const { return detach_posture_; }

  const Eigen::Isometry3d& getPose() const { return pose_; }
  const EigenSTL::vector_Isometry3d& getShapePoses() const { return shape_poses_; }
  const EigenSTL::vector_Isometry3d& getShapePosesInLinkFrame() const { return shape_poses_in_link_frame_; }
  const EigenSTL::vector_Isometry3d& getFixedTransforms() const { return shape_poses_in_link_frame_; }
  // In the model frame, as the state stands that the body belongs to.
  const Eigen::Isometry3d& getGlobalPose() const;
  const EigenSTL::vector_Isometry3d& getGlobalCollisionBodyTransforms() const;

  const FixedTransformsMap& getSubframes() const { return subframe_poses_; }
  const FixedTransformsMap& getGlobalSubframeTransforms() const;
  void setSubframeTransforms(const FixedTransformsMap& subframe_poses);
  // In the link and in the model frame; the identity when there is none of that name ("body/subframe").
  const Eigen::Isometry3d& getSubframeTransform(const std::string& frame_name, bool* found = nullptr) const;
  const Eigen::Isometry3d& getGlobalSubframeTransform(const std::string& frame_name, bool* found = nullptr) const;
  bool hasSubframeTransform(const std::string& frame_name) const;

  void setPadding(double padding);
  void setScale(double scale);
  void computeTransform(const Eigen::Isometry3d& parent_link_global_transform);

  const std::shared_ptr<const motion::AttachedBody>& core() const { return core_; }

private:
  friend class RobotState;
  AttachedBody(const AttachedBody& other, const motion::RobotState* owner);
  AttachedBody(const LinkModel* parent, const std::shared_ptr<const motion::AttachedBody>& core,
               const motion::RobotState* owner);
  void makeCore();
  void refresh() const;
  void place(const Eigen::Isometry3d& link) const;

  std::shared_ptr<const motion::AttachedBody> core_;
  const motion::RobotState* owner_ = nullptr;
  const LinkModel* parent_link_model_;
  std::string id_;
  Eigen::Isometry3d pose_;
  std::vector<shapes::ShapeConstPtr> shapes_;
  EigenSTL::vector_Isometry3d shape_poses_, shape_poses_in_link_frame_;
  std::set<std::string> touch_links_;
  trajectory_msgs::JointTrajectory detach_posture_;
  FixedTransformsMap subframe_poses_, subframe_poses_in_link_;

  // What follows from the pose of the link.
  mutable bool placed_ = false;
  mutable Eigen::Isometry3d link_pose_, global_pose_;
  mutable EigenSTL::vector_Isometry3d global_collision_body_transforms_;
  mutable FixedTransformsMap global_subframe_poses_;
};
}  // namespace core
}  // namespace moveit
