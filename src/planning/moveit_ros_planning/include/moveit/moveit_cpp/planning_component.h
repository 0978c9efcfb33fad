// A group's start, goal and plan, within one program.
#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <moveit_msgs/Constraints.h>
#include <moveit_msgs/TrajectoryConstraints.h>
#include <moveit_msgs/WorkspaceParameters.h>

#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include <moveit/moveit_cpp/moveit_cpp.h>
#include <moveit/planning_interface/planning_response.h>
#include <moveit/utils/moveit_error_code.h>

namespace moveit_cpp
{
MOVEIT_CLASS_FORWARD(PlanningComponent);

// Of those that succeeded the one with the shortest path; else the first.
planning_interface::MotionPlanResponse getShortestSolution(
    std::vector<planning_interface::MotionPlanResponse> const& solutions);

class PlanningComponent
{
public:
  using MoveItErrorCode [[deprecated("Use moveit::core::MoveItErrorCode")]] = moveit::core::MoveItErrorCode;

  class PlanSolutions
  {
  public:
    PlanSolutions(const size_t expected_size = 0) { solutions_.reserve(expected_size); }
    void pushBack(const planning_interface::MotionPlanResponse& plan_solution)
    {
      std::lock_guard<std::mutex> lock(solutions_mutex_);
      solutions_.push_back(plan_solution);
    }
    std::vector<planning_interface::MotionPlanResponse> const& getSolutions() const { return solutions_; }

  private:
    std::vector<planning_interface::MotionPlanResponse> solutions_;
    std::mutex solutions_mutex_;
  };

  // Below plan_request_params.
  struct PlanRequestParameters
  {
    void load(const ros::NodeHandle& nh, const std::string& param_namespace = "");
    std::string planner_id, planning_pipeline;
    int planning_attempts = 5;
    double planning_time = 1.0;  // s
    double max_velocity_scaling_factor = 1.0, max_acceleration_scaling_factor = 1.0;
  };
  // Below <name>/plan_request_params, for each name.
  struct MultiPipelinePlanRequestParameters
  {
    MultiPipelinePlanRequestParameters(const ros::NodeHandle& nh, const std::vector<std::string>& planning_pipeline_names);
    std::vector<PlanRequestParameters> multi_plan_request_parameters;
  };
  typedef std::function<planning_interface::MotionPlanResponse(
      std::vector<planning_interface::MotionPlanResponse> const& solutions)>
      SolutionCallbackFunction;
  typedef std::function<bool(PlanSolutions const& solutions, MultiPipelinePlanRequestParameters const& plan_request_parameters)>
      StoppingCriterionFunction;

  // Throws std::runtime_error when the robot has no such group.
  PlanningComponent(const std::string& group_name, const ros::NodeHandle& nh);
  PlanningComponent(const std::string& group_name, const MoveItCppPtr& moveit_cpp);
  PlanningComponent(const PlanningComponent&) = delete;
  PlanningComponent& operator=(const PlanningComponent&) = delete;
  PlanningComponent(PlanningComponent&& other) = default;
  PlanningComponent& operator=(PlanningComponent&& other) = delete;
  ~PlanningComponent() {}

  const std::string& getPlanningGroupName() const { return group_name_; }
  const std::vector<std::string> getNamedTargetStates() { return joint_model_group_->getDefaultStateNames(); }
  std::map<std::string, double> getNamedTargetStateValues(const std::string& name);
  void setWorkspace(double minx, double miny, double minz, double maxx, double maxy, double maxz);  // m
  void unsetWorkspace() { workspace_parameters_set_ = false; }

  moveit::core::RobotStatePtr getStartState();
  bool setStartState(const moveit::core::RobotState& start_state);
  bool setStartState(const std::string& named_state);
  void setStartStateToCurrentState() { considered_start_state_.reset(); }
  bool setGoal(const std::vector<moveit_msgs::Constraints>& goal_constraints);
  bool setGoal(const moveit::core::RobotState& goal_state);
  bool setGoal(const geometry_msgs::PoseStamped& goal_pose, const std::string& link_name);
  bool setGoal(const std::string& named_target);
  bool setPathConstraints(const moveit_msgs::Constraints& path_constraints);
  bool setTrajectoryConstraints(const moveit_msgs::TrajectoryConstraints& trajectory_constraints);

  planning_interface::MotionPlanResponse plan() { return plan(plan_request_parameters_); }
  planning_interface::MotionPlanResponse plan(const PlanRequestParameters& parameters, const bool store_solution = true);
  // Several pipelines side by side; the others are ended once the criterion holds.
  planning_interface::MotionPlanResponse plan(
      const MultiPipelinePlanRequestParameters& parameters,
      const SolutionCallbackFunction& solution_selection_callback = &getShortestSolution,
      const StoppingCriterionFunction& stopping_criterion_callback = StoppingCriterionFunction());
  bool execute(bool blocking = true);  // what was planned last
  planning_interface::MotionPlanResponse const& getLastMotionPlanResponse() { return last_plan_solution_; }

private:
  planning_interface::MotionPlanResponse planOnce(const PlanRequestParameters& parameters);

  ros::NodeHandle nh_;
  MoveItCppPtr moveit_cpp_;
  const std::string group_name_;
  const moveit::core::JointModelGroup* joint_model_group_;
  moveit::core::RobotStatePtr considered_start_state_;
  std::vector<moveit_msgs::Constraints> current_goal_constraints_;
  moveit_msgs::TrajectoryConstraints current_trajectory_constraints_;
  moveit_msgs::Constraints current_path_constraints_;
  PlanRequestParameters plan_request_parameters_;
  moveit_msgs::WorkspaceParameters workspace_parameters_;
  bool workspace_parameters_set_ = false;
  planning_interface::MotionPlanResponse last_plan_solution_;
};
}  // namespace moveit_cpp

namespace moveit
{
namespace planning_interface
{
using PlanningComponent [[deprecated("use moveit_cpp")]] = moveit_cpp::PlanningComponent;
using PlanningComponentPtr [[deprecated("use moveit_cpp")]] = moveit_cpp::PlanningComponentPtr;
}  // namespace planning_interface
}  // namespace moveit
