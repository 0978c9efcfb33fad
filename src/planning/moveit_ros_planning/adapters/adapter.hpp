// What the default request adapters share.
#pragma once

#include <moveit/planning_request_adapter/planning_request_adapter.h>
#include <moveit/robot_state/conversions.h>
#include <ros/ros.h>

#include <algorithm>
#include <string>
#include <vector>

namespace default_planner_request_adapters
{
class Adapter : public planning_request_adapter::PlanningRequestAdapter
{
public:
  using planning_request_adapter::PlanningRequestAdapter::adaptAndPlan;
  void initialize(const ros::NodeHandle& /*nh*/) override {}

protected:
  using Scene = planning_scene::PlanningSceneConstPtr;
  using Request = planning_interface::MotionPlanRequest;
  using Response = planning_interface::MotionPlanResponse;

  // A number of the pipeline, whole or not.
  static double parameter(const ros::NodeHandle& nh, const std::string& name, double standard)
  {
    double value = standard;
    const bool set = nh.getParam(name, value);
    ROS_INFO_STREAM("Param '" << name << "' was " << (set ? "set to " : "not set. Using default value: ") << value);
    return value;
  }

  static moveit::core::RobotState startOf(const Scene& scene, const Request& req)
  {
    moveit::core::RobotState start = scene->getCurrentState();
    moveit::core::robotStateMsgToRobotState(scene->getTransforms(), req.start_state, start);
    start.update();
    return start;
  }

  // The true start in front of a path that was planned from another state; at most `most` s between the two.
  static void addStart(const moveit::core::RobotState& start, double most, Response& res, std::vector<std::size_t>& added)
  {
    if (!res.trajectory_ || res.trajectory_->empty())
      return;
    res.trajectory_->setWayPointDurationFromPrevious(0, std::min(most, res.trajectory_->getAverageSegmentDuration()));
    res.trajectory_->addPrefixWayPoint(start, 0.0);
    for (std::size_t& index : added)
      ++index;
    added.push_back(0);
  }
};
}  // namespace default_planner_request_adapters
