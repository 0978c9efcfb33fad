// What is wrong with a start or a goal, and which goal comes first.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "motion/planning_scene.hpp"

namespace motion
{
// "'a' and 'b' touch"
std::string touching(const PlanningScene& scene, const RobotState& state, const std::string& group);

// "" if the start is within the limits.
std::string outsideLimits(const RobotModel& model, const JointModelGroup& group, const RobotState& start);

// "" if a base of the group can be anywhere between the workspace's corners: as upstream, a start in none is outside.
std::string emptyWorkspace(const RobotModel& model, const JointModelGroup& group, const Vector3& low, const Vector3& high);

// Calls `limit` for each of the group's metres that have no bounds, by its place in the group: those of the workspace, wide enough for the
// start and all goals.
void boundsOfWorkspace(const RobotModel& model, const JointModelGroup& group, const RobotState& start,
                       const std::vector<std::vector<double>>& goals, const Vector3& low, const Vector3& high,
                       const std::function<void(std::size_t, double, double)>& limit);

// How many of a joint's first variables are metres in the frame of the robot.
int lengthsOf(const JointModel& joint);

// The goals, that first which is nearest to the start.
std::vector<std::vector<double>> nearestFirst(const RobotState& start, const JointModelGroup& group,
                                              const std::vector<std::vector<double>>& goals);
}  // namespace motion
