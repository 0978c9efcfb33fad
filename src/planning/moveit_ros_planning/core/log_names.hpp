#pragma once

/// What upstream's classes log under; people set the levels of these names.
namespace log_names
{
constexpr char CONTROLLER_MANAGER[] = "controller_manager";
constexpr char CURRENT_STATE_MONITOR[] = "current_state_monitor";
constexpr char FAKE_CONTROLLER_MANAGER[] = "fake_controller_manager";
constexpr char KINEMATICS_PLUGIN_LOADER[] = "kinematics_plugin_loader";
constexpr char MOVEIT_CPP[] = "moveit_cpp";
constexpr char PLAN_EXECUTION[] = "plan_execution";
constexpr char PLANNING_COMPONENT[] = "planning_component";
constexpr char PLANNING_SCENE_MONITOR[] = "planning_scene_monitor";
constexpr char RDF_LOADER[] = "rdf_loader";
constexpr char ROBOT_MODEL_LOADER[] = "robot_model_loader";
constexpr char TRAJECTORY_EXECUTION_MANAGER[] = "trajectory_execution_manager";
constexpr char TRAJECTORY_MONITOR[] = "TrajectoryMonitor";
}  // namespace log_names
