// Names of move_group's actions and services, as clients ask for them.
#pragma once

#include <string>

namespace move_group
{
static const std::string PLANNER_SERVICE_NAME = "plan_kinematic_path";
static const std::string EXECUTE_ACTION_NAME = "execute_trajectory";
static const std::string QUERY_PLANNERS_SERVICE_NAME = "query_planner_interface";
static const std::string GET_PLANNER_PARAMS_SERVICE_NAME = "get_planner_params";
static const std::string SET_PLANNER_PARAMS_SERVICE_NAME = "set_planner_params";
static const std::string MOVE_ACTION = "move_group";
static const std::string IK_SERVICE_NAME = "compute_ik";
static const std::string FK_SERVICE_NAME = "compute_fk";
static const std::string STATE_VALIDITY_SERVICE_NAME = "check_state_validity";
static const std::string CARTESIAN_PATH_SERVICE_NAME = "compute_cartesian_path";
static const std::string GET_PLANNING_SCENE_SERVICE_NAME = "get_planning_scene";
static const std::string APPLY_PLANNING_SCENE_SERVICE_NAME = "apply_planning_scene";
static const std::string CLEAR_OCTOMAP_SERVICE_NAME = "clear_octomap";
}  // namespace move_group
