#pragma once

/// What upstream's classes log under; people set the levels of these names.
namespace log_names
{
constexpr char CARTESIAN_INTERPOLATOR[] = "cartesian_interpolator";
constexpr char CONSTRAINT_SAMPLERS[] = "constraint_samplers";
constexpr char DYNAMICS_SOLVER[] = "dynamics_solver";
constexpr char KINEMATIC_CONSTRAINTS[] = "kinematic_constraints";
constexpr char KINEMATICS_BASE[] = "kinematics_base";
constexpr char PLANNING_INTERFACE[] = "planning_interface";
constexpr char PLANNING_REQUEST_ADAPTER[] = "planning_request_adapter";
constexpr char PLANNING_SCENE[] = "planning_scene";
constexpr char ROBOT_MODEL[] = "robot_model";
constexpr char JOINT_MODEL_GROUP[] = "robot_model.jmg";
constexpr char ROBOT_STATE[] = "robot_state";
constexpr char TRAJECTORY_PROCESSING[] = "trajectory_processing";
}  // namespace log_names
