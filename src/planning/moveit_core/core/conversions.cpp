#include <moveit/robot_state/conversions.h>

#include <ros/console.h>
#include <tf2_eigen/tf2_eigen.h>

#include <sstream>

#include <moveit/utils/lexical_casts.h>

#include "log_names.hpp"
#include "object_messages.hpp"

namespace moveit
{
namespace core
{
namespace
{
bool readJoints(const sensor_msgs::JointState& message, RobotState& state)
{
  if (message.name.size() != message.position.size())
  {
    ROS_ERROR_NAMED(log_names::ROBOT_STATE, "Different number of names and positions in JointState message: %zu, %zu",
                    message.name.size(), message.position.size());
    return false;
  }
  state.setVariableValues(message);
  return true;
}

bool readMultiDofJoints(const sensor_msgs::MultiDOFJointState& message, RobotState& state, const Transforms* tf)
{
  const std::size_t count = message.joint_names.size();
  if (count != message.transforms.size())
  {
    ROS_ERROR_NAMED(log_names::ROBOT_STATE, "Different number of names, values or frames in MultiDOFJointState message.");
    return false;
  }
  bool good = true;
  // In some other frame than the model's: everything is turned into it.
  Eigen::Isometry3d from_other = Eigen::Isometry3d::Identity();
  const std::string& model_frame = state.getRobotModel()->getModelFrame();
  if (!Transforms::sameFrame(message.header.frame_id, model_frame))
  {
    bool known = false;
    if (tf && !message.header.frame_id.empty())
    {
      known = tf->canTransform(message.header.frame_id);
      if (known)
        from_other = tf->getTransform(message.header.frame_id);
    }
    if (!known && !message.joint_names.empty())
    {
      ROS_WARN_NAMED(log_names::ROBOT_STATE,
                     "The transform for multi-dof joints was specified in frame '%s' but it was not possible to "
                     "transform that to frame '%s'",
                     message.header.frame_id.c_str(), model_frame.c_str());
      good = false;
    }
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    if (!state.getRobotModel()->hasJointModel(message.joint_names[i]))
    {
      ROS_WARN_NAMED(log_names::ROBOT_STATE, "No joint matching multi-dof joint '%s'", message.joint_names[i].c_str());
      good = false;
      continue;
    }
    const Eigen::Isometry3d pose = from_other * tf2::transformToEigen(message.transforms[i]);
    state.setJointPositions(message.joint_names[i], pose);
  }
  return good;
}

void readAttached(const moveit_msgs::AttachedCollisionObject& message, RobotState& state, const Transforms* tf)
{
  const moveit_msgs::CollisionObject& object = message.object;
  if (object.operation == moveit_msgs::CollisionObject::REMOVE)
  {
    if (object.id.empty())
      state.clearAttachedBodies();
    else if (!state.clearAttachedBody(object.id))
      ROS_ERROR_NAMED(log_names::ROBOT_STATE, "The attached body '%s' can not be removed because it does not exist",
                      object.id.c_str());
    return;
  }
  if (object.operation != moveit_msgs::CollisionObject::ADD)
  {
    ROS_ERROR_NAMED(log_names::ROBOT_STATE, "Unknown collision object operation: %d", object.operation);
    return;
  }
  const LinkModel* link = state.getLinkModel(message.link_name);
  ObjectParts parts;
  if (!link || !readObject(object, parts))
    return;
  if (parts.shapes.empty())
  {
    ROS_ERROR_NAMED(log_names::ROBOT_STATE, "The attached body for link '%s' has no geometry", message.link_name.c_str());
    return;
  }
  Eigen::Isometry3d in_link = parts.pose;
  if (!Transforms::sameFrame(object.header.frame_id, message.link_name))
  {
    bool known = false;
    Eigen::Isometry3d frame = state.getFrameTransform(object.header.frame_id, &known);
    if (!known && tf && tf->canTransform(object.header.frame_id))
    {
      frame = tf->getTransform(object.header.frame_id);
      known = true;
    }
    if (!known)
      ROS_ERROR_NAMED(log_names::ROBOT_STATE,
                      "Cannot properly transform from frame '%s'. The pose of the attached body may be incorrect",
                      object.header.frame_id.c_str());
    in_link = state.getGlobalLinkTransform(link).inverse() * frame * parts.pose;
  }
  if (state.clearAttachedBody(object.id))
    ROS_DEBUG_NAMED(log_names::ROBOT_STATE,
                    "The robot state already had an object named '%s' attached to link '%s'. The object was replaced.",
                    object.id.c_str(), message.link_name.c_str());
  state.attachBody(object.id, in_link, parts.shapes, parts.shape_poses, message.touch_links, message.link_name,
                   message.detach_posture, parts.subframes);
}

bool read(const Transforms* tf, const moveit_msgs::RobotState& message, RobotState& state, bool copy_attached_bodies)
{
  if (!message.is_diff && message.joint_state.name.empty() && message.multi_dof_joint_state.joint_names.empty())
  {
    ROS_DEBUG_NAMED(log_names::ROBOT_STATE, "Found empty JointState message");
    return false;
  }
  const bool joints = readJoints(message.joint_state, state);
  const bool multi = readMultiDofJoints(message.multi_dof_joint_state, state, tf);
  const bool valid = joints || multi;
  if (!valid || !copy_attached_bodies)
    return valid;
  if (!message.is_diff)
    state.clearAttachedBodies();
  for (const auto& object : message.attached_collision_objects)
    readAttached(object, state, tf);
  return valid;
}
}  // namespace

bool jointStateToRobotState(const sensor_msgs::JointState& joint_state, RobotState& state)
{
  return readJoints(joint_state, state);
}

bool robotStateMsgToRobotState(const moveit_msgs::RobotState& robot_state, RobotState& state, bool copy_attached_bodies)
{
  return read(nullptr, robot_state, state, copy_attached_bodies);
}

bool robotStateMsgToRobotState(const Transforms& tf, const moveit_msgs::RobotState& robot_state, RobotState& state,
                               bool copy_attached_bodies)
{
  return read(&tf, robot_state, state, copy_attached_bodies);
}

// ---------------------------------------------------------------- into messages

void robotStateToJointStateMsg(const RobotState& state, sensor_msgs::JointState& joint_state)
{
  joint_state = sensor_msgs::JointState();
  for (const JointModel* joint : state.getRobotModel()->getSingleDOFJointModels())
  {
    joint_state.name.push_back(joint->getName());
    joint_state.position.push_back(state.getVariablePosition(joint->getFirstVariableIndex()));
    if (state.hasVelocities())
      joint_state.velocity.push_back(state.getVariableVelocity(joint->getFirstVariableIndex()));
    if (state.hasEffort())
      joint_state.effort.push_back(state.getVariableEffort(joint->getFirstVariableIndex()));
  }
  joint_state.header.frame_id = state.getRobotModel()->getModelFrame();
}

void robotStateToRobotStateMsg(const RobotState& state, moveit_msgs::RobotState& robot_state, bool copy_attached_bodies)
{
  robot_state.is_diff = false;
  robotStateToJointStateMsg(state, robot_state.joint_state);
  sensor_msgs::MultiDOFJointState& multi = robot_state.multi_dof_joint_state;
  multi = sensor_msgs::MultiDOFJointState();
  multi.header.frame_id = state.getRobotModel()->getModelFrame();
  for (const JointModel* joint : state.getRobotModel()->getMultiDOFJointModels())
  {
    multi.joint_names.push_back(joint->getName());
    multi.transforms.push_back(tf2::eigenToTransform(state.getJointTransform(joint)).transform);
  }
  if (!copy_attached_bodies)
    return;
  std::vector<const AttachedBody*> bodies;
  state.getAttachedBodies(bodies);
  attachedBodiesToAttachedCollisionObjectMsgs(bodies, robot_state.attached_collision_objects);
}

void attachedBodiesToAttachedCollisionObjectMsgs(const std::vector<const AttachedBody*>& attached_bodies,
                                                 std::vector<moveit_msgs::AttachedCollisionObject>& attached_collision_objs)
{
  attached_collision_objs.clear();
  for (const AttachedBody* body : attached_bodies)
  {
    moveit_msgs::AttachedCollisionObject message;
    message.link_name = body->getAttachedLinkName();
    message.detach_posture = body->getDetachPosture();
    message.touch_links.assign(body->getTouchLinks().begin(), body->getTouchLinks().end());
    message.object.header.frame_id = message.link_name;
    message.object.id = body->getName();
    message.object.operation = moveit_msgs::CollisionObject::ADD;
    ObjectParts parts;
    parts.pose = body->getPose();
    parts.shapes = body->getShapes();
    parts.shape_poses = body->getShapePoses();
    parts.subframes = body->getSubframes();
    writeObject(parts, message.object);
    attached_collision_objs.push_back(message);
  }
}

bool jointTrajPointToRobotState(const trajectory_msgs::JointTrajectory& trajectory, std::size_t point_id, RobotState& state)
{
  if (trajectory.points.empty() || point_id > trajectory.points.size() - 1)
  {
    ROS_ERROR_NAMED(log_names::ROBOT_STATE, "Invalid point_id");
    return false;
  }
  if (trajectory.joint_names.empty())
  {
    ROS_ERROR_NAMED(log_names::ROBOT_STATE, "No joint names specified");
    return false;
  }
  const trajectory_msgs::JointTrajectoryPoint& point = trajectory.points[point_id];
  state.setVariablePositions(trajectory.joint_names, point.positions);
  if (!point.velocities.empty())
    state.setVariableVelocities(trajectory.joint_names, point.velocities);
  if (!point.accelerations.empty())
    state.setVariableAccelerations(trajectory.joint_names, point.accelerations);
  if (!point.effort.empty())
    state.setVariableEffort(trajectory.joint_names, point.effort);
  return true;
}

// ---------------------------------------------------------------- tables

void robotStateToStream(const RobotState& state, std::ostream& out, bool include_header, const std::string& separator)
{
  const std::vector<std::string>& names = state.getVariableNames();
  for (std::size_t i = 0; i < names.size() && include_header; ++i)
    out << names[i] << (i + 1 < names.size() ? separator : "\n");
  for (std::size_t i = 0; i < names.size(); ++i)
    out << toString(state.getVariablePosition(i)) << (i + 1 < names.size() ? separator : "\n");
}

void robotStateToStream(const RobotState& state, std::ostream& out, const std::vector<std::string>& joint_groups_ordering,
                        bool include_header, const std::string& separator)
{
  std::ostringstream header, line;
  for (const std::string& name : joint_groups_ordering)
  {
    const JointModelGroup* group = state.getJointModelGroup(name);
    if (!group)
      continue;
    std::vector<double> values;
    state.copyJointGroupPositions(group, values);
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      header << group->getVariableNames()[i] << separator;
      line << toString(values[i]) << separator;
    }
  }
  if (include_header)
    out << header.str() << '\n';
  out << line.str() << '\n';
}

void streamToRobotState(RobotState& state, const std::string& line, const std::string& separator)
{
  std::istringstream stream(line);
  std::string cell;
  for (std::size_t i = 0; i < state.getVariableCount(); ++i)
  {
    if (!std::getline(stream, cell, separator[0]))
      ROS_ERROR_STREAM_NAMED(log_names::ROBOT_STATE, "Missing variable " << state.getVariableNames()[i]);
    else
      state.setVariablePosition(static_cast<int>(i), toDouble(cell));
  }
}
}  // namespace core
}  // namespace moveit
