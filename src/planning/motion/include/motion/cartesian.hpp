// A link along straight lines, by inverse kinematics step by step (MoveIt's computeCartesianPath).
#pragma once

#include <vector>

#include "motion/constraints.hpp"

namespace motion
{
struct CartesianRequest
{
  std::string group, link;
  std::vector<Transform> waypoints;              // of the link, in the model frame
  double max_step = 0.01;                        // m
  double jump_threshold = 0;                     // times the mean joint step; 0 = any
  double prismatic_jump = 0, revolute_jump = 0;  // largest step of a joint, m and rad; 0 = any
  bool avoid_collisions = true;
  double timeout = 0;          // s for restarts of a step's inverse kinematics; 0 = from the last step alone
  bool position_only = false;  // the way points' orientations do not matter: arms with few joints
};

struct CartesianPath
{
  double fraction = 0;
  std::vector<std::vector<double>> points;  // group values, the start first
  std::string message;                      // why it ended early
};

CartesianPath cartesianPath(const PlanningScene& scene, const RobotState& start, const CartesianRequest& request,
                            const ConstraintSet& constraints);
}  // namespace motion
