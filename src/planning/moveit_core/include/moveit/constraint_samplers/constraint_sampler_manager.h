// The sampler that fits constraints best.
#pragma once

#include <string>
#include <vector>

#include <moveit/constraint_samplers/constraint_sampler_allocator.h>

namespace constraint_samplers
{
MOVEIT_CLASS_FORWARD(ConstraintSamplerManager);

class ConstraintSamplerManager
{
public:
  ConstraintSamplerManager() {}
  // Those registered are asked before the default ones, in their order.
  void registerSamplerAllocator(const ConstraintSamplerAllocatorPtr& sa) { sampler_alloc_.push_back(sa); }
  // Null when nothing can be sampled: unknown group, or links that no solver reaches.
  ConstraintSamplerPtr selectSampler(const planning_scene::PlanningSceneConstPtr& scene, const std::string& group_name,
                                     const moveit_msgs::Constraints& constr) const;
  static ConstraintSamplerPtr selectDefaultSampler(const planning_scene::PlanningSceneConstPtr& scene,
                                                   const std::string& group_name, const moveit_msgs::Constraints& constr);

private:
  std::vector<ConstraintSamplerAllocatorPtr> sampler_alloc_;
};
}  // namespace constraint_samplers
