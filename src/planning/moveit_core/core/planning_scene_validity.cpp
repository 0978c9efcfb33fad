// Scenes: which states and paths are valid, and what they cost.
#include <moveit/planning_scene/planning_scene.h>

#include <algorithm>

#include <moveit/collision_detection/collision_tools.h>
#include <moveit/robot_state/conversions.h>

namespace planning_scene
{
using moveit::core::RobotState;

bool PlanningScene::isStateFeasible(const moveit_msgs::RobotState& state, bool verbose) const
{
  return !state_feasibility_ || isStateFeasible(*getCurrentStateUpdated(state), verbose);
}

bool PlanningScene::isStateFeasible(const RobotState& state, bool verbose) const
{
  return !state_feasibility_ || state_feasibility_(state, verbose);
}

bool PlanningScene::isStateConstrained(const moveit_msgs::RobotState& state, const moveit_msgs::Constraints& constr,
                                       bool verbose) const
{
  return isStateConstrained(*getCurrentStateUpdated(state), constr, verbose);
}

bool PlanningScene::isStateConstrained(const RobotState& state, const moveit_msgs::Constraints& constr, bool verbose) const
{
  ConstraintSet set(robot_model_);
  set.add(constr, *transforms_);
  return set.empty() || isStateConstrained(state, set, verbose);
}

bool PlanningScene::isStateConstrained(const moveit_msgs::RobotState& state, const ConstraintSet& constr, bool verbose) const
{
  return isStateConstrained(*getCurrentStateUpdated(state), constr, verbose);
}

bool PlanningScene::isStateConstrained(const RobotState& state, const ConstraintSet& constr, bool verbose) const
{
  return constr.decide(state, verbose).satisfied;
}

bool PlanningScene::isStateValid(const moveit_msgs::RobotState& state, const std::string& group, bool verbose) const
{
  return isStateValid(*getCurrentStateUpdated(state), group, verbose);
}

bool PlanningScene::isStateValid(const RobotState& state, const std::string& group, bool verbose) const
{
  return !isStateColliding(state, group, verbose) && isStateFeasible(state, verbose);
}

bool PlanningScene::isStateValid(const moveit_msgs::RobotState& state, const moveit_msgs::Constraints& constr,
                                 const std::string& group, bool verbose) const
{
  return isStateValid(*getCurrentStateUpdated(state), constr, group, verbose);
}

bool PlanningScene::isStateValid(const RobotState& state, const moveit_msgs::Constraints& constr, const std::string& group,
                                 bool verbose) const
{
  return isStateValid(state, group, verbose) && isStateConstrained(state, constr, verbose);
}

bool PlanningScene::isStateValid(const RobotState& state, const ConstraintSet& constr, const std::string& group,
                                 bool verbose) const
{
  return isStateValid(state, group, verbose) && isStateConstrained(state, constr, verbose);
}

bool PlanningScene::isPathValid(const moveit_msgs::RobotState& start_state, const moveit_msgs::RobotTrajectory& trajectory,
                                const std::string& group, bool verbose, std::vector<std::size_t>* invalid_index) const
{
  return isPathValid(start_state, trajectory, moveit_msgs::Constraints(), group, verbose, invalid_index);
}

bool PlanningScene::isPathValid(const moveit_msgs::RobotState& start_state, const moveit_msgs::RobotTrajectory& trajectory,
                                const moveit_msgs::Constraints& path_constraints, const std::string& group, bool verbose,
                                std::vector<std::size_t>* invalid_index) const
{
  return isPathValid(start_state, trajectory, path_constraints, std::vector<moveit_msgs::Constraints>(), group, verbose,
                     invalid_index);
}

bool PlanningScene::isPathValid(const moveit_msgs::RobotState& start_state, const moveit_msgs::RobotTrajectory& trajectory,
                                const moveit_msgs::Constraints& path_constraints,
                                const moveit_msgs::Constraints& goal_constraints, const std::string& group, bool verbose,
                                std::vector<std::size_t>* invalid_index) const
{
  return isPathValid(start_state, trajectory, path_constraints, std::vector<moveit_msgs::Constraints>{ goal_constraints },
                     group, verbose, invalid_index);
}

bool PlanningScene::isPathValid(const moveit_msgs::RobotState& start_state, const moveit_msgs::RobotTrajectory& trajectory,
                                const moveit_msgs::Constraints& path_constraints,
                                const std::vector<moveit_msgs::Constraints>& goal_constraints, const std::string& group,
                                bool verbose, std::vector<std::size_t>* invalid_index) const
{
  robot_trajectory::RobotTrajectory path(robot_model_, group);
  path.setRobotTrajectoryMsg(*getCurrentStateUpdated(start_state), trajectory);
  return isPathValid(path, path_constraints, goal_constraints, group, verbose, invalid_index);
}

bool PlanningScene::isPathValid(const robot_trajectory::RobotTrajectory& trajectory,
                                const moveit_msgs::Constraints& path_constraints,
                                const moveit_msgs::Constraints& goal_constraints, const std::string& group, bool verbose,
                                std::vector<std::size_t>* invalid_index) const
{
  return isPathValid(trajectory, path_constraints, std::vector<moveit_msgs::Constraints>{ goal_constraints }, group, verbose,
                     invalid_index);
}

bool PlanningScene::isPathValid(const robot_trajectory::RobotTrajectory& trajectory,
                                const moveit_msgs::Constraints& path_constraints, const std::string& group, bool verbose,
                                std::vector<std::size_t>* invalid_index) const
{
  return isPathValid(trajectory, path_constraints, std::vector<moveit_msgs::Constraints>(), group, verbose, invalid_index);
}

bool PlanningScene::isPathValid(const robot_trajectory::RobotTrajectory& trajectory, const std::string& group, bool verbose,
                                std::vector<std::size_t>* invalid_index) const
{
  return isPathValid(trajectory, moveit_msgs::Constraints(), group, verbose, invalid_index);
}

bool PlanningScene::isPathValid(const robot_trajectory::RobotTrajectory& trajectory,
                                const moveit_msgs::Constraints& path_constraints,
                                const std::vector<moveit_msgs::Constraints>& goal_constraints, const std::string& group,
                                bool verbose, std::vector<std::size_t>* invalid_index) const
{
  if (invalid_index)
    invalid_index->clear();
  ConstraintSet on_the_way(robot_model_);
  on_the_way.add(path_constraints, *transforms_);
  bool valid = true;
  for (std::size_t i = 0; i < trajectory.getWayPointCount(); ++i)
  {
    const RobotState& state = trajectory.getWayPoint(i);
    bool good = isStateValid(state, group, verbose) && (on_the_way.empty() || on_the_way.decide(state, verbose).satisfied);
    if (good && i + 1 == trajectory.getWayPointCount() && !goal_constraints.empty())
      good = std::any_of(goal_constraints.begin(), goal_constraints.end(),
                         [&](const moveit_msgs::Constraints& goal) { return isStateConstrained(state, goal, verbose); });
    if (good)
      continue;
    valid = false;
    if (!invalid_index)
      return false;
    invalid_index->push_back(i);
  }
  return valid;
}

void PlanningScene::getCostSources(const RobotState& state, std::size_t max_costs, const std::string& group_name,
                                   std::set<collision_detection::CostSource>& costs) const
{
  Request request;
  request.cost = true;
  request.max_cost_sources = max_costs;
  request.group_name = group_name;
  Result result;
  checkCollision(request, result, state);
  costs.swap(result.cost_sources);
}

void PlanningScene::getCostSources(const robot_trajectory::RobotTrajectory& trajectory, std::size_t max_costs,
                                   const std::string& group_name, std::set<collision_detection::CostSource>& costs,
                                   double overlap_fraction) const
{
  std::set<collision_detection::CostSource> all, of_start;
  for (std::size_t i = 0; i < trajectory.getWayPointCount(); ++i)
  {
    std::set<collision_detection::CostSource> found;
    getCostSources(trajectory.getWayPoint(i), max_costs, group_name, found);
    all.insert(found.begin(), found.end());
    if (i == 0)
      of_start = found;
  }
  costs.clear();
  for (auto dearest = all.begin(); dearest != all.end() && costs.size() < max_costs; ++dearest)
    costs.insert(*dearest);
  collision_detection::removeCostSources(costs, of_start, overlap_fraction);
  collision_detection::removeOverlapping(costs, overlap_fraction);
}
}  // namespace planning_scene
