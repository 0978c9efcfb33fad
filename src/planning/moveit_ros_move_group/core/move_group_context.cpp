// The context of compiled capabilities.
#include <moveit/move_group/move_group_context.h>

#include <moveit/moveit_cpp/moveit_cpp.h>
#include <moveit/plan_execution/plan_execution.h>

namespace move_group
{
MoveGroupContext::MoveGroupContext(const moveit_cpp::MoveItCppPtr& moveit_cpp, const std::string& default_planning_pipeline,
                                   bool allow_trajectory_execution, bool debug)
  : moveit_cpp_(moveit_cpp)
  , planning_scene_monitor_(moveit_cpp->getPlanningSceneMonitorNonConst())
  , allow_trajectory_execution_(allow_trajectory_execution)
  , debug_(debug)
{
  const auto& pipelines = moveit_cpp->getPlanningPipelines();
  const auto found = pipelines.find(default_planning_pipeline);
  if (found == pipelines.end())
    ROS_ERROR("Failed to find default PlanningPipeline '%s' - please check MoveGroup's planning pipeline configuration.",
              default_planning_pipeline.c_str());
  else
    planning_pipeline_ = found->second;
  if (!allow_trajectory_execution_)
    return;
  trajectory_execution_manager_ = moveit_cpp_->getTrajectoryExecutionManagerNonConst();
  plan_execution_ = std::make_shared<plan_execution::PlanExecution>(planning_scene_monitor_, trajectory_execution_manager_);
}

MoveGroupContext::~MoveGroupContext() = default;

bool MoveGroupContext::status() const { return planning_pipeline_ && planning_pipeline_->getPlannerManager(); }
}  // namespace move_group
