// A goal that is a whole turn away from an easier one.
#pragma once

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <motion/robot_model.hpp>
#include <motion/robot_state.hpp>

namespace motion
{
/// "; 'lift' would turn by 6.49 rad to 5.29, and is at the same place at -0.993 rad", or "" if no joint has such a way round.
/// Joints with limits of more than a turn have it; an obstacle may then stand in the long way, however long a planner looks.
inline std::string wayRound(const RobotModel& model, const JointModelGroup& group, const RobotState& start,
                            const std::vector<double>& goal)
{
  constexpr double turn = 2 * M_PI;
  std::string found;
  for (std::size_t i = 0; i < group.variables.size(); ++i)
  {
    const int variable = group.variables[i];
    const VariableBounds& bounds = model.bounds[variable];
    const double way = goal[i] - start.positions()[variable];
    const double nearer = goal[i] - std::copysign(turn, way);
    const bool turns = model.joints[model.variable_joint[variable]].type == JointType::Revolute && bounds.has_position;
    if (!turns || std::abs(way) <= M_PI || nearer < bounds.min_position || nearer > bounds.max_position)
      continue;
    char text[300];
    std::snprintf(text, sizeof text, "; '%s' would turn by %.3g rad to %.4g, and is at the same place at %.4g",
                  group.variable_names[i].c_str(), way, goal[i], nearer);
    found += text;
  }
  return found;
}
}  // namespace motion
