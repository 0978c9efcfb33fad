// Planners as classes in C++. None is exported here: move_group has its own; a program that brings one can use it by itself.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <moveit/macros/class_forward.h>
#include <moveit/planning_interface/planning_request.h>
#include <moveit/planning_interface/planning_response.h>

namespace planning_scene
{
MOVEIT_CLASS_FORWARD(PlanningScene);
}

namespace planning_interface
{
struct PlannerConfigurationSettings
{
  std::string group, name;
  std::map<std::string, std::string> config;
};
typedef std::map<std::string, PlannerConfigurationSettings> PlannerConfigurationMap;

MOVEIT_CLASS_FORWARD(PlanningContext);

class PlanningContext
{
public:
  PlanningContext(const std::string& name, const std::string& group) : name_(name), group_(group) {}
  virtual ~PlanningContext() {}
  const std::string& getGroupName() const { return group_; }
  const std::string& getName() const { return name_; }
  const planning_scene::PlanningSceneConstPtr& getPlanningScene() const { return planning_scene_; }
  const MotionPlanRequest& getMotionPlanRequest() const { return request_; }
  void setPlanningScene(const planning_scene::PlanningSceneConstPtr& planning_scene) { planning_scene_ = planning_scene; }
  void setMotionPlanRequest(const MotionPlanRequest& request) { request_ = request; }
  virtual bool solve(MotionPlanResponse& res) = 0;
  virtual bool solve(MotionPlanDetailedResponse& res) = 0;
  virtual bool terminate() = 0;
  virtual void clear() = 0;

protected:
  std::string name_, group_;
  planning_scene::PlanningSceneConstPtr planning_scene_;
  MotionPlanRequest request_;
};

MOVEIT_CLASS_FORWARD(PlannerManager);

class PlannerManager
{
public:
  virtual ~PlannerManager() {}
  virtual bool initialize(const moveit::core::RobotModelConstPtr& /*model*/, const std::string& /*ns*/) { return true; }
  virtual std::string getDescription() const { return ""; }
  virtual void getPlanningAlgorithms(std::vector<std::string>& algs) const { algs.clear(); }
  virtual PlanningContextPtr getPlanningContext(const planning_scene::PlanningSceneConstPtr& planning_scene,
                                                const MotionPlanRequest& req,
                                                moveit_msgs::MoveItErrorCodes& error_code) const = 0;
  PlanningContextPtr getPlanningContext(const planning_scene::PlanningSceneConstPtr& planning_scene,
                                        const MotionPlanRequest& req) const
  {
    moveit_msgs::MoveItErrorCodes unused;
    return getPlanningContext(planning_scene, req, unused);
  }
  virtual bool canServiceRequest(const MotionPlanRequest& req) const = 0;
  virtual void setPlannerConfigurations(const PlannerConfigurationMap& pcs) { config_settings_ = pcs; }
  const PlannerConfigurationMap& getPlannerConfigurations() const { return config_settings_; }

protected:
  PlannerConfigurationMap config_settings_;
};
}  // namespace planning_interface
