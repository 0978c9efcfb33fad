#include "start_and_goals.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace motion
{
std::string touching(const PlanningScene& scene, const RobotState& state, const std::string& group)
{
  CollisionRequest request;
  request.group = group;
  request.contacts = 1;
  const CollisionResult result = scene.check(state, request);
  if (result.contacts.empty())
    return "bodies overlap";
  return "'" + result.contacts[0].body_1 + "' and '" + result.contacts[0].body_2 + "' touch";
}

std::string outsideLimits(const RobotModel& model, const JointModelGroup& group, const RobotState& start)
{
  for (std::size_t i = 0; i < group.variables.size(); ++i)
  {
    const int variable = group.variables[i];
    const JointModel& joint = model.joints[model.variable_joint[variable]];
    if (joint.satisfiesBounds(start.joint(joint), 1e-6))
      continue;
    const VariableBounds& b = model.bounds[variable];
    char text[300];
    std::snprintf(text, sizeof text, "the start state is outside the limits: '%s' is at %.4g, allowed is %.4g to %.4g",
                  group.variable_names[i].c_str(), start.positions()[variable], b.min_position, b.max_position);
    return text;
  }
  return "";
}

int lengthsOf(const JointModel& joint)
{
  return joint.type == JointType::Planar ? 2 : joint.type == JointType::Floating ? 3 : 0;
}

std::string emptyWorkspace(const RobotModel& model, const JointModelGroup& group, const Vector3& low, const Vector3& high)
{
  for (int j : group.active_joints)
    for (int k = 0; k < lengthsOf(model.joints[j]); ++k)
      if (!(low[k] <= high[k]))
      {
        const std::string axis(1, "xyz"[k]);
        return "the workspace is empty: min_corner." + axis + " of workspace_parameters is not below max_corner." + axis +
               ", so joint '" + model.joints[j].name + "' can be nowhere";
      }
  return "";
}

std::vector<std::vector<double>> nearestFirst(const RobotState& start, const JointModelGroup& group,
                                              const std::vector<std::vector<double>>& goals)
{
  RobotState state(start);
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < goals.size(); ++i)
  {
    state.setGroup(group, goals[i].data());
    order.emplace_back(start.distance(state, &group), i);
  }
  std::sort(order.begin(), order.end());
  std::vector<std::vector<double>> sorted;
  for (const auto& [distance, index] : order)
    sorted.push_back(goals[index]);
  return sorted;
}

void boundsOfWorkspace(const RobotModel& model, const JointModelGroup& group, const RobotState& start,
                       const std::vector<std::vector<double>>& goals, const Vector3& low, const Vector3& high,
                       const std::function<void(std::size_t, double, double)>& limit)
{
  std::size_t index = 0;
  for (int j : group.active_joints)
  {
    const JointModel& joint = model.joints[j];
    for (int k = 0; k < lengthsOf(joint); ++k)
    {
      if (joint.bounds[k].has_position)
        continue;
      double least = std::min(low[k], start.joint(joint)[k]), most = std::max(high[k], start.joint(joint)[k]);
      for (const auto& goal : goals)
      {
        least = std::min(least, goal[index + k]);
        most = std::max(most, goal[index + k]);
      }
      limit(index + k, least, most);
    }
    index += joint.variable_count;
  }
}
}  // namespace motion
