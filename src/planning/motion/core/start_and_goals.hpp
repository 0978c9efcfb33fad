// What is wrong with a start or a goal, and which goal comes first.
#pragma once

#include <string>
#include <vector>

#include "motion/planning_scene.hpp"

namespace motion
{
// "'a' and 'b' touch"
std::string touching(const PlanningScene& scene, const RobotState& state, const std::string& group);

// "" if the start is within the limits.
std::string outsideLimits(const RobotModel& model, const JointModelGroup& group, const RobotState& start);

// The goals, that first which is nearest to the start.
std::vector<std::vector<double>> nearestFirst(const RobotState& start, const JointModelGroup& group,
                                              const std::vector<std::vector<double>>& goals);
}  // namespace motion
