// States: poses, frames, and what the robot carries.
#include <moveit/robot_state/robot_state.h>

#include "frames.hpp"
#include "log_names.hpp"
#include "motion/robot_state.hpp"

namespace moveit
{
namespace core
{
// ---------------------------------------------------------------- poses

void RobotState::update(bool force)
{
  if (force)
    core_->writePositions();
  core_->linkPoses();
}

const Eigen::Isometry3d& RobotState::getGlobalLinkTransform(const LinkModel* link) const
{
  if (!link)
    throw Exception("Invalid link");
  return core_->linkPose(link->getLinkIndex());
}

const Eigen::Isometry3d& RobotState::getCollisionBodyTransform(const LinkModel* link, std::size_t index) const
{
  collision_transforms_.resize(robot_model_->getLinkGeometryCount());
  Eigen::Isometry3d& pose = collision_transforms_.at(link->getFirstCollisionBodyTransformIndex() + index);
  pose = getGlobalLinkTransform(link) * link->getCollisionOriginTransforms()[index];
  return pose;
}

const Eigen::Isometry3d& RobotState::getJointTransform(const JointModel* joint) const
{
  joint_transforms_.resize(robot_model_->getJointModelCount());
  Eigen::Isometry3d& transform = joint_transforms_[joint->getJointIndex()];
  joint->computeTransform(getJointPositions(joint), transform);
  return transform;
}

void RobotState::updateStateWithLinkAt(const LinkModel* link, const Eigen::Isometry3d& transform, bool backward)
{
  core_->placeLink(link->getLinkIndex(), transform, backward);
}

const Eigen::Isometry3d& RobotState::getFrameInfo(const std::string& frame_id, const LinkModel*& robot_link,
                                                  bool& frame_found) const
{
  const std::string name = frames::withoutSlash(frame_id);
  frame_found = true;
  robot_link = nullptr;
  if (name == robot_model_->getModelFrame())
  {
    bool is_link = false;
    robot_link = robot_model_->getLinkModel(name, &is_link);
    if (!is_link)
      robot_link = robot_model_->getRootLink();
    return frames::IDENTITY;
  }
  bool is_link = false;
  robot_link = robot_model_->getLinkModel(name, &is_link);
  if (is_link)
    return getGlobalLinkTransform(robot_link);
  motion::Transform in_link;
  const int carrier = core_->frameLink(name, in_link);
  if (carrier >= 0)
  {
    robot_link = robot_model_->getLinkModel(carrier);
    const auto body = bodies_.find(name);
    if (body != bodies_.end())
      return body->second->getGlobalPose();
    for (const auto& item : bodies_)
      if (name.compare(0, item.first.size() + 1, item.first + "/") == 0 && item.second->hasSubframeTransform(name))
        return item.second->getGlobalSubframeTransform(name);
  }
  robot_link = nullptr;
  frame_found = false;
  return frames::IDENTITY;
}

const Eigen::Isometry3d& RobotState::getFrameTransform(const std::string& frame_id, bool* frame_found) const
{
  const LinkModel* link;
  bool found;
  const Eigen::Isometry3d& pose = getFrameInfo(frame_id, link, found);
  if (frame_found)
    *frame_found = found;
  else if (!found)
    ROS_WARN_NAMED(log_names::ROBOT_STATE, "getFrameTransform() did not find a frame with name %s.", frame_id.c_str());
  return pose;
}

bool RobotState::knowsFrameTransform(const std::string& frame_id) const
{
  motion::Transform unused;
  return core_->frameLink(frames::withoutSlash(frame_id), unused) >= 0;
}

const LinkModel* RobotState::getRigidlyConnectedParentLinkModel(const std::string& frame, Eigen::Isometry3d* transform,
                                                                const JointModelGroup* jmg) const
{
  motion::Transform in_link;
  const int carrier = core_->frameLink(frames::withoutSlash(frame), in_link);
  if (carrier < 0)
    return nullptr;
  Eigen::Isometry3d of_link;
  const LinkModel* parent = RobotModel::getRigidlyConnectedParentLinkModel(robot_model_->getLinkModel(carrier), of_link, jmg);
  if (transform)
    *transform = of_link * in_link;
  return parent;
}

// ---------------------------------------------------------------- what it carries

void RobotState::attachBody(std::unique_ptr<AttachedBody> attached_body)
{
  attached_body->owner_ = core_.get();
  attached_body->placed_ = false;
  core_->attach(attached_body->core());
  if (attached_body_update_callback_)
    attached_body_update_callback_(attached_body.get(), true);
  bodies_[attached_body->getName()] = std::move(attached_body);
}

void RobotState::attachBody(const std::string& id, const Eigen::Isometry3d& pose,
                            const std::vector<shapes::ShapeConstPtr>& shapes, const EigenSTL::vector_Isometry3d& shape_poses,
                            const std::set<std::string>& touch_links, const std::string& link_name,
                            const trajectory_msgs::JointTrajectory& detach_posture, const FixedTransformsMap& subframe_poses)
{
  const LinkModel* link = robot_model_->getLinkModel(link_name);
  if (!link)
    return;
  attachBody(std::unique_ptr<AttachedBody>(
      new AttachedBody(link, id, pose, shapes, shape_poses, touch_links, detach_posture, subframe_poses)));
}

void RobotState::getAttachedBodies(std::vector<const AttachedBody*>& attached_bodies) const
{
  attached_bodies.clear();
  for (const auto& body : bodies_)
    attached_bodies.push_back(body.second.get());
}

void RobotState::getAttachedBodies(std::vector<const AttachedBody*>& attached_bodies, const JointModelGroup* group) const
{
  attached_bodies.clear();
  for (const auto& body : bodies_)
    if (group->hasLinkModel(body.second->getAttachedLinkName()))
      attached_bodies.push_back(body.second.get());
}

void RobotState::getAttachedBodies(std::vector<const AttachedBody*>& attached_bodies, const LinkModel* link_model) const
{
  attached_bodies.clear();
  for (const auto& body : bodies_)
    if (body.second->getAttachedLink() == link_model)
      attached_bodies.push_back(body.second.get());
}

bool RobotState::clearAttachedBody(const std::string& id)
{
  const auto found = bodies_.find(id);
  if (found == bodies_.end())
    return false;
  if (attached_body_update_callback_)
    attached_body_update_callback_(found->second.get(), false);
  core_->detach(id);
  bodies_.erase(found);
  return true;
}

void RobotState::clearAttachedBodies(const LinkModel* link)
{
  std::vector<const AttachedBody*> bodies;
  getAttachedBodies(bodies, link);
  for (const AttachedBody* body : bodies)
    clearAttachedBody(std::string(body->getName()));
}

void RobotState::clearAttachedBodies(const JointModelGroup* group)
{
  std::vector<const AttachedBody*> bodies;
  getAttachedBodies(bodies, group);
  for (const AttachedBody* body : bodies)
    clearAttachedBody(std::string(body->getName()));
}

void RobotState::clearAttachedBodies()
{
  while (!bodies_.empty())
    clearAttachedBody(std::string(bodies_.begin()->first));
}

const AttachedBody* RobotState::getAttachedBody(const std::string& name) const
{
  const auto found = bodies_.find(name);
  if (found != bodies_.end())
    return found->second.get();
  ROS_ERROR_NAMED(log_names::ROBOT_STATE, "Attached body '%s' not found", name.c_str());
  return nullptr;
}

bool haveSameAttachedObjects(const RobotState& left, const RobotState& right, const std::string& logprefix)
{
  std::vector<const AttachedBody*> a, b;
  left.getAttachedBodies(a);
  right.getAttachedBodies(b);
  auto differ = [&](const std::string& what) {
    if (!logprefix.empty())
      ROS_DEBUG_STREAM(logprefix << what);
    return false;
  };
  if (a.size() != b.size())
    return differ("different number of objects");
  for (const AttachedBody* body : a)
  {
    if (!right.hasAttachedBody(body->getName()))
      return differ("object missing: " + body->getName());
    const AttachedBody* other = right.getAttachedBody(body->getName());
    if (body->getAttachedLink() != other->getAttachedLink())
      return differ("different attach links: " + body->getName());
    if (body->getShapes().size() != other->getShapes().size())
      return differ("different object shapes: " + body->getName());
    if (!body->getPose().isApprox(other->getPose(), 1e-4))
      return differ("different pose of attached object: " + body->getName());
  }
  return true;
}
}  // namespace core
}  // namespace moveit
