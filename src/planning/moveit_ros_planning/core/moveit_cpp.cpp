#include <moveit/moveit_cpp/moveit_cpp.h>

#include <stdexcept>

#include "log_names.hpp"

namespace moveit_cpp
{
namespace
{
using planning_scene_monitor::PlanningSceneMonitor;

[[noreturn]] void refuse(const std::string& error)
{
  ROS_FATAL_NAMED(log_names::MOVEIT_CPP, "%s", error.c_str());
  throw std::runtime_error(error);
}
}  // namespace

void MoveItCpp::PlanningSceneMonitorOptions::load(const ros::NodeHandle& nh)
{
  const std::string ns = "planning_scene_monitor_options/";
  nh.param(ns + "name", name, std::string("planning_scene_monitor"));
  nh.param(ns + "robot_description", robot_description, std::string("robot_description"));
  nh.param(ns + "joint_state_topic", joint_state_topic, PlanningSceneMonitor::DEFAULT_JOINT_STATES_TOPIC);
  nh.param(ns + "attached_collision_object_topic", attached_collision_object_topic,
           PlanningSceneMonitor::DEFAULT_ATTACHED_COLLISION_OBJECT_TOPIC);
  nh.param(ns + "monitored_planning_scene_topic", monitored_planning_scene_topic,
           PlanningSceneMonitor::MONITORED_PLANNING_SCENE_TOPIC);
  nh.param(ns + "publish_planning_scene_topic", publish_planning_scene_topic,
           PlanningSceneMonitor::DEFAULT_PLANNING_SCENE_TOPIC);
  nh.param(ns + "wait_for_initial_state_timeout", wait_for_initial_state_timeout, 0.0);
}

void MoveItCpp::PlanningPipelineOptions::load(const ros::NodeHandle& nh)
{
  nh.getParam("planning_pipelines/pipeline_names", pipeline_names);
  nh.getParam("planning_pipelines/namespace", parent_namespace);
}

MoveItCpp::MoveItCpp(const ros::NodeHandle& nh, const std::shared_ptr<tf2_ros::Buffer>& tf_buffer)
  : MoveItCpp(Options(nh), nh, tf_buffer)
{
}

MoveItCpp::MoveItCpp(const Options& options, const ros::NodeHandle& nh, const std::shared_ptr<tf2_ros::Buffer>& tf_buffer)
  : tf_buffer_(tf_buffer)
  , node_handle_(nh)
{
  if (!tf_buffer_)
    tf_buffer_ = std::make_shared<tf2_ros::Buffer>();
  tf_listener_ = std::make_shared<tf2_ros::TransformListener>(*tf_buffer_);
  loadPlanningSceneMonitor(options.planning_scene_monitor_options);
  loadPlanningPipelines(options.planning_pipeline_options);
  trajectory_execution_manager_ = std::make_shared<trajectory_execution_manager::TrajectoryExecutionManager>(
      getRobotModel(), planning_scene_monitor_->getStateMonitor());
}

MoveItCpp::~MoveItCpp() = default;

void MoveItCpp::loadPlanningSceneMonitor(const PlanningSceneMonitorOptions& options)
{
  planning_scene_monitor_ = std::make_shared<PlanningSceneMonitor>(options.robot_description, tf_buffer_, options.name);
  if (!planning_scene_monitor_->getPlanningScene())
    refuse("Unable to construct robot model from parameter '" + options.robot_description +
           "'. Please make sure all needed information is on the parameter server.");
  ROS_INFO_NAMED(log_names::MOVEIT_CPP, "Listening to '%s' for joint states", options.joint_state_topic.c_str());
  planning_scene_monitor_->startStateMonitor(options.joint_state_topic, options.attached_collision_object_topic);
  planning_scene_monitor_->startPublishingPlanningScene(PlanningSceneMonitor::UPDATE_SCENE,
                                                        options.monitored_planning_scene_topic);
  planning_scene_monitor_->startSceneMonitor(options.publish_planning_scene_topic);
  planning_scene_monitor_->startWorldGeometryMonitor();
  if (options.wait_for_initial_state_timeout > 0.0 && !planning_scene_monitor_->getStateMonitor()->waitForCurrentState(
                                                          ros::Time::now(), options.wait_for_initial_state_timeout))
    refuse("Unable to configure planning scene monitor: no complete state of the robot on '" + options.joint_state_topic + "'");
}

void MoveItCpp::loadPlanningPipelines(const PlanningPipelineOptions& options)
{
  const ros::NodeHandle parent(options.parent_namespace.empty() ? "~" : options.parent_namespace);
  for (const std::string& name : options.pipeline_names)
  {
    if (planning_pipelines_.count(name))
    {
      ROS_WARN_NAMED(log_names::MOVEIT_CPP, "Skipping duplicate entry for planning pipeline '%s'.", name.c_str());
      continue;
    }
    ROS_INFO_NAMED(log_names::MOVEIT_CPP, "Loading planning pipeline '%s'", name.c_str());
    const auto pipeline = std::make_shared<planning_pipeline::PlanningPipeline>(getRobotModel(), ros::NodeHandle(parent, name));
    if (pipeline->getPlannerManager())
      planning_pipelines_[name] = pipeline;
    else
      ROS_ERROR_NAMED(log_names::MOVEIT_CPP, "Failed to initialize planning pipeline '%s'.", name.c_str());
  }
  if (planning_pipelines_.empty())
    refuse("Failed to load any planning pipelines: " + node_handle_.resolveName("planning_pipelines/pipeline_names") +
           " names none that can be used");
}

bool MoveItCpp::getCurrentState(moveit::core::RobotStatePtr& current_state, double wait_seconds)
{
  if (wait_seconds > 0.0 && !planning_scene_monitor_->getStateMonitor()->waitForCurrentState(ros::Time::now(), wait_seconds))
  {
    ROS_ERROR_NAMED(log_names::MOVEIT_CPP, "Did not receive robot state");
    return false;
  }
  planning_scene_monitor_->updateSceneWithCurrentState();
  const planning_scene_monitor::LockedPlanningSceneRO scene(planning_scene_monitor_);
  current_state = std::make_shared<moveit::core::RobotState>(scene->getCurrentState());
  return true;
}

moveit::core::RobotStatePtr MoveItCpp::getCurrentState(double wait_seconds)
{
  moveit::core::RobotStatePtr state;
  getCurrentState(state, wait_seconds);
  return state;
}

bool MoveItCpp::execute(const std::string& group_name, const robot_trajectory::RobotTrajectoryPtr& robot_trajectory,
                        bool blocking)
{
  if (!robot_trajectory)
  {
    ROS_ERROR_NAMED(log_names::MOVEIT_CPP, "Robot trajectory is undefined");
    return false;
  }
  if (!trajectory_execution_manager_->ensureActiveControllersForGroup(group_name))
  {
    ROS_ERROR_NAMED(log_names::MOVEIT_CPP, "Execution failed! No active controllers configured for group '%s'",
                    group_name.c_str());
    return false;
  }
  moveit_msgs::RobotTrajectory message;
  robot_trajectory->getRobotTrajectoryMsg(message);
  if (!trajectory_execution_manager_->push(message))
    return false;
  trajectory_execution_manager_->execute();
  return !blocking || static_cast<bool>(trajectory_execution_manager_->waitForExecution());
}

bool MoveItCpp::terminatePlanningPipeline(std::string const& pipeline_name)
{
  const auto found = planning_pipelines_.find(pipeline_name);
  if (found == planning_pipelines_.end())
  {
    ROS_ERROR_NAMED(log_names::MOVEIT_CPP, "Cannot terminate pipeline '%s' because no pipeline with that name exists",
                    pipeline_name.c_str());
    return false;
  }
  if (found->second->isActive())
    found->second->terminate();
  return true;
}
}  // namespace moveit_cpp
