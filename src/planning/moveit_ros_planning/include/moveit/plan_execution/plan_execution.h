// Executes plans, and stops where the scene has changed so that the rest would collide.
#pragma once

#include <atomic>
#include <boost/function.hpp>
#include <utility>

#include <moveit/macros/class_forward.h>
#include <moveit/plan_execution/plan_representation.h>
#include <moveit/planning_scene_monitor/planning_scene_monitor.h>
#include <moveit/trajectory_execution_manager/trajectory_execution_manager.h>

namespace moveit_ros_planning
{
class DynamicSettings;
}

namespace plan_execution
{
MOVEIT_CLASS_FORWARD(PlanExecution);

class PlanExecution
{
public:
  struct Options
  {
    bool replan_ = false;
    unsigned int replan_attempts_ = 0;  // 0: as setMaxReplanAttempts() says
    double replan_delay_ = 0.0;         // s
    ExecutableMotionPlanComputationFn plan_callback_;
    // Instead of planning anew, from where the controllers have got to: (trajectory, way point).
    boost::function<bool(ExecutableMotionPlan& plan_to_update, const std::pair<int, int>& trajectory_index)>
        repair_plan_callback_;
    boost::function<void()> before_plan_callback_, before_execution_callback_, done_callback_;
  };

  PlanExecution(const planning_scene_monitor::PlanningSceneMonitorPtr& planning_scene_monitor,
                const trajectory_execution_manager::TrajectoryExecutionManagerPtr& trajectory_execution);
  ~PlanExecution();

  const planning_scene_monitor::PlanningSceneMonitorPtr& getPlanningSceneMonitor() const { return monitor_; }
  const trajectory_execution_manager::TrajectoryExecutionManagerPtr& getTrajectoryExecutionManager() const
  {
    return execution_;
  }
  void setMaxReplanAttempts(unsigned int attempts) { default_max_replan_attempts_ = attempts; }
  unsigned int getMaxReplanAttempts() const { return default_max_replan_attempts_; }

  // States a second of what is executed that go into a plan's executed_trajectory_; 0, the default: none.
  void setTrajectoryStateRecordingFrequency(double hz) { recording_frequency_ = hz; }
  double getTrajectoryStateRecordingFrequency() const { return recording_frequency_; }

  // The result is in plan.error_code_.
  void planAndExecute(ExecutableMotionPlan& plan, const Options& opt);
  void planAndExecute(ExecutableMotionPlan& plan, const moveit_msgs::PlanningScene& scene_diff, const Options& opt);
  moveit_msgs::MoveItErrorCodes executeAndMonitor(ExecutableMotionPlan& plan, bool reset_preempted = true);
  void stop() { preempt_ = true; }  // from another thread

private:
  void replan(ExecutableMotionPlan& plan, const Options& opt);
  bool attempt(ExecutableMotionPlan& plan, const Options& opt, bool repair, bool& solved);
  bool push(ExecutableMotionPlan& plan);
  void unwind(ExecutableMotionPlan& plan, std::size_t index) const;
  void watch(const ExecutableMotionPlan& plan, bool& preempted);
  bool isRemainingPathValid(const ExecutableMotionPlan& plan, const std::pair<int, int>& place) const;
  void succeeded(const ExecutableMotionPlan& plan, std::size_t index);

  planning_scene_monitor::PlanningSceneMonitorPtr monitor_;
  trajectory_execution_manager::TrajectoryExecutionManagerPtr execution_;
  std::atomic<unsigned int> default_max_replan_attempts_{ 5 };
  std::atomic<double> recording_frequency_{ 0.0 };
  std::atomic<bool> preempt_{ false }, complete_{ false }, invalid_{ false };
  std::shared_ptr<std::atomic<bool>> scene_changed_;  // the monitor's callback may outlive this
  std::unique_ptr<moveit_ros_planning::DynamicSettings> settings_;
};
}  // namespace plan_execution
