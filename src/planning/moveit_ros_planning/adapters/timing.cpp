// Adapters that turn paths into trajectories.
#include <class_loader/class_loader.hpp>
#include <moveit/trajectory_processing/iterative_spline_parameterization.h>
#include <moveit/trajectory_processing/iterative_time_parameterization.h>
#include <moveit/trajectory_processing/limit_cartesian_speed.h>
#include <moveit/trajectory_processing/time_optimal_trajectory_generation.h>

#include "adapter.hpp"

namespace default_planner_request_adapters
{
// Plans, then changes the trajectory that came.
class AfterPlanning : public Adapter
{
public:
  bool adaptAndPlan(const PlannerFn& planner, const Scene& scene, const Request& req, Response& res,
                    std::vector<std::size_t>& /*added_path_index*/) const override
  {
    if (!planner(scene, req, res))
      return false;
    if (!res.trajectory_ || process(*res.trajectory_, req))
      return true;
    ROS_ERROR("'%s' failed for the solution path", getDescription().c_str());
    res.error_code_.val = moveit_msgs::MoveItErrorCodes::FAILURE;
    return false;
  }

protected:
  virtual bool process(robot_trajectory::RobotTrajectory& trajectory, const Request& req) const = 0;
};

template <typename Timing>
class AddTiming : public AfterPlanning
{
protected:
  bool process(robot_trajectory::RobotTrajectory& trajectory, const Request& req) const override
  {
    return timing_.computeTimeStamps(trajectory, req.max_velocity_scaling_factor, req.max_acceleration_scaling_factor);
  }

private:
  Timing timing_;
};

class AddTimeParameterization : public AddTiming<trajectory_processing::IterativeParabolicTimeParameterization>
{
public:
  std::string getDescription() const override { return "Add Time Parameterization"; }
};

class AddIterativeSplineParameterization : public AddTiming<trajectory_processing::IterativeSplineParameterization>
{
public:
  std::string getDescription() const override { return "Add Iterative Spline Parameterization"; }
};

class AddTimeOptimalParameterization : public AfterPlanning
{
public:
  void initialize(const ros::NodeHandle& nh) override
  {
    nh.getParam("path_tolerance", path_tolerance_);
    nh.getParam("resample_dt", resample_dt_);
    nh.getParam("min_angle_change", min_angle_change_);
  }
  std::string getDescription() const override { return "Add Time Optimal Parameterization"; }

protected:
  bool process(robot_trajectory::RobotTrajectory& trajectory, const Request& req) const override
  {
    return trajectory_processing::TimeOptimalTrajectoryGeneration(path_tolerance_, resample_dt_, min_angle_change_)
        .computeTimeStamps(trajectory, req.max_velocity_scaling_factor, req.max_acceleration_scaling_factor);
  }

private:
  double path_tolerance_ = 0.1, resample_dt_ = 0.1, min_angle_change_ = 0.001;
};

class LimitMaxCartesianLinkSpeed : public AfterPlanning
{
public:
  std::string getDescription() const override { return "Limiting Max Cartesian Speed"; }

protected:
  bool process(robot_trajectory::RobotTrajectory& trajectory, const Request& req) const override
  {
    return req.max_cartesian_speed <= 0.0 || trajectory_processing::limitMaxCartesianLinkSpeed(
                                                 trajectory, req.max_cartesian_speed, req.cartesian_speed_limited_link);
  }
};
}  // namespace default_planner_request_adapters

CLASS_LOADER_REGISTER_CLASS(default_planner_request_adapters::AddTimeParameterization,
                            planning_request_adapter::PlanningRequestAdapter)
CLASS_LOADER_REGISTER_CLASS(default_planner_request_adapters::AddIterativeSplineParameterization,
                            planning_request_adapter::PlanningRequestAdapter)
CLASS_LOADER_REGISTER_CLASS(default_planner_request_adapters::AddTimeOptimalParameterization,
                            planning_request_adapter::PlanningRequestAdapter)
CLASS_LOADER_REGISTER_CLASS(default_planner_request_adapters::LimitMaxCartesianLinkSpeed,
                            planning_request_adapter::PlanningRequestAdapter)
