// One request, as the motion library plans it.
#pragma once

#include <moveit/planning_interface/planning_interface.h>
#include <moveit/planning_scene/planning_scene.h>

#include "motion/planning.hpp"

namespace ompl_interface
{
class OMPLContext : public planning_interface::PlanningContext
{
public:
  // `base`: what the planner's configuration says.
  OMPLContext(const std::string& name, const std::string& group, const motion::PlanRequest& base);
  // Start, goals, constraints. False, the code, and a line in the log: they cannot be used.
  bool prepare(const planning_scene::PlanningSceneConstPtr& scene, const planning_interface::MotionPlanRequest& req,
               moveit_msgs::MoveItErrorCodes& error_code);
  bool solve(planning_interface::MotionPlanResponse& res) override;
  bool solve(planning_interface::MotionPlanDetailedResponse& res) override;
  bool terminate() override;
  void clear() override {}

private:
  motion::PlanRequest plan_;
  moveit::core::RobotStatePtr start_;
  motion::CancelFlag cancel_ = std::make_shared<std::atomic<bool>>(false);
};
}  // namespace ompl_interface
