// Looking at samplers.
#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <string>

#include <moveit/constraint_samplers/constraint_sampler.h>

namespace constraint_samplers
{
// A small sphere where the link is in each sample.
void visualizeDistribution(const ConstraintSamplerPtr& sampler, const moveit::core::RobotState& reference_state,
                           const std::string& link_name, unsigned int sample_count, visualization_msgs::MarkerArray& markers);
void visualizeDistribution(const moveit_msgs::Constraints& constr, const planning_scene::PlanningSceneConstPtr& scene,
                           const std::string& group, const std::string& link_name, unsigned int sample_count,
                           visualization_msgs::MarkerArray& markers);
// Measured for one second.
double countSamplesPerSecond(const ConstraintSamplerPtr& sampler, const moveit::core::RobotState& reference_state);
double countSamplesPerSecond(const moveit_msgs::Constraints& constr, const planning_scene::PlanningSceneConstPtr& scene,
                             const std::string& group);
}  // namespace constraint_samplers
