// Adapters that fill requests in.
#include <class_loader/class_loader.hpp>
#include <moveit/kinematic_constraints/utils.h>

#include "adapter.hpp"

namespace default_planner_request_adapters
{
class Empty : public Adapter
{
public:
  std::string getDescription() const override { return "No Op"; }
  bool adaptAndPlan(const PlannerFn& planner, const Scene& scene, const Request& req, Response& res,
                    std::vector<std::size_t>& /*added_path_index*/) const override
  {
    return planner(scene, req, res);
  }
};

// A request without a workspace gets a cube of `default_workspace_bounds` m about the origin.
class FixWorkspaceBounds : public Adapter
{
public:
  void initialize(const ros::NodeHandle& nh) override { extent_ = parameter(nh, "default_workspace_bounds", 10.0); }
  std::string getDescription() const override { return "Fix Workspace Bounds"; }
  bool adaptAndPlan(const PlannerFn& planner, const Scene& scene, const Request& req, Response& res,
                    std::vector<std::size_t>& /*added_path_index*/) const override
  {
    const auto& low = req.workspace_parameters.min_corner;
    const auto& high = req.workspace_parameters.max_corner;
    if (low.x != 0.0 || low.y != 0.0 || low.z != 0.0 || high.x != 0.0 || high.y != 0.0 || high.z != 0.0)
      return planner(scene, req, res);
    Request bounded(req);
    auto& corners = bounded.workspace_parameters;
    corners.min_corner.x = corners.min_corner.y = corners.min_corner.z = -extent_ / 2;
    corners.max_corner.x = corners.max_corner.y = corners.max_corner.z = extent_ / 2;
    return planner(scene, bounded, res);
  }

private:
  double extent_ = 10.0;
};

// Constraints given in subframes and attached bodies become those of links.
class ResolveConstraintFrames : public Adapter
{
public:
  std::string getDescription() const override { return "Resolve constraint frames to robot links"; }
  bool adaptAndPlan(const PlannerFn& planner, const Scene& scene, const Request& req, Response& res,
                    std::vector<std::size_t>& /*added_path_index*/) const override
  {
    Request resolved(req);
    const moveit::core::RobotState start = startOf(scene, req);
    kinematic_constraints::resolveConstraintFrames(start, resolved.path_constraints);
    for (moveit_msgs::Constraints& goal : resolved.goal_constraints)
      kinematic_constraints::resolveConstraintFrames(start, goal);
    return planner(scene, resolved, res);
  }
};
}  // namespace default_planner_request_adapters

CLASS_LOADER_REGISTER_CLASS(default_planner_request_adapters::Empty, planning_request_adapter::PlanningRequestAdapter)
CLASS_LOADER_REGISTER_CLASS(default_planner_request_adapters::FixWorkspaceBounds,
                            planning_request_adapter::PlanningRequestAdapter)
CLASS_LOADER_REGISTER_CLASS(default_planner_request_adapters::ResolveConstraintFrames,
                            planning_request_adapter::PlanningRequestAdapter)
