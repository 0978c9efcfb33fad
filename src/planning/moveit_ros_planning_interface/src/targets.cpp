// Where to go: joint values, poses, names.
#include "impl.h"

#include <algorithm>

#include <tf2_eigen/tf2_eigen.h>
#include <tf2_geometry_msgs/tf2_geometry_msgs.h>

namespace moveit {
namespace planning_interface {

bool MoveGroupInterface::setJointValueTarget(const std::vector<double>& values) {
  if (values.size() != getVariableCount()) {
    ROS_ERROR_STREAM_NAMED(LOGNAME, "Provided joint value list has length " << values.size() << " but group " << getName()
                                                                            << " has " << getVariableCount() << " joints");
    return false;
  }
  impl_->target = Impl::JOINT;
  impl_->joint_target->setJointGroupPositions(impl_->group, values);
  return impl_->joint_target->satisfiesBounds(impl_->group, impl_->joint_tolerance);
}

bool MoveGroupInterface::setJointValueTarget(const std::map<std::string, double>& variable_values) {
  std::vector<std::string> names;
  std::vector<double> values;
  for (const auto& [name, value] : variable_values) {
    names.push_back(name);
    values.push_back(value);
  }
  return setJointValueTarget(names, values);
}

bool MoveGroupInterface::setJointValueTarget(const std::vector<std::string>& variable_names,
                                             const std::vector<double>& variable_values) {
  if (variable_names.size() != variable_values.size()) {
    ROS_ERROR_STREAM_NAMED(LOGNAME, "sizes of name and position arrays do not match");
    return false;
  }
  const std::vector<std::string>& known = getVariableNames();
  for (const std::string& name : variable_names)
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      ROS_ERROR_STREAM_NAMED(LOGNAME, "joint variable " << name << " is not part of group " << getName());
      return false;
    }
  impl_->target = Impl::JOINT;
  impl_->joint_target->setVariablePositions(variable_names, variable_values);
  return impl_->joint_target->satisfiesBounds(impl_->joint_tolerance);
}

bool MoveGroupInterface::setJointValueTarget(const moveit::core::RobotState& robot_state) {
  impl_->target = Impl::JOINT;
  *impl_->joint_target = robot_state;
  return impl_->joint_target->satisfiesBounds(impl_->joint_tolerance);
}

bool MoveGroupInterface::setJointValueTarget(const std::string& joint_name, double value) {
  return setJointValueTarget(joint_name, std::vector<double>{value});
}

bool MoveGroupInterface::setJointValueTarget(const std::string& joint_name, const std::vector<double>& values) {
  impl_->target = Impl::JOINT;
  const moveit::core::JointModel* joint = impl_->group->getJointModel(joint_name);
  if (!joint || joint->getVariableCount() != values.size()) {
    ROS_ERROR_STREAM_NAMED(LOGNAME, "joint " << joint_name << " is not part of group " << getName());
    return false;
  }
  impl_->joint_target->setJointPositions(joint, values);
  return impl_->joint_target->satisfiesBounds(joint, impl_->joint_tolerance);
}

bool MoveGroupInterface::setJointValueTarget(const sensor_msgs::JointState& state) {
  return setJointValueTarget(state.name, state.position);
}

bool MoveGroupInterface::setTarget(const geometry_msgs::Pose& pose, const std::string& named, const std::string& frame,
                                   bool approximate) {
  const std::string& link = impl_->link(named);
  const moveit::core::RobotStatePtr start = link.empty() ? nullptr : impl_->startState();
  if (!start) return false;
  impl_->target = Impl::JOINT;
  start->enforceBounds();
  *impl_->joint_target = *start;
  Eigen::Isometry3d X_FE;
  tf2::fromMsg(pose, X_FE);
  Eigen::Isometry3d X_MF = Eigen::Isometry3d::Identity();
  if (!frame.empty() && !moveit::core::Transforms::sameFrame(frame, getPlanningFrame())) {
    bool found = false;
    X_MF = impl_->joint_target->getFrameTransform(frame, &found);
    if (!found) {
      try {
        X_MF = tf2::transformToEigen(impl_->tf_buffer->lookupTransform(getPlanningFrame(), frame, ros::Time(0)));
      } catch (const tf2::TransformException&) {
        ROS_ERROR_NAMED(LOGNAME, "Unable to transform from frame '%s' to frame '%s'", frame.c_str(),
                        getPlanningFrame().c_str());
        return false;
      }
    }
  }
  kinematics::KinematicsQueryOptions options;
  options.return_approximate_solution = approximate;
  return impl_->joint_target->setFromIK(impl_->group, Eigen::Isometry3d(X_MF * X_FE), link, 0.0,
                                        moveit::core::GroupStateValidityCallbackFn(), options);
}

bool MoveGroupInterface::setJointValueTarget(const geometry_msgs::Pose& pose, const std::string& link) {
  return setTarget(pose, link, "", false);
}
bool MoveGroupInterface::setJointValueTarget(const geometry_msgs::PoseStamped& pose, const std::string& link) {
  return setTarget(pose.pose, link, pose.header.frame_id, false);
}
bool MoveGroupInterface::setJointValueTarget(const Eigen::Isometry3d& pose, const std::string& link) {
  return setTarget(tf2::toMsg(pose), link, "", false);
}
bool MoveGroupInterface::setApproximateJointValueTarget(const geometry_msgs::Pose& pose, const std::string& link) {
  return setTarget(pose, link, "", true);
}
bool MoveGroupInterface::setApproximateJointValueTarget(const geometry_msgs::PoseStamped& pose, const std::string& link) {
  return setTarget(pose.pose, link, pose.header.frame_id, true);
}
bool MoveGroupInterface::setApproximateJointValueTarget(const Eigen::Isometry3d& pose, const std::string& link) {
  return setTarget(tf2::toMsg(pose), link, "", true);
}

void MoveGroupInterface::setRandomTarget() {
  impl_->joint_target->setToRandomPositions();
  impl_->target = Impl::JOINT;
}

bool MoveGroupInterface::setNamedTarget(const std::string& name) {
  const auto remembered = remembered_.find(name);
  if (remembered != remembered_.end()) return setJointValueTarget(remembered->second);
  if (impl_->joint_target->setToDefaultValues(impl_->group, name)) {
    impl_->target = Impl::JOINT;
    return true;
  }
  ROS_ERROR_NAMED(LOGNAME, "The requested named target '%s' does not exist", name.c_str());
  return false;
}

void MoveGroupInterface::getJointValueTarget(std::vector<double>& values) const {
  impl_->joint_target->copyJointGroupPositions(impl_->group, values);
}
const moveit::core::RobotState& MoveGroupInterface::getJointValueTarget() const { return *impl_->joint_target; }
const moveit::core::RobotState& MoveGroupInterface::getTargetRobotState() const { return *impl_->joint_target; }

void MoveGroupInterface::setStartState(const moveit_msgs::RobotState& start_state) { impl_->start_state = start_state; }
void MoveGroupInterface::setStartState(const moveit::core::RobotState& start_state) {
  impl_->start_state = moveit_msgs::RobotState();
  moveit::core::robotStateToRobotStateMsg(start_state, impl_->start_state, true);
}
void MoveGroupInterface::setStartStateToCurrentState() {
  impl_->start_state = moveit_msgs::RobotState();
  impl_->start_state.is_diff = true;
}

const std::string& MoveGroupInterface::getEndEffectorLink() const { return impl_->end_effector_link; }

const std::string& MoveGroupInterface::getEndEffector() const {
  static const std::string none;
  if (!impl_->end_effector_link.empty())
    for (const std::string& name : impl_->group->getAttachedEndEffectorNames())
      if (impl_->model->getEndEffector(name)->hasLinkModel(impl_->end_effector_link)) return name;
  return none;
}

bool MoveGroupInterface::setEndEffectorLink(const std::string& link_name) {
  if (impl_->end_effector_link.empty() || link_name.empty()) return false;
  impl_->end_effector_link = link_name;
  impl_->target = Impl::POSE;
  return true;
}

bool MoveGroupInterface::setEndEffector(const std::string& eef_name) {
  const moveit::core::JointModelGroup* end_effector = impl_->model->getEndEffector(eef_name);
  return end_effector && setEndEffectorLink(end_effector->getEndEffectorParentGroup().second);
}

void MoveGroupInterface::setPoseReferenceFrame(const std::string& frame) { impl_->pose_frame = frame; }
const std::string& MoveGroupInterface::getPoseReferenceFrame() const { return impl_->pose_frame; }
// Only the name that was given, so that the default link's target needs its name.
void MoveGroupInterface::clearPoseTarget(const std::string& link) { impl_->pose_targets.erase(link); }
void MoveGroupInterface::clearPoseTargets() { impl_->pose_targets.clear(); }

bool MoveGroupInterface::setPoseTarget(const Eigen::Isometry3d& pose, const std::string& link) {
  return setPoseTargets(EigenSTL::vector_Isometry3d{pose}, link);
}
bool MoveGroupInterface::setPoseTarget(const geometry_msgs::Pose& target, const std::string& link) {
  return setPoseTargets(std::vector<geometry_msgs::Pose>{target}, link);
}
bool MoveGroupInterface::setPoseTarget(const geometry_msgs::PoseStamped& target, const std::string& link) {
  return setPoseTargets(std::vector<geometry_msgs::PoseStamped>{target}, link);
}
bool MoveGroupInterface::setPoseTargets(const EigenSTL::vector_Isometry3d& targets, const std::string& link) {
  std::vector<geometry_msgs::Pose> poses;
  for (const Eigen::Isometry3d& target : targets) poses.push_back(tf2::toMsg(target));
  return setPoseTargets(poses, link);
}
bool MoveGroupInterface::setPoseTargets(const std::vector<geometry_msgs::Pose>& targets, const std::string& link) {
  std::vector<geometry_msgs::PoseStamped> poses(targets.size());
  for (std::size_t i = 0; i < targets.size(); ++i) {
    poses[i].header.frame_id = impl_->pose_frame;
    poses[i].pose = targets[i];
  }
  return setPoseTargets(poses, link);
}
bool MoveGroupInterface::setPoseTargets(const std::vector<geometry_msgs::PoseStamped>& targets, const std::string& named) {
  if (targets.empty()) {
    ROS_ERROR_NAMED(LOGNAME, "No pose specified as goal target");
    return false;
  }
  impl_->target = Impl::POSE;
  const std::string& link = impl_->link(named);
  if (link.empty()) {
    ROS_ERROR_NAMED(LOGNAME, "No end-effector to set the pose for");
    return false;
  }
  std::vector<geometry_msgs::PoseStamped>& kept = impl_->pose_targets[link] = targets;
  for (geometry_msgs::PoseStamped& pose : kept) pose.header.stamp = ros::Time(0);
  return true;
}

const std::vector<geometry_msgs::PoseStamped>& MoveGroupInterface::getPoseTargets(const std::string& named) const {
  static const std::vector<geometry_msgs::PoseStamped> none;
  const auto found = impl_->pose_targets.find(impl_->link(named));
  if (found != impl_->pose_targets.end() && !found->second.empty()) return found->second;
  ROS_ERROR_NAMED(LOGNAME, "Poses for end-effector '%s' are not known.", impl_->link(named).c_str());
  return none;
}

const geometry_msgs::PoseStamped& MoveGroupInterface::getPoseTarget(const std::string& named) const {
  static const geometry_msgs::PoseStamped none;
  const std::vector<geometry_msgs::PoseStamped>& targets = getPoseTargets(named);
  return targets.empty() ? none : targets.front();
}

// The other part of a target, position or orientation, stays what it was.
geometry_msgs::PoseStamped MoveGroupInterface::partOfTarget(const std::string& named) const {
  geometry_msgs::PoseStamped target;
  target.header.frame_id = impl_->pose_frame;
  target.pose.orientation.w = 1;
  if (impl_->pose_targets.count(impl_->link(named)) == 0) return target;
  target = getPoseTarget(named);
  if (target.header.frame_id != impl_->pose_frame) {
    target = impl_->tf_buffer->transform(target, impl_->pose_frame);
    target.header.stamp = ros::Time(0);
  }
  return target;
}

bool MoveGroupInterface::setPositionTarget(double x, double y, double z, const std::string& link) {
  geometry_msgs::PoseStamped target = partOfTarget(link);
  target.pose.position.x = x;
  target.pose.position.y = y;
  target.pose.position.z = z;
  const bool set = setPoseTarget(target, link);
  impl_->target = Impl::POSITION;
  return set;
}

bool MoveGroupInterface::setRPYTarget(double roll, double pitch, double yaw, const std::string& link) {
  tf2::Quaternion q;
  q.setRPY(roll, pitch, yaw);
  return setOrientationTarget(q.x(), q.y(), q.z(), q.w(), link);
}

bool MoveGroupInterface::setOrientationTarget(double x, double y, double z, double w, const std::string& link) {
  geometry_msgs::PoseStamped target = partOfTarget(link);
  target.pose.orientation.x = x;
  target.pose.orientation.y = y;
  target.pose.orientation.z = z;
  target.pose.orientation.w = w;
  const bool set = setPoseTarget(target, link);
  impl_->target = Impl::ORIENTATION;
  return set;
}

}  // namespace planning_interface
}  // namespace moveit
