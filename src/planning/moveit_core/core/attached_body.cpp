#include <moveit/robot_state/attached_body.h>

#include <geometric_shapes/shapes.h>

#include "frames.hpp"
#include "motion/robot_state.hpp"
#include "shapes.hpp"

namespace moveit
{
namespace core
{
AttachedBody::AttachedBody(const LinkModel* parent, const std::string& id, const Eigen::Isometry3d& pose,
                           const std::vector<shapes::ShapeConstPtr>& shapes, const EigenSTL::vector_Isometry3d& shape_poses,
                           const std::set<std::string>& touch_links, const trajectory_msgs::JointTrajectory& detach_posture,
                           const FixedTransformsMap& subframe_poses)
  : parent_link_model_(parent)
  , id_(id)
  , pose_(pose)
  , shapes_(shapes)
  , shape_poses_(shape_poses)
  , touch_links_(touch_links)
  , detach_posture_(detach_posture)
  , subframe_poses_(subframe_poses)
{
  makeCore();
}

AttachedBody::AttachedBody(const LinkModel* parent, const std::shared_ptr<const motion::AttachedBody>& core,
                           const motion::RobotState* owner)
  : core_(core)
  , owner_(owner)
  , parent_link_model_(parent)
  , id_(core->id)
  , pose_(core->pose)
  , touch_links_(core->touch_links)
{
  for (const motion::ShapePtr& shape : core->shapes)
    shapes_.push_back(toShape(shape));
  shape_poses_.assign(core->shape_poses.begin(), core->shape_poses.end());
  subframe_poses_.insert(core->subframes.begin(), core->subframes.end());
  if (const auto* posture = std::any_cast<trajectory_msgs::JointTrajectory>(&core->posture))
    detach_posture_ = *posture;
  for (const Eigen::Isometry3d& shape_pose : shape_poses_)
    shape_poses_in_link_frame_.push_back(pose_ * shape_pose);
  for (const auto& frame : subframe_poses_)
    subframe_poses_in_link_[frame.first] = pose_ * frame.second;
}

AttachedBody::AttachedBody(const AttachedBody& other, const motion::RobotState* owner) : AttachedBody(other) { owner_ = owner; }

AttachedBody::~AttachedBody() = default;

void AttachedBody::makeCore()
{
  auto core = std::make_shared<motion::AttachedBody>();
  core->id = id_;
  core->link = parent_link_model_->getName();
  core->pose = pose_;
  for (const shapes::ShapeConstPtr& shape : shapes_)
    core->shapes.push_back(fromShape(shape));
  core->shape_poses.assign(shape_poses_.begin(), shape_poses_.end());
  core->shape_poses.resize(core->shapes.size(), frames::IDENTITY);
  core->subframes.insert(subframe_poses_.begin(), subframe_poses_.end());
  core->touch_links = touch_links_;
  core->posture = detach_posture_;
  core_ = core;
  shape_poses_in_link_frame_.clear();
  for (const Eigen::Isometry3d& shape_pose : shape_poses_)
    shape_poses_in_link_frame_.push_back(pose_ * shape_pose);
  subframe_poses_in_link_.clear();
  for (const auto& frame : subframe_poses_)
    subframe_poses_in_link_[frame.first] = pose_ * frame.second;
  placed_ = false;
}

void AttachedBody::setSubframeTransforms(const FixedTransformsMap& subframe_poses)
{
  subframe_poses_ = subframe_poses;
  makeCore();
}

void AttachedBody::setPadding(double padding)
{
  for (shapes::ShapeConstPtr& shape : shapes_)
  {
    const std::shared_ptr<shapes::Shape> copy(shape->clone());
    copy->padd(padding);
    shape = copy;
  }
  makeCore();
}

void AttachedBody::setScale(double scale)
{
  for (shapes::ShapeConstPtr& shape : shapes_)
  {
    const std::shared_ptr<shapes::Shape> copy(shape->clone());
    copy->scale(scale);
    shape = copy;
  }
  makeCore();
}

// ---------------------------------------------------------------- where it is

void AttachedBody::computeTransform(const Eigen::Isometry3d& parent_link_global_transform)
{
  place(parent_link_global_transform);
}

void AttachedBody::place(const Eigen::Isometry3d& link) const
{
  link_pose_ = link;
  placed_ = true;
  global_pose_ = link * pose_;
  global_collision_body_transforms_.clear();
  for (const Eigen::Isometry3d& shape_pose : shape_poses_in_link_frame_)
    global_collision_body_transforms_.push_back(link * shape_pose);
  global_subframe_poses_.clear();
  for (const auto& frame : subframe_poses_in_link_)
    global_subframe_poses_[frame.first] = link * frame.second;
}

void AttachedBody::refresh() const
{
  const Eigen::Isometry3d& link = owner_ ? owner_->linkPose(parent_link_model_->getLinkIndex()) : frames::IDENTITY;
  if (!placed_ || (owner_ && link.matrix() != link_pose_.matrix()))
    place(link);
}

const Eigen::Isometry3d& AttachedBody::getGlobalPose() const
{
  refresh();
  return global_pose_;
}

const EigenSTL::vector_Isometry3d& AttachedBody::getGlobalCollisionBodyTransforms() const
{
  refresh();
  return global_collision_body_transforms_;
}

const FixedTransformsMap& AttachedBody::getGlobalSubframeTransforms() const
{
  refresh();
  return global_subframe_poses_;
}

namespace
{
const Eigen::Isometry3d& subframe(const FixedTransformsMap& frames, const std::string& id, const std::string& name, bool* found)
{
  const std::string prefix = id + "/";
  auto at = frames.find(name.compare(0, prefix.size(), prefix) == 0 ? name.substr(prefix.size()) : name);
  if (found)
    *found = at != frames.end();
  return at == frames.end() ? frames::IDENTITY : at->second;
}
}  // namespace

const Eigen::Isometry3d& AttachedBody::getSubframeTransform(const std::string& frame_name, bool* found) const
{
  return subframe(subframe_poses_in_link_, id_, frame_name, found);
}

const Eigen::Isometry3d& AttachedBody::getGlobalSubframeTransform(const std::string& frame_name, bool* found) const
{
  refresh();
  return subframe(global_subframe_poses_, id_, frame_name, found);
}

bool AttachedBody::hasSubframeTransform(const std::string& frame_name) const
{
  bool found = false;
  getSubframeTransform(frame_name, &found);
  return found;
}
}  // namespace core
}  // namespace moveit
