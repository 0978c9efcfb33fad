// A planner and the adapters around it, loaded by pluginlib and named by parameters.
#pragma once

#include <ros/ros.h>

#include <atomic>
#include <memory>
#include <pluginlib/class_loader.hpp>
#include <string>
#include <vector>

#include <moveit/planning_interface/planning_interface.h>
#include <moveit/planning_request_adapter/planning_request_adapter.h>

namespace planning_pipeline
{
class PlanningPipeline
{
public:
  // Below the node's own name.
  static const std::string DISPLAY_PATH_TOPIC;         // display_planned_path, moveit_msgs/DisplayTrajectory
  static const std::string MOTION_PLAN_REQUEST_TOPIC;  // motion_plan_request, moveit_msgs/MotionPlanRequest
  static const std::string MOTION_CONTACTS_TOPIC;      // display_contacts, visualization_msgs/MarkerArray

  // The planner that the first parameter of pipeline_nh names, and the adapters of the second, separated by blanks, the outermost
  // first. What cannot be loaded is told in the log and left out; without a planner generatePlan() fails.
  PlanningPipeline(const moveit::core::RobotModelConstPtr& model, const ros::NodeHandle& pipeline_nh = ros::NodeHandle("~"),
                   const std::string& planning_plugin_param_name = "planning_plugin",
                   const std::string& adapter_plugins_param_name = "request_adapters");
  PlanningPipeline(const moveit::core::RobotModelConstPtr& model, const ros::NodeHandle& pipeline_nh,
                   const std::string& planning_plugin_name, const std::vector<std::string>& adapter_plugin_names);
  PlanningPipeline(const PlanningPipeline&) = delete;
  PlanningPipeline& operator=(const PlanningPipeline&) = delete;

  void displayComputedMotionPlans(bool flag);  // on by itself
  void publishReceivedRequests(bool flag);
  void checkSolutionPaths(bool flag);  // on by itself
  bool getDisplayComputedMotionPlans() const { return display_computed_motion_plans_; }
  bool getPublishReceivedRequests() const { return publish_received_requests_; }
  bool getCheckSolutionPaths() const { return check_solution_paths_; }

  bool generatePlan(const planning_scene::PlanningSceneConstPtr& planning_scene,
                    const planning_interface::MotionPlanRequest& req, planning_interface::MotionPlanResponse& res) const;
  // Also which way points adapters have added without planning: these may be invalid.
  bool generatePlan(const planning_scene::PlanningSceneConstPtr& planning_scene,
                    const planning_interface::MotionPlanRequest& req, planning_interface::MotionPlanResponse& res,
                    std::vector<std::size_t>& adapter_added_state_index) const;
  void terminate() const;  // from another thread

  const std::string& getPlannerPluginName() const { return planner_plugin_name_; }
  const std::vector<std::string>& getAdapterPluginNames() const { return adapter_plugin_names_; }
  const planning_interface::PlannerManagerPtr& getPlannerManager() { return planner_instance_; }  // null when there is none
  const moveit::core::RobotModelConstPtr& getRobotModel() const { return robot_model_; }
  bool isActive() const { return active_; }

private:
  void configure();
  void loadPlanner();
  void loadAdapters();
  bool plan(const planning_scene::PlanningSceneConstPtr& scene, const planning_interface::MotionPlanRequest& req,
            planning_interface::MotionPlanResponse& res, std::vector<std::size_t>& added) const;
  bool check(const planning_scene::PlanningScene& scene, const planning_interface::MotionPlanRequest& req,
             planning_interface::MotionPlanResponse& res, const std::vector<std::size_t>& added) const;
  void display(const robot_trajectory::RobotTrajectory& trajectory) const;

  mutable std::atomic<bool> active_{ false };
  ros::NodeHandle pipeline_nh_, private_nh_{ "~" };
  bool display_computed_motion_plans_ = false, publish_received_requests_ = false, check_solution_paths_ = false;
  ros::Publisher display_path_publisher_, received_request_publisher_, contacts_publisher_;
  // The loaders outlive what they have made.
  std::unique_ptr<pluginlib::ClassLoader<planning_interface::PlannerManager>> planner_plugin_loader_;
  planning_interface::PlannerManagerPtr planner_instance_;
  std::string planner_plugin_name_;
  std::unique_ptr<pluginlib::ClassLoader<planning_request_adapter::PlanningRequestAdapter>> adapter_plugin_loader_;
  std::unique_ptr<planning_request_adapter::PlanningRequestAdapterChain> adapter_chain_;
  std::vector<std::string> adapter_plugin_names_;
  moveit::core::RobotModelConstPtr robot_model_;
};

MOVEIT_CLASS_FORWARD(PlanningPipeline);
}  // namespace planning_pipeline
