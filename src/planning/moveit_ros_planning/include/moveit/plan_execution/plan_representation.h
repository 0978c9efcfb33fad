// Trajectories to be executed one after another, and what each of them changes.
#pragma once

#include <moveit_msgs/MoveItErrorCodes.h>

#include <boost/function.hpp>
#include <string>
#include <utility>
#include <vector>

#include <moveit/planning_scene_monitor/planning_scene_monitor.h>
#include <moveit/robot_trajectory/robot_trajectory.h>

namespace plan_execution
{
struct ExecutableMotionPlan;

struct ExecutableTrajectory
{
  ExecutableTrajectory() {}
  ExecutableTrajectory(const robot_trajectory::RobotTrajectoryPtr& trajectory, const std::string& description,
                       std::vector<std::string> controller_names = {})
    : trajectory_(trajectory)
    , description_(description)
    , controller_names_(std::move(controller_names))
  {
  }

  robot_trajectory::RobotTrajectoryPtr trajectory_;
  std::string description_;
  bool trajectory_monitoring_ = true;  // stop when the scene changes so that the rest of it collides
  collision_detection::AllowedCollisionMatrixConstPtr allowed_collision_matrix_;  // null: the scene's
  boost::function<bool(const ExecutableMotionPlan*)> effect_on_success_;          // false ends the plan
  std::vector<std::string> controller_names_;                                     // none: those that are chosen
};

struct ExecutableMotionPlan
{
  // Of the monitor's scene, or of a difference to it, while the monitor's is not changed.
  planning_scene::PlanningScenePtr copyPlanningScene()
  {
    const planning_scene_monitor::LockedPlanningSceneRO lock(planning_scene_monitor_);
    return planning_scene::PlanningScene::clone(planning_scene_);
  }

  planning_scene_monitor::PlanningSceneMonitorPtr planning_scene_monitor_;
  planning_scene::PlanningSceneConstPtr planning_scene_;
  std::vector<ExecutableTrajectory> plan_components_;
  robot_trajectory::RobotTrajectoryPtr executed_trajectory_;  // null where nothing was recorded
  moveit_msgs::MoveItErrorCodes error_code_;
};

using ExecutableMotionPlanComputationFn = boost::function<bool(ExecutableMotionPlan&)>;
}  // namespace plan_execution
