// States to and from messages.
#pragma once

#include <moveit_msgs/RobotState.h>
#include <trajectory_msgs/JointTrajectory.h>

#include <moveit/robot_state/robot_state.h>
#include <moveit/transforms/transforms.h>

namespace moveit
{
namespace core
{
bool jointStateToRobotState(const sensor_msgs::JointState& joint_state, RobotState& state);

// False, and a line in the log, for an invalid message. With `tf` poses may be in any frame that it knows.
bool robotStateMsgToRobotState(const Transforms& tf, const moveit_msgs::RobotState& robot_state, RobotState& state,
                               bool copy_attached_bodies = true);
bool robotStateMsgToRobotState(const moveit_msgs::RobotState& robot_state, RobotState& state, bool copy_attached_bodies = true);
void robotStateToRobotStateMsg(const RobotState& state, moveit_msgs::RobotState& robot_state, bool copy_attached_bodies = true);
void attachedBodiesToAttachedCollisionObjectMsgs(const std::vector<const AttachedBody*>& attached_bodies,
                                                 std::vector<moveit_msgs::AttachedCollisionObject>& attached_collision_objs);
void robotStateToJointStateMsg(const RobotState& state, sensor_msgs::JointState& joint_state);
bool jointTrajPointToRobotState(const trajectory_msgs::JointTrajectory& trajectory, std::size_t point_id, RobotState& state);

// Lines of a table.
void robotStateToStream(const RobotState& state, std::ostream& out, bool include_header = true,
                        const std::string& separator = ",");
void robotStateToStream(const RobotState& state, std::ostream& out, const std::vector<std::string>& joint_groups_ordering,
                        bool include_header = true, const std::string& separator = ",");
void streamToRobotState(RobotState& state, const std::string& line, const std::string& separator = ",");
}  // namespace core
}  // namespace moveit
