#include <moveit/moveit_cpp/planning_component.h>

#include <algorithm>
#include <stdexcept>
#include <thread>

#include <moveit/kinematic_constraints/utils.h>
#include <moveit/robot_state/conversions.h>

#include "log_names.hpp"

namespace moveit_cpp
{
namespace
{
using planning_interface::MotionPlanResponse;
using moveit::core::MoveItErrorCode;
}  // namespace

void PlanningComponent::PlanRequestParameters::load(const ros::NodeHandle& nh, const std::string& param_namespace)
{
  const std::string ns = (param_namespace.empty() ? "" : param_namespace + "/") + "plan_request_params/";
  nh.param(ns + "planner_id", planner_id, std::string());
  nh.param(ns + "planning_pipeline", planning_pipeline, std::string());
  nh.param(ns + "planning_time", planning_time, 1.0);
  nh.param(ns + "planning_attempts", planning_attempts, 5);
  nh.param(ns + "max_velocity_scaling_factor", max_velocity_scaling_factor, 1.0);
  nh.param(ns + "max_acceleration_scaling_factor", max_acceleration_scaling_factor, 1.0);
}

PlanningComponent::MultiPipelinePlanRequestParameters::MultiPipelinePlanRequestParameters(
    const ros::NodeHandle& nh, const std::vector<std::string>& planning_pipeline_names)
{
  for (const std::string& name : planning_pipeline_names)
  {
    multi_plan_request_parameters.emplace_back();
    multi_plan_request_parameters.back().load(nh, name);
  }
}

PlanningComponent::PlanningComponent(const std::string& group_name, const MoveItCppPtr& moveit_cpp)
  : nh_(moveit_cpp->getNodeHandle())
  , moveit_cpp_(moveit_cpp)
  , group_name_(group_name)
  , joint_model_group_(moveit_cpp->getRobotModel()->getJointModelGroup(group_name))
{
  if (!joint_model_group_)
  {
    const std::string error = "Could not find joint model group '" + group_name + "'.";
    ROS_FATAL_NAMED(log_names::PLANNING_COMPONENT, "%s", error.c_str());
    throw std::runtime_error(error);
  }
  plan_request_parameters_.load(nh_);
}

PlanningComponent::PlanningComponent(const std::string& group_name, const ros::NodeHandle& nh)
  : PlanningComponent(group_name, std::make_shared<MoveItCpp>(nh))
{
}

std::map<std::string, double> PlanningComponent::getNamedTargetStateValues(const std::string& name)
{
  std::map<std::string, double> values;
  joint_model_group_->getVariableDefaultPositions(name, values);
  return values;
}

void PlanningComponent::setWorkspace(double minx, double miny, double minz, double maxx, double maxy, double maxz)
{
  workspace_parameters_.header.frame_id = moveit_cpp_->getRobotModel()->getModelFrame();
  workspace_parameters_.header.stamp = ros::Time::now();
  workspace_parameters_.min_corner.x = minx;
  workspace_parameters_.min_corner.y = miny;
  workspace_parameters_.min_corner.z = minz;
  workspace_parameters_.max_corner.x = maxx;
  workspace_parameters_.max_corner.y = maxy;
  workspace_parameters_.max_corner.z = maxz;
  workspace_parameters_set_ = true;
}

// ---------------------------------------------------------------- start and goal

moveit::core::RobotStatePtr PlanningComponent::getStartState()
{
  if (considered_start_state_)
    return considered_start_state_;
  return moveit_cpp_->getCurrentState(1.0);
}

bool PlanningComponent::setStartState(const moveit::core::RobotState& start_state)
{
  considered_start_state_ = std::make_shared<moveit::core::RobotState>(start_state);
  return true;
}

bool PlanningComponent::setStartState(const std::string& named_state)
{
  moveit::core::RobotState state(moveit_cpp_->getRobotModel());
  if (moveit_cpp_->getCurrentState())
    state = *moveit_cpp_->getCurrentState();
  if (!state.setToDefaultValues(joint_model_group_, named_state))
  {
    ROS_ERROR_NAMED(log_names::PLANNING_COMPONENT, "No predefined joint state found for target name '%s'", named_state.c_str());
    return false;
  }
  return setStartState(state);
}

bool PlanningComponent::setGoal(const std::vector<moveit_msgs::Constraints>& goal_constraints)
{
  current_goal_constraints_ = goal_constraints;
  return true;
}

bool PlanningComponent::setGoal(const moveit::core::RobotState& goal_state)
{
  return setGoal(
      std::vector<moveit_msgs::Constraints>{ kinematic_constraints::constructGoalConstraints(goal_state, joint_model_group_) });
}

bool PlanningComponent::setGoal(const geometry_msgs::PoseStamped& goal_pose, const std::string& link_name)
{
  return setGoal(
      std::vector<moveit_msgs::Constraints>{ kinematic_constraints::constructGoalConstraints(link_name, goal_pose) });
}

bool PlanningComponent::setGoal(const std::string& named_target)
{
  moveit::core::RobotState state(moveit_cpp_->getRobotModel());
  if (!state.setToDefaultValues(joint_model_group_, named_target))
  {
    ROS_ERROR_NAMED(log_names::PLANNING_COMPONENT, "No predefined joint state found for target name '%s'",
                    named_target.c_str());
    return false;
  }
  return setGoal(state);
}

bool PlanningComponent::setPathConstraints(const moveit_msgs::Constraints& path_constraints)
{
  current_path_constraints_ = path_constraints;
  return true;
}

bool PlanningComponent::setTrajectoryConstraints(const moveit_msgs::TrajectoryConstraints& trajectory_constraints)
{
  current_trajectory_constraints_ = trajectory_constraints;
  return true;
}

// ---------------------------------------------------------------- plan and execute

MotionPlanResponse PlanningComponent::plan(const PlanRequestParameters& parameters, const bool store_solution)
{
  const MotionPlanResponse solution = planOnce(parameters);
  if (store_solution)
    last_plan_solution_ = solution;
  return solution;
}

MotionPlanResponse PlanningComponent::planOnce(const PlanRequestParameters& parameters)
{
  MotionPlanResponse solution;
  if (current_goal_constraints_.empty())
  {
    ROS_ERROR_NAMED(log_names::PLANNING_COMPONENT, "No goal constraints set for planning request");
    solution.error_code_ = moveit::core::MoveItErrorCode(moveit::core::MoveItErrorCode::INVALID_GOAL_CONSTRAINTS);
    return solution;
  }
  const auto pipeline = moveit_cpp_->getPlanningPipelines().find(parameters.planning_pipeline);
  if (pipeline == moveit_cpp_->getPlanningPipelines().end())
  {
    ROS_ERROR_NAMED(log_names::PLANNING_COMPONENT, "No planning pipeline available for name '%s'",
                    parameters.planning_pipeline.c_str());
    solution.error_code_ = moveit::core::MoveItErrorCode(moveit::core::MoveItErrorCode::FAILURE);
    return solution;
  }
  const auto start = considered_start_state_ ? considered_start_state_ : moveit_cpp_->getCurrentState();
  const auto monitor = moveit_cpp_->getPlanningSceneMonitorNonConst();
  monitor->updateFrameTransforms();
  planning_scene::PlanningScenePtr scene;
  {
    planning_scene_monitor::LockedPlanningSceneRO locked(monitor);
    scene = planning_scene::PlanningScene::clone(locked);
  }
  scene->setCurrentState(*start);
  planning_interface::MotionPlanRequest request;
  request.group_name = group_name_;
  request.planner_id = parameters.planner_id;
  request.num_planning_attempts = std::max(1, parameters.planning_attempts);
  request.allowed_planning_time = parameters.planning_time;
  request.max_velocity_scaling_factor = parameters.max_velocity_scaling_factor;
  request.max_acceleration_scaling_factor = parameters.max_acceleration_scaling_factor;
  if (workspace_parameters_set_)
    request.workspace_parameters = workspace_parameters_;
  moveit::core::robotStateToRobotStateMsg(*start, request.start_state);
  request.goal_constraints = current_goal_constraints_;
  request.path_constraints = current_path_constraints_;
  request.trajectory_constraints = current_trajectory_constraints_;
  if (!pipeline->second->generatePlan(scene, request, solution))
  {
    ROS_ERROR_NAMED(log_names::PLANNING_COMPONENT, "Could not compute plan successfully");
    if (solution.error_code_.val == moveit::core::MoveItErrorCode::SUCCESS || solution.error_code_.val == 0)
      solution.error_code_ = moveit::core::MoveItErrorCode(moveit::core::MoveItErrorCode::FAILURE);
    solution.trajectory_.reset();
  }
  solution.start_state_ = request.start_state;
  solution.planner_id_ = parameters.planner_id;
  return solution;
}

MotionPlanResponse PlanningComponent::plan(const MultiPipelinePlanRequestParameters& parameters,
                                           const SolutionCallbackFunction& solution_selection_callback,
                                           const StoppingCriterionFunction& stopping_criterion_callback)
{
  PlanSolutions solutions(parameters.multi_plan_request_parameters.size());
  std::vector<std::thread> threads;
  std::mutex one_at_a_time;
  for (const PlanRequestParameters& own : parameters.multi_plan_request_parameters)
    threads.emplace_back([&, own]() {
      MotionPlanResponse solution;
      try
      {
        solution = planOnce(own);
      }
      catch (const std::exception& error)
      {
        ROS_ERROR_NAMED(log_names::PLANNING_COMPONENT, "Planning pipeline '%s' threw exception '%s'",
                        own.planning_pipeline.c_str(), error.what());
        solution.error_code_ = moveit::core::MoveItErrorCode(moveit::core::MoveItErrorCode::FAILURE);
      }
      std::lock_guard<std::mutex> lock(one_at_a_time);
      solutions.pushBack(solution);
      if (!stopping_criterion_callback || !stopping_criterion_callback(solutions, parameters))
        return;
      for (const PlanRequestParameters& other : parameters.multi_plan_request_parameters)
        moveit_cpp_->terminatePlanningPipeline(other.planning_pipeline);
    });
  for (std::thread& thread : threads)
    thread.join();
  if (!solutions.getSolutions().empty())
    last_plan_solution_ = solution_selection_callback(solutions.getSolutions());
  return last_plan_solution_;
}

bool PlanningComponent::execute(bool blocking)
{
  if (!last_plan_solution_)
  {
    ROS_ERROR_NAMED(log_names::PLANNING_COMPONENT, "There is no successful plan to execute");
    return false;
  }
  return moveit_cpp_->execute(group_name_, last_plan_solution_.trajectory_, blocking);
}

MotionPlanResponse getShortestSolution(std::vector<MotionPlanResponse> const& solutions)
{
  if (solutions.empty())
    return MotionPlanResponse();
  return *std::min_element(solutions.begin(), solutions.end(), [](const MotionPlanResponse& a, const MotionPlanResponse& b) {
    if (a && b && a.trajectory_ && b.trajectory_)
      return robot_trajectory::path_length(*a.trajectory_) < robot_trajectory::path_length(*b.trajectory_);
    return static_cast<bool>(a) && !b;
  });
}
}  // namespace moveit_cpp
