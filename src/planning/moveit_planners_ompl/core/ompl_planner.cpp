// The plugin: contexts for requests, with the planner configurations of its namespace.
#include <pluginlib/class_list_macros.hpp>
#include <ros/node_handle.h>

#include "planner_configs.hpp"
#include "planning_context.hpp"

namespace ompl_interface
{
namespace
{
using moveit_msgs::MoveItErrorCodes;
}  // namespace

class OMPLPlannerManager : public planning_interface::PlannerManager
{
public:
  bool initialize(const moveit::core::RobotModelConstPtr& model, const std::string& ns) override
  {
    model_ = model;
    // As other nodes set them with dynamic_reconfigure: below <ns>/ompl.
    const ros::NodeHandle nh(ns), tuning(nh, "ompl");
    tuning.getParam("simplify_solutions", base_.simplify);
    tuning.getParam("maximum_waypoint_distance", base_.maximum_waypoint_distance);
    tuning.getParam("minimum_waypoint_count", base_.minimum_waypoints);
    setPlannerConfigurations(readPlannerConfigs(*model, nh));
    return true;
  }

  std::string getDescription() const override { return "OMPL"; }

  void getPlanningAlgorithms(std::vector<std::string>& algs) const override
  {
    algs.clear();
    for (const auto& config : config_settings_)
      algs.push_back(config.first);
  }

  // Settings that a client changes are laid over those that are there.
  void setPlannerConfigurations(const planning_interface::PlannerConfigurationMap& pcs) override
  {
    planning_interface::PlannerConfigurationMap all = pcs;
    all.insert(config_settings_.begin(), config_settings_.end());
    PlannerManager::setPlannerConfigurations(all);
  }

  using PlannerManager::getPlanningContext;
  planning_interface::PlanningContextPtr getPlanningContext(const planning_scene::PlanningSceneConstPtr& planning_scene,
                                                            const planning_interface::MotionPlanRequest& req,
                                                            MoveItErrorCodes& error_code) const override
  {
    if (req.group_name.empty())
    {
      ROS_ERROR_NAMED(LOGNAME, "No group specified to plan for");
      error_code.val = MoveItErrorCodes::INVALID_GROUP_NAME;
      return nullptr;
    }
    error_code.val = MoveItErrorCodes::FAILURE;
    if (!planning_scene || !planning_scene->getRobotModel()->hasJointModelGroup(req.group_name))
    {
      ROS_ERROR_NAMED(LOGNAME,
                      planning_scene ? "Cannot find planning configuration for group '%s'"
                                     : "No planning scene supplied as input to plan for group '%s'",
                      req.group_name.c_str());
      return nullptr;
    }
    motion::PlanRequest request(base_);
    applyConfig(findConfig(config_settings_, req.group_name, req.planner_id), request);
    const auto context = std::make_shared<OMPLContext>(req.group_name + "/" + request.planner, req.group_name, request);
    return context->prepare(planning_scene, req, error_code) ? context : nullptr;
  }

  bool canServiceRequest(const planning_interface::MotionPlanRequest& req) const override
  {
    return req.trajectory_constraints.constraints.empty();
  }

private:
  moveit::core::RobotModelConstPtr model_;
  motion::PlanRequest base_;
};
}  // namespace ompl_interface

PLUGINLIB_EXPORT_CLASS(ompl_interface::OMPLPlannerManager, planning_interface::PlannerManager)
