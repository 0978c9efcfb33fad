#include "planning_context.hpp"

#include <moveit/kinematic_constraints/kinematic_constraint.h>
#include <moveit/robot_state/conversions.h>
#include <ros/console.h>

#include "motion/planning_scene.hpp"
#include "planner_configs.hpp"

namespace ompl_interface
{
namespace
{
using moveit_msgs::MoveItErrorCodes;

// The codes that upstream's interface to OMPL gives.
int codeOf(motion::PlanStatus status)
{
  switch (status)
  {
    case motion::PlanStatus::Solved:
      return MoveItErrorCodes::SUCCESS;
    case motion::PlanStatus::Timeout:
      return MoveItErrorCodes::TIMED_OUT;
    case motion::PlanStatus::Cancelled:
      return MoveItErrorCodes::PREEMPTED;
    case motion::PlanStatus::InvalidStart:
      return MoveItErrorCodes::INVALID_ROBOT_STATE;
    case motion::PlanStatus::StartInCollision:
      return MoveItErrorCodes::START_STATE_IN_COLLISION;
    case motion::PlanStatus::StartViolatesPathConstraints:
      return MoveItErrorCodes::START_STATE_VIOLATES_PATH_CONSTRAINTS;
    case motion::PlanStatus::NoGoal:
      return MoveItErrorCodes::INVALID_GOAL_CONSTRAINTS;
    case motion::PlanStatus::InvalidGoal:
    case motion::PlanStatus::GoalInCollision:
    case motion::PlanStatus::GoalViolatesPathConstraints:
    case motion::PlanStatus::NoIk:
      return MoveItErrorCodes::GOAL_STATE_INVALID;
    case motion::PlanStatus::InvalidPath:
      return MoveItErrorCodes::INVALID_MOTION_PLAN;
    default:
      return MoveItErrorCodes::PLANNING_FAILED;
  }
}
}  // namespace

OMPLContext::OMPLContext(const std::string& name, const std::string& group, const motion::PlanRequest& base)
  : PlanningContext(name, group)
  , plan_(base)
{
  plan_.group = group;
}

bool OMPLContext::prepare(const planning_scene::PlanningSceneConstPtr& scene, const planning_interface::MotionPlanRequest& req,
                          MoveItErrorCodes& error_code)
{
  setPlanningScene(scene);
  setMotionPlanRequest(req);
  start_ = scene->getCurrentStateUpdated(req.start_state);
  kinematic_constraints::KinematicConstraintSet path(scene->getRobotModel());
  if (!path.add(req.path_constraints, scene->getTransforms()))
  {
    ROS_ERROR_NAMED(LOGNAME, "%s: the path constraints cannot be used", name_.c_str());
    error_code.val = MoveItErrorCodes::INVALID_GOAL_CONSTRAINTS;
    return false;
  }
  plan_.path = path.given();
  for (const moveit_msgs::Constraints& message : req.goal_constraints)
  {
    kinematic_constraints::KinematicConstraintSet goal(scene->getRobotModel());
    if (goal.add(message, scene->getTransforms()) && !goal.empty())
      plan_.goals.push_back(goal.given());
  }
  if (plan_.goals.empty())
  {
    ROS_WARN_NAMED(LOGNAME, "%s: No goal constraints specified. There is no problem to solve.", name_.c_str());
    error_code.val = MoveItErrorCodes::INVALID_GOAL_CONSTRAINTS;
    return false;
  }
  plan_.time = request_.allowed_planning_time;
  plan_.attempts = request_.num_planning_attempts;
  const auto& low = req.workspace_parameters.min_corner;
  const auto& high = req.workspace_parameters.max_corner;
  plan_.workspace_min = motion::Vector3(low.x, low.y, low.z);
  plan_.workspace_max = motion::Vector3(high.x, high.y, high.z);
  plan_.has_workspace = plan_.workspace_min.norm() > 0.0 || plan_.workspace_max.norm() > 0.0;
  if (const planning_scene::StateFeasibilityFn feasible = scene->getStateFeasibilityPredicate())
    plan_.feasible = [feasible, like = start_](const motion::RobotState& state) {
      moveit::core::RobotState asked(*like);
      asked.setVariablePositions(state.positions());
      return feasible(asked, false);
    };
  error_code.val = MoveItErrorCodes::SUCCESS;
  return true;
}

bool OMPLContext::solve(planning_interface::MotionPlanResponse& res)
{
  *cancel_ = false;
  res.trajectory_.reset();
  res.planner_id_ = request_.planner_id;
  motion::PlanResult found;
  const ros::WallTime began = ros::WallTime::now();
  try
  {
    const motion::PlanningScene own(planning_scene_->core());  // whoever changes the scene meanwhile does not disturb
    found = motion::planClosely(own, start_->core(), plan_, cancel_);
  }
  catch (const motion::Error& error)
  {
    found.status = motion::PlanStatus::NoGoal;
    found.message = error.what();
  }
  res.planning_time_ = (ros::WallTime::now() - began).toSec();
  res.error_code_.val = codeOf(found.status);
  moveit::core::robotStateToRobotStateMsg(*start_, res.start_state_);
  for (const std::string& warning : found.warnings)
    ROS_WARN_NAMED(LOGNAME, "%s: %s", name_.c_str(), warning.c_str());
  if (found.status != motion::PlanStatus::Solved)
  {
    ROS_INFO_NAMED(LOGNAME, "%s: Unable to solve the planning problem: %s", name_.c_str(), found.message.c_str());
    return false;
  }
  res.trajectory_ = std::make_shared<robot_trajectory::RobotTrajectory>(planning_scene_->getRobotModel(), group_);
  const motion::JointModelGroup& group = planning_scene_->getRobotModel()->core()->group(group_);
  for (const std::vector<double>& values : found.path)
  {
    motion::RobotState there(start_->core());
    there.setGroup(group, values.data());
    const auto state = std::make_shared<moveit::core::RobotState>(*start_);
    state->dropDynamics();
    state->setVariablePositions(there.positions());
    state->update();
    res.trajectory_->addSuffixWayPoint(state, 0.0);
  }
  return true;
}

bool OMPLContext::solve(planning_interface::MotionPlanDetailedResponse& res)
{
  planning_interface::MotionPlanResponse plain;
  const bool solved = solve(plain);
  res.error_code_ = plain.error_code_;
  res.start_state_ = plain.start_state_;
  res.planner_id_ = plain.planner_id_;
  if (solved)
  {
    res.trajectory_ = { plain.trajectory_ };
    res.description_ = { "plan" };
    res.processing_time_ = { plain.planning_time_ };
  }
  return solved;
}

bool OMPLContext::terminate()
{
  *cancel_ = true;
  return true;
}
}  // namespace ompl_interface
