// Sampling-based planning of a group's motion with OMPL.
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "motion/constraints.hpp"

namespace motion
{
using CancelFlag = std::shared_ptr<std::atomic<bool>>;

struct PlanRequest
{
  std::string group;
  std::vector<Constraints> goals;  // any one of them
  Constraints path;
  std::string planner;  // "RRTConnect", "geometric::RRTConnect", "" (RRTConnect)
  std::map<std::string, std::string> parameters;
  double time = 5.0;  // s, simplification included
  int attempts = 1;
  std::optional<std::uint64_t> seed;
  bool simplify = true, interpolate = true, hybridize = true;
  double segment_fraction = 0.01;          // of the space's extent, between checked states
  double maximum_waypoint_distance = 0.0;  // 0 = as far apart as states are checked
  int minimum_waypoints = 2;
  bool closely = false;    // for planClosely: the path is looked at all along, not only at states `segment_fraction` apart
  std::string projection;  // "joints(a,b)" or "link(l)"
  int goal_samples = 10;
  int threads = 0;  // 0 = up to four
  bool has_workspace = false;
  Vector3 workspace_min = Vector3::Zero(), workspace_max = Vector3::Zero();
  std::function<bool(const RobotState&)> feasible;  // what else a state must be; asked from several threads; may be empty
};

enum class PlanStatus
{
  Solved,
  Approximate,
  Timeout,
  Cancelled,
  InvalidStart,
  StartInCollision,
  StartViolatesPathConstraints,
  NoGoal,
  InvalidGoal,
  GoalInCollision,
  GoalViolatesPathConstraints,
  NoIk,
  UnknownPlanner,
  Failed,
  InvalidPath
};

struct PlanResult
{
  PlanStatus status = PlanStatus::Failed;
  std::string message;
  std::vector<std::vector<double>> path;        // group values
  double planning_time = 0, simplify_time = 0;  // s
  std::size_t states_checked = 0;
  int attempts = 0, goals = 0;
  std::string planner;
  std::vector<std::string> warnings;
  int hit = -1;  // the way point after which the path touches something, when that is its fault (InvalidPath)
};

// Throws UnknownName and InvalidInput for what cannot be asked; whatever else fails is in the result's status.
PlanResult plan(const PlanningScene& scene, const RobotState& start, const PlanRequest& request, const CancelFlag& cancel);

// As `plan`, and the path is looked at closely in the end: a planner looks at states that are `segment_fraction` apart, and a path
// may cut a corner between them. One that does is made of shorter steps.
PlanResult planClosely(const PlanningScene& scene, const RobotState& start, const PlanRequest& request,
                       const CancelFlag& cancel);

// The first way point after which the straight line to the next one touches something; -1 if none does.
int firstHit(const PlanningScene& scene, const RobotState& start, const JointModelGroup& group,
             const std::vector<std::vector<double>>& path);

// What to say of a path that touches something after way point `hit`.
std::string cutsCorners(int hit, std::size_t count);

// Planner name -> its parameters and their defaults.
std::map<std::string, std::map<std::string, std::string>> plannerParameters();
// What is wrong with a planner's name or parameters, "" if nothing.
std::string plannerProblem(const std::string& name, const std::map<std::string, std::string>& parameters);
}  // namespace motion
