// Samplers of other packages: a plug-in exports one of these.
#pragma once

#include <moveit/constraint_samplers/constraint_sampler.h>

namespace constraint_samplers
{
MOVEIT_CLASS_FORWARD(ConstraintSamplerAllocator);

class ConstraintSamplerAllocator
{
public:
  ConstraintSamplerAllocator() {}
  virtual ~ConstraintSamplerAllocator() {}
  virtual ConstraintSamplerPtr alloc(const planning_scene::PlanningSceneConstPtr& scene, const std::string& group_name,
                                     const moveit_msgs::Constraints& constr) = 0;
  virtual bool canService(const planning_scene::PlanningSceneConstPtr& scene, const std::string& group_name,
                          const moveit_msgs::Constraints& constr) const = 0;
};
}  // namespace constraint_samplers
