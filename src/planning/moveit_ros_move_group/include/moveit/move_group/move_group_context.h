// What the capabilities of one move_group share. move_group itself is a Python node: these are of the process beside it in
// which compiled capabilities live, with a scene that follows move_group's and changes it.
#pragma once

#include <string>

#include <moveit/macros/class_forward.h>

namespace moveit_cpp
{
MOVEIT_CLASS_FORWARD(MoveItCpp);
}

namespace planning_scene_monitor
{
MOVEIT_CLASS_FORWARD(PlanningSceneMonitor);
}

namespace planning_pipeline
{
MOVEIT_CLASS_FORWARD(PlanningPipeline);
}

namespace plan_execution
{
MOVEIT_CLASS_FORWARD(PlanExecution);
}

namespace trajectory_execution_manager
{
MOVEIT_CLASS_FORWARD(TrajectoryExecutionManager);
}

namespace move_group
{
MOVEIT_STRUCT_FORWARD(MoveGroupContext);

// There is no plan_with_sensing_: nothing here looks around before it executes.
struct MoveGroupContext
{
  // Without the default pipeline, planning_pipeline_ is null, and the log says so.
  MoveGroupContext(const moveit_cpp::MoveItCppPtr& moveit_cpp, const std::string& default_planning_pipeline,
                   bool allow_trajectory_execution = false, bool debug = false);
  ~MoveGroupContext();

  bool status() const;

  moveit_cpp::MoveItCppPtr moveit_cpp_;
  planning_scene_monitor::PlanningSceneMonitorPtr planning_scene_monitor_;
  // Null where trajectories are not to be executed, as is plan_execution_.
  trajectory_execution_manager::TrajectoryExecutionManagerPtr trajectory_execution_manager_;
  planning_pipeline::PlanningPipelinePtr planning_pipeline_;
  plan_execution::PlanExecutionPtr plan_execution_;
  bool allow_trajectory_execution_, debug_;
};
}  // namespace move_group
