// Paths that are looked at again before they are handed out.
#include <algorithm>
#include <chrono>
#include <cmath>

#include "motion/planning.hpp"
#include "path_walk.hpp"

namespace motion
{
namespace
{
using Rows = std::vector<std::vector<double>>;
constexpr double STEP = 0.01;  // rad or m of any joint, at most, between two looks
constexpr int AGAIN = 3;       // times that a path which cuts a corner is planned again with states nearer to each other

double largestStep(const Rows& path)
{
  double largest = 0;
  for (std::size_t i = 1; i < path.size(); ++i)
  {
    double step = 0;
    for (std::size_t k = 0; k < path[i].size(); ++k)
      step += std::abs(path[i][k] - path[i - 1][k]);
    largest = std::max(largest, step);
  }
  return largest;
}

// Is `b` on the straight line from `a` to `c`, and is that no longer than `spacing` (sum over the joints)?
bool betweenThem(const std::vector<double>& a, const std::vector<double>& b, const std::vector<double>& c, double spacing)
{
  double product = 0, square = 0, length = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
  {
    product += (b[k] - a[k]) * (c[k] - a[k]);
    square += (c[k] - a[k]) * (c[k] - a[k]);
    length += std::abs(c[k] - a[k]);
  }
  const double along = product / std::max(square, 1e-18);
  for (std::size_t k = 0; k < a.size(); ++k)
    if (std::abs(b[k] - a[k] - along * (c[k] - a[k])) > 1e-6)
      return false;
  return length <= spacing * 1.001;
}

// A finer search gives more way points than anybody wants.
Rows thinned(const Rows& path, double spacing)
{
  if (path.size() < 2)
    return path;
  Rows kept{path.front()};
  for (std::size_t i = 1; i + 1 < path.size(); ++i)
    if (!betweenThem(kept.back(), path[i], path[i + 1], spacing))
      kept.push_back(path[i]);
  kept.push_back(path.back());
  return kept;
}

// Of states alone can be asked whether they keep constraints; planar and floating joints do not go straight in their variables.
bool straight(const PlanningScene& scene, const PlanRequest& request)
{
  if (request.feasible || !request.path.empty())
    return false;
  for (int j : scene.model()->group(request.group).active_joints)
    if (!scene.model()->joints[j].singleVariable())
      return false;
  return true;
}
}  // namespace

std::string cutsCorners(int hit, std::size_t count)
{
  return "each path that was found touches something between its way points, the last one after way point " +
         std::to_string(hit + 1) + " of " + std::to_string(count) + "; plan again, with more time";
}

int firstHit(const PlanningScene& scene, const RobotState& start, const JointModelGroup& group, const Rows& path)
{
  std::vector<char> turns;
  for (int j : group.active_joints)
  {
    const JointModel& joint = scene.model()->joints[j];
    if (!joint.singleVariable())
      return -1;  // planar and floating joints do not go straight in their variables
    turns.push_back(joint.continuous);
  }
  const CollisionFree free(scene, start, group.name);
  RobotState state(start);
  std::vector<double> values(turns.size()), step(turns.size());
  if (path.empty())
    return -1;
  state.setGroup(group, path[0].data());
  if (!free(state))
    return 0;
  PathWalk walk(scene.checker(start, group.name));
  walk.start(state);
  for (std::size_t i = 0; i + 1 < path.size(); ++i)
  {
    double largest = 0;
    for (std::size_t k = 0; k < step.size(); ++k)
    {
      step[k] = path[i + 1][k] - path[i][k];
      if (turns[k])
        step[k] = std::remainder(step[k], 2 * M_PI);
      largest = std::max(largest, std::abs(step[k]));
    }
    if (largest == 0)
      continue;
    const auto at = [&](double share) -> const RobotState& {
      for (std::size_t k = 0; k < step.size(); ++k)
        values[k] = path[i][k] + step[k] * share;
      state.setGroup(group, values.data());
      return state;
    };
    if (walk.go(at, std::min(1.0, STEP / largest)) < 1)
      return static_cast<int>(i);
  }
  return -1;
}

PlanResult planClosely(const PlanningScene& scene, const RobotState& start, const PlanRequest& request,
                       const CancelFlag& cancel)
{
  if (straight(scene, request))
  {
    PlanRequest closely(request);
    closely.closely = true;
    return plan(scene, start, closely, cancel);
  }
  const auto began = std::chrono::steady_clock::now();
  PlanResult result = plan(scene, start, request, cancel);
  const double spacing = largestStep(result.path);
  PlanRequest finer(request);
  for (int again = 0; result.status == PlanStatus::Solved; ++again)
  {
    result.hit = firstHit(scene, start, scene.model()->group(request.group), result.path);
    if (result.hit < 0 || (cancel && *cancel))
      break;
    if (again == AGAIN)
    {
      result.status = PlanStatus::InvalidPath;
      result.message = cutsCorners(result.hit, result.path.size());
      break;
    }
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - began;
    finer.segment_fraction /= 4;
    finer.time = std::max(request.time - spent.count(), std::min(1.0, request.time));
    PlanResult next = plan(scene, start, finer, cancel);
    next.planning_time += result.planning_time;
    next.states_checked += result.states_checked;
    if (next.status == PlanStatus::Solved)
      next.path = thinned(next.path, spacing);
    result = std::move(next);
  }
  return result;
}
}  // namespace motion
