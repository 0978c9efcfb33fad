// What compiled capabilities share.
#include <moveit/move_group/move_group_capability.h>

#include <tf2_geometry_msgs/tf2_geometry_msgs.h>

#include <moveit/moveit_cpp/moveit_cpp.h>
#include <moveit/robot_state/conversions.h>
#include <moveit/utils/moveit_error_code.h>

namespace move_group
{
namespace
{
std::string& setName()
{
  static std::string name;
  return name;
}
}  // namespace

void detail::setMoveGroupName(const std::string& name) { setName() = name; }

std::string detail::moveGroupName() { return setName().empty() ? "~" : setName(); }

std::string MoveGroupCapability::getActionResultString(const moveit_msgs::MoveItErrorCodes& error_code,
                                                       bool planned_trajectory_empty, bool plan_only)
{
  using Codes = moveit_msgs::MoveItErrorCodes;
  switch (error_code.val)
  {
    case Codes::SUCCESS:
      if (planned_trajectory_empty)
        return "Requested path and goal constraints are already met.";
      return plan_only ? "Motion plan was computed succesfully." : "Solution was found and executed.";
    case Codes::INVALID_GROUP_NAME:
      return "Invalid group in motion plan request";
    case Codes::PLANNING_FAILED:
    case Codes::INVALID_MOTION_PLAN:
      return planned_trajectory_empty
                 ? "No motion plan found. No execution attempted."
                 : "Motion plan was found but it seems to be invalid (possibly due to postprocessing). Not executing.";
    case Codes::UNABLE_TO_AQUIRE_SENSOR_DATA:
      return "Motion plan was found but it seems to be too costly and looking around did not help.";
    case Codes::MOTION_PLAN_INVALIDATED_BY_ENVIRONMENT_CHANGE:
      return "Solution found but the environment changed during execution and the path was aborted";
    default:
      return moveit::core::MoveItErrorCode::toString(error_code);
  }
}

std::string MoveGroupCapability::stateToStr(MoveGroupState state) const
{
  static const char* const names[] = { "IDLE", "PLANNING", "MONITOR", "LOOK" };
  return state >= IDLE && state <= LOOK ? names[state] : "UNKNOWN";
}

void MoveGroupCapability::convertToMsg(const std::vector<plan_execution::ExecutableTrajectory>& trajectory,
                                       moveit_msgs::RobotState& first_state_msg,
                                       std::vector<moveit_msgs::RobotTrajectory>& trajectory_msg) const
{
  trajectory_msg.resize(trajectory.size());
  bool first = true;
  for (std::size_t i = 0; i < trajectory.size(); ++i)
  {
    moveit_msgs::RobotState start;
    convertToMsg(trajectory[i].trajectory_, start, trajectory_msg[i]);
    if (first && trajectory[i].trajectory_ && !trajectory[i].trajectory_->empty())
    {
      first_state_msg = start;
      first = false;
    }
  }
}

void MoveGroupCapability::convertToMsg(const robot_trajectory::RobotTrajectoryPtr& trajectory,
                                       moveit_msgs::RobotState& first_state_msg,
                                       moveit_msgs::RobotTrajectory& trajectory_msg) const
{
  if (!trajectory || trajectory->empty())
    return;
  moveit::core::robotStateToRobotStateMsg(trajectory->getFirstWayPoint(), first_state_msg);
  trajectory->getRobotTrajectoryMsg(trajectory_msg);
}

void MoveGroupCapability::convertToMsg(const std::vector<plan_execution::ExecutableTrajectory>& trajectory,
                                       moveit_msgs::RobotState& first_state_msg,
                                       moveit_msgs::RobotTrajectory& trajectory_msg) const
{
  if (trajectory.size() > 1)
    ROS_ERROR_NAMED(getName(), "of a plan of %zu trajectories all but the first are left out", trajectory.size());
  if (!trajectory.empty())
    convertToMsg(trajectory.front().trajectory_, first_state_msg, trajectory_msg);
}

planning_interface::MotionPlanRequest MoveGroupCapability::clearRequestStartState(
    const planning_interface::MotionPlanRequest& request) const
{
  planning_interface::MotionPlanRequest cleared = request;
  cleared.start_state = moveit_msgs::RobotState();
  cleared.start_state.is_diff = true;
  ROS_WARN_NAMED(getName(), "what is executed starts where the robot is: the start state of the request is left out");
  return cleared;
}

moveit_msgs::PlanningScene MoveGroupCapability::clearSceneRobotState(const moveit_msgs::PlanningScene& scene) const
{
  moveit_msgs::PlanningScene cleared = scene;
  cleared.robot_state = moveit_msgs::RobotState();
  cleared.robot_state.is_diff = true;
  ROS_WARN_NAMED(getName(), "what is executed starts where the robot is: the robot's state of the scene is left out");
  return cleared;
}

bool MoveGroupCapability::performTransform(geometry_msgs::PoseStamped& pose_msg, const std::string& target_frame) const
{
  if (!context_ || !context_->planning_scene_monitor_->getTFClient())
    return false;
  if (pose_msg.header.frame_id.empty())
    pose_msg.header.frame_id = target_frame;
  if (pose_msg.header.frame_id == target_frame)
    return true;
  try
  {
    geometry_msgs::PoseStamped latest(pose_msg);
    latest.header.stamp = ros::Time(0);
    context_->planning_scene_monitor_->getTFClient()->transform(latest, pose_msg, target_frame);
  }
  catch (const tf2::TransformException& error)
  {
    ROS_ERROR_NAMED(getName(), "TF Problem: %s", error.what());
    return false;
  }
  return true;
}

planning_pipeline::PlanningPipelinePtr MoveGroupCapability::resolvePlanningPipeline(const std::string& pipeline_id) const
{
  if (pipeline_id.empty())
    return context_->planning_pipeline_;
  const auto& pipelines = context_->moveit_cpp_->getPlanningPipelines();
  const auto found = pipelines.find(pipeline_id);
  if (found != pipelines.end())
    return found->second;
  ROS_WARN_NAMED(getName(), "Couldn't find requested planning pipeline '%s'", pipeline_id.c_str());
  return nullptr;
}
}  // namespace move_group
