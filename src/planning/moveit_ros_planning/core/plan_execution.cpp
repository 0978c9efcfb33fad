// Execution of plans under the eyes of a scene monitor.
#include <moveit/plan_execution/plan_execution.h>

#include <optional>

#include <moveit/planning_scene_monitor/trajectory_monitor.h>
#include <moveit/utils/message_checks.h>

#include "dynamic_settings.hpp"
#include "laws/execution.hpp"
#include "log_names.hpp"

namespace plan_execution
{
namespace
{
using Codes = moveit_msgs::MoveItErrorCodes;
using planning_scene_monitor::LockedPlanningSceneRO;
using moveit_ros_planning::DynamicSettings;
using planning_scene_monitor::PlanningSceneMonitor;

int codeOf(const moveit_controller_manager::ExecutionStatus& status)
{
  if (status == moveit_controller_manager::ExecutionStatus::SUCCEEDED)
    return Codes::SUCCESS;
  return status == moveit_controller_manager::ExecutionStatus::TIMED_OUT ? Codes::TIMED_OUT : Codes::CONTROL_FAILED;
}
}  // namespace

PlanExecution::PlanExecution(const planning_scene_monitor::PlanningSceneMonitorPtr& planning_scene_monitor,
                             const trajectory_execution_manager::TrajectoryExecutionManagerPtr& trajectory_execution)
  : monitor_(planning_scene_monitor)
  , execution_(trajectory_execution)
  , scene_changed_(std::make_shared<std::atomic<bool>>(false))
{
  if (!execution_)
    execution_ = std::make_shared<trajectory_execution_manager::TrajectoryExecutionManager>(monitor_->getRobotModel(),
                                                                                            monitor_->getStateMonitor());
  monitor_->addUpdateCallback([changed = scene_changed_](PlanningSceneMonitor::SceneUpdateType type) {
    if (type & (PlanningSceneMonitor::UPDATE_GEOMETRY | PlanningSceneMonitor::UPDATE_TRANSFORMS))
      *changed = true;
  });
  settings_ =
      std::make_unique<DynamicSettings>(ros::NodeHandle("~/plan_execution"), execution::planParameters(),
                                        log_names::PLAN_EXECUTION, [this](const DynamicSettings::Values& given) {
                                          setMaxReplanAttempts(given.at("max_replan_attempts"));
                                          setTrajectoryStateRecordingFrequency(given.at("record_trajectory_state_frequency"));
                                        });
}

PlanExecution::~PlanExecution() = default;

// ---------------------------------------------------------------- planning

void PlanExecution::planAndExecute(ExecutableMotionPlan& plan, const Options& opt)
{
  plan.planning_scene_monitor_ = monitor_;
  plan.planning_scene_ = monitor_->getPlanningScene();
  replan(plan, opt);
}

void PlanExecution::planAndExecute(ExecutableMotionPlan& plan, const moveit_msgs::PlanningScene& scene_diff, const Options& opt)
{
  if (moveit::core::isEmpty(scene_diff))
    return planAndExecute(plan, opt);
  plan.planning_scene_monitor_ = monitor_;
  {
    const LockedPlanningSceneRO scene(monitor_);
    plan.planning_scene_ = scene->diff(scene_diff);
  }
  replan(plan, opt);
}

void PlanExecution::replan(ExecutableMotionPlan& plan, const Options& opt)
{
  preempt_ = false;
  const unsigned int most = !opt.replan_ ? 1 : (opt.replan_attempts_ > 0 ? opt.replan_attempts_ : getMaxReplanAttempts());
  bool solved = false, again = true;
  for (unsigned int i = 1; i <= most && again; ++i)
  {
    ROS_INFO_NAMED(log_names::PLAN_EXECUTION, "Planning attempt %u of at most %u", i, most);
    again = attempt(plan, opt, solved && opt.repair_plan_callback_, solved);
  }
  if (preempt_.exchange(false))
    plan.error_code_.val = Codes::PREEMPTED;
  if (opt.done_callback_)
    opt.done_callback_();
}

// True when another attempt is to be made.
bool PlanExecution::attempt(ExecutableMotionPlan& plan, const Options& opt, bool repair, bool& solved)
{
  if (opt.before_plan_callback_)
    opt.before_plan_callback_();
  *scene_changed_ = false;  // the plan that is made now knows
  const bool found =
      repair ? opt.repair_plan_callback_(plan, execution_->getCurrentExpectedTrajectoryIndex()) : opt.plan_callback_(plan);
  if (preempt_)
    return false;
  solved = solved || found;
  if (found && plan.error_code_.val == Codes::SUCCESS)
  {
    if (opt.before_execution_callback_)
      opt.before_execution_callback_();
    if (preempt_)
      return false;
    plan.error_code_ = executeAndMonitor(plan, false);
  }
  if (!execution::mayPlanAgain(plan.error_code_.val))
    return false;
  if (execution::waitsBeforePlanning(plan.error_code_.val))
    ros::WallDuration(opt.replan_delay_).sleep();
  return !preempt_;
}

// ---------------------------------------------------------------- execution

moveit_msgs::MoveItErrorCodes PlanExecution::executeAndMonitor(ExecutableMotionPlan& plan, bool reset_preempted)
{
  if (reset_preempted)
    preempt_ = false;
  if (!plan.planning_scene_monitor_)
    plan.planning_scene_monitor_ = monitor_;
  if (!plan.planning_scene_)
    plan.planning_scene_ = monitor_->getPlanningScene();
  moveit_msgs::MoveItErrorCodes result;
  result.val = Codes::SUCCESS;
  if (plan.plan_components_.empty())
    return result;
  if (!push(plan))
  {
    ROS_ERROR_NAMED(log_names::PLAN_EXECUTION, "Apparently trajectory initialization failed");
    execution_->clear();
    result.val = Codes::CONTROL_FAILED;
    return result;
  }
  complete_ = invalid_ = false;
  std::optional<planning_scene_monitor::TrajectoryMonitor> recorder;
  if (monitor_->getStateMonitor())
    recorder.emplace(monitor_->getStateMonitor(), recording_frequency_);
  if (recorder)
    recorder->startTrajectoryMonitor();
  execution_->execute([this](const moveit_controller_manager::ExecutionStatus&) { complete_ = true; },
                      [this, &plan](std::size_t index) { succeeded(plan, index); });
  bool preempted = false;
  watch(plan, preempted);
  if (preempted || !complete_)
    execution_->stopExecution();
  execution_->waitForExecution();  // its last callback holds the plan
  if (recorder)
  {
    recorder->stopTrajectoryMonitor();
    plan.executed_trajectory_ = std::make_shared<robot_trajectory::RobotTrajectory>(monitor_->getRobotModel(), "");
    recorder->swapTrajectory(*plan.executed_trajectory_);
  }
  result.val = invalid_    ? Codes::MOTION_PLAN_INVALIDATED_BY_ENVIRONMENT_CHANGE
               : preempted ? Codes::PREEMPTED
                           : codeOf(execution_->getLastExecutionStatus());
  return result;
}

bool PlanExecution::push(ExecutableMotionPlan& plan)
{
  for (std::size_t i = 0; i < plan.plan_components_.size(); ++i)
  {
    const ExecutableTrajectory& part = plan.plan_components_[i];
    moveit_msgs::RobotTrajectory message;
    if (part.trajectory_)
    {
      unwind(plan, i);
      part.trajectory_->getRobotTrajectoryMsg(message);
    }
    if (!execution_->push(message, part.controller_names_))
      return false;
  }
  return true;
}

// Continuous joints go on from where the trajectory before leaves them, those of the first from where they are.
void PlanExecution::unwind(ExecutableMotionPlan& plan, std::size_t index) const
{
  robot_trajectory::RobotTrajectory& trajectory = *plan.plan_components_[index].trajectory_;
  std::vector<std::optional<std::string>> groups;
  for (const ExecutableTrajectory& part : plan.plan_components_)
    groups.push_back(part.trajectory_ && !part.trajectory_->empty() ? std::optional(part.trajectory_->getGroupName())
                                                                    : std::nullopt);
  const int before = execution::goesOnFrom(groups, index);
  if (before >= 0)
    trajectory.unwind(plan.plan_components_[before].trajectory_->getLastWayPoint());
  else if (plan.planning_scene_monitor_->getStateMonitor())
    trajectory.unwind(*plan.planning_scene_monitor_->getStateMonitor()->getCurrentState());
  else
    trajectory.unwind(plan.planning_scene_->getCurrentState());
}

// Until it is over, is to end, or would collide.
void PlanExecution::watch(const ExecutableMotionPlan& plan, bool& preempted)
{
  ros::WallRate rate(100);
  while (ros::ok() && !complete_ && !invalid_)
  {
    rate.sleep();
    if (scene_changed_->exchange(false))
    {
      const std::pair<int, int> place = execution_->getCurrentExpectedTrajectoryIndex();
      if (!isRemainingPathValid(plan, place))
      {
        ROS_WARN_NAMED(log_names::PLAN_EXECUTION, "Trajectory component '%s' is invalid after scene update",
                       plan.plan_components_[place.first].description_.c_str());
        invalid_ = true;
      }
    }
    if (preempt_.exchange(false))
    {
      ROS_INFO_NAMED(log_names::PLAN_EXECUTION, "Stopping execution due to preempt request");
      preempted = true;
      return;
    }
  }
}

bool PlanExecution::isRemainingPathValid(const ExecutableMotionPlan& plan, const std::pair<int, int>& place) const
{
  if (place.first < 0 || place.first >= static_cast<int>(plan.plan_components_.size()))
    return true;
  const ExecutableTrajectory& part = plan.plan_components_[place.first];
  if (!part.trajectory_monitoring_ || !part.trajectory_)
    return true;
  const LockedPlanningSceneRO lock(plan.planning_scene_monitor_);
  const planning_scene::PlanningScene& scene = *plan.planning_scene_;
  collision_detection::CollisionRequest request;
  request.group_name = part.trajectory_->getGroupName();
  const auto& acm = part.allowed_collision_matrix_ ? *part.allowed_collision_matrix_ : scene.getAllowedCollisionMatrix();
  moveit::core::RobotState state(scene.getCurrentState());
  const auto valid = [&](const motion::RobotState& way_point) {
    state.setCore(way_point);
    collision_detection::CollisionResult result;
    scene.checkCollisionUnpadded(request, result, state, acm);
    return !result.collision && scene.isStateFeasible(state);
  };
  const auto at = [&](std::size_t i) { return part.trajectory_->getWayPoint(i).core(); };
  return execution::firstInvalid(part.trajectory_->getWayPointCount(), place.second, at, scene.getCurrentState().core(),
                                 valid) < 0;
}

void PlanExecution::succeeded(const ExecutableMotionPlan& plan, std::size_t index)
{
  if (index >= plan.plan_components_.size())
    return;
  const ExecutableTrajectory& part = plan.plan_components_[index];
  ROS_DEBUG_NAMED(log_names::PLAN_EXECUTION, "Completed '%s'", part.description_.c_str());
  if (part.effect_on_success_ && !part.effect_on_success_(&plan))
  {
    ROS_ERROR_NAMED(log_names::PLAN_EXECUTION, "Execution of path-completion side-effect failed. Preempting.");
    preempt_ = true;
    return;
  }
  const std::pair<int, int> next(static_cast<int>(index) + 1, 0);
  if (!isRemainingPathValid(plan, next))
  {
    ROS_INFO_NAMED(log_names::PLAN_EXECUTION, "Upcoming trajectory component '%s' is invalid",
                   plan.plan_components_[next.first].description_.c_str());
    invalid_ = true;
  }
}
}  // namespace plan_execution
