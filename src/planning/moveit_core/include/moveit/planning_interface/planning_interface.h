// Planners as classes: what a plug-in exports as planning_interface::PlannerManager.
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
  std::string group, name;  // the name is `group` (its default) or `group[config]`
  std::map<std::string, std::string> config;
};
typedef std::map<std::string, PlannerConfigurationSettings> PlannerConfigurationMap;

MOVEIT_CLASS_FORWARD(PlanningContext);

// One problem: a scene and a request, which solve() answers.
class PlanningContext
{
public:
  PlanningContext(const std::string& name, const std::string& group);
  virtual ~PlanningContext();
  PlanningContext(const PlanningContext&) = delete;
  PlanningContext& operator=(const PlanningContext&) = delete;
  const std::string& getGroupName() const { return group_; }
  const std::string& getName() const { return name_; }
  const planning_scene::PlanningSceneConstPtr& getPlanningScene() const { return planning_scene_; }
  const MotionPlanRequest& getMotionPlanRequest() const { return request_; }
  void setPlanningScene(const planning_scene::PlanningSceneConstPtr& planning_scene) { planning_scene_ = planning_scene; }
  void setMotionPlanRequest(const MotionPlanRequest& request);  // with a time and attempts of at least something
  virtual bool solve(MotionPlanResponse& res) = 0;
  virtual bool solve(MotionPlanDetailedResponse& res) = 0;
  virtual bool terminate() = 0;  // from another thread; false when that cannot be done
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
  PlannerManager() {}
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
  void terminate() const;  // all contexts of this process

protected:
  PlannerConfigurationMap config_settings_;
};
}  // namespace planning_interface
