// Planning and execution within one program: scene, pipelines and controllers without a move_group.
#pragma once

#include <ros/ros.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include <moveit/macros/class_forward.h>
#include <moveit/macros/declare_ptr.h>
#include <moveit/planning_pipeline/planning_pipeline.h>
#include <moveit/planning_scene_monitor/planning_scene_monitor.h>
#include <moveit/robot_state/robot_state.h>
#include <moveit/trajectory_execution_manager/trajectory_execution_manager.h>

namespace moveit_cpp
{
MOVEIT_CLASS_FORWARD(MoveItCpp);

class MoveItCpp
{
public:
  // Below planning_scene_monitor_options.
  struct PlanningSceneMonitorOptions
  {
    void load(const ros::NodeHandle& nh);
    std::string name, robot_description, joint_state_topic, attached_collision_object_topic, monitored_planning_scene_topic,
        publish_planning_scene_topic;
    double wait_for_initial_state_timeout = 0.0;  // s
  };
  // planning_pipelines/pipeline_names, and the namespace that these are in ("": the node's own).
  struct PlanningPipelineOptions
  {
    void load(const ros::NodeHandle& nh);
    std::vector<std::string> pipeline_names;
    std::string parent_namespace;
  };
  struct Options
  {
    Options(const ros::NodeHandle& nh)
    {
      planning_scene_monitor_options.load(nh);
      planning_pipeline_options.load(nh);
    }
    PlanningSceneMonitorOptions planning_scene_monitor_options;
    PlanningPipelineOptions planning_pipeline_options;
  };

  // Throws std::runtime_error when there is no robot, no state of it within the time, or no pipeline.
  MoveItCpp(const ros::NodeHandle& nh, const std::shared_ptr<tf2_ros::Buffer>& tf_buffer = {});
  MoveItCpp(const Options& options, const ros::NodeHandle& nh, const std::shared_ptr<tf2_ros::Buffer>& tf_buffer = {});
  MoveItCpp(const MoveItCpp&) = delete;
  MoveItCpp& operator=(const MoveItCpp&) = delete;
  MoveItCpp(MoveItCpp&& other) = default;
  MoveItCpp& operator=(MoveItCpp&& other) = default;
  ~MoveItCpp();

  moveit::core::RobotModelConstPtr getRobotModel() const { return planning_scene_monitor_->getRobotModel(); }
  const ros::NodeHandle& getNodeHandle() const { return node_handle_; }
  // With a time (s): not older than now. False when none came.
  bool getCurrentState(moveit::core::RobotStatePtr& current_state, double wait_seconds);
  moveit::core::RobotStatePtr getCurrentState(double wait_seconds = 0.0);
  const std::map<std::string, planning_pipeline::PlanningPipelinePtr>& getPlanningPipelines() const
  {
    return planning_pipelines_;
  }
  planning_scene_monitor::PlanningSceneMonitorConstPtr getPlanningSceneMonitor() const { return planning_scene_monitor_; }
  planning_scene_monitor::PlanningSceneMonitorPtr getPlanningSceneMonitorNonConst() { return planning_scene_monitor_; }
  std::shared_ptr<const tf2_ros::Buffer> getTFBuffer() const { return tf_buffer_; }
  std::shared_ptr<tf2_ros::Buffer> getTFBuffer() { return tf_buffer_; }
  trajectory_execution_manager::TrajectoryExecutionManagerConstPtr getTrajectoryExecutionManager() const
  {
    return trajectory_execution_manager_;
  }
  trajectory_execution_manager::TrajectoryExecutionManagerPtr getTrajectoryExecutionManagerNonConst()
  {
    return trajectory_execution_manager_;
  }
  // Not blocking: returns at once; getTrajectoryExecutionManager() knows how it goes.
  bool execute(const std::string& group_name, const robot_trajectory::RobotTrajectoryPtr& robot_trajectory,
               bool blocking = true);
  bool terminatePlanningPipeline(std::string const& pipeline_name);

protected:
  std::shared_ptr<tf2_ros::Buffer> tf_buffer_;
  std::shared_ptr<tf2_ros::TransformListener> tf_listener_;

private:
  void loadPlanningSceneMonitor(const PlanningSceneMonitorOptions& options);
  void loadPlanningPipelines(const PlanningPipelineOptions& options);

  ros::NodeHandle node_handle_;
  planning_scene_monitor::PlanningSceneMonitorPtr planning_scene_monitor_;
  std::map<std::string, planning_pipeline::PlanningPipelinePtr> planning_pipelines_;
  trajectory_execution_manager::TrajectoryExecutionManagerPtr trajectory_execution_manager_;
};
}  // namespace moveit_cpp

namespace moveit
{
namespace planning_interface
{
using MoveItCpp [[deprecated("use moveit_cpp")]] = moveit_cpp::MoveItCpp;
using MoveItCppPtr [[deprecated("use moveit_cpp")]] = moveit_cpp::MoveItCppPtr;
}  // namespace planning_interface
}  // namespace moveit
