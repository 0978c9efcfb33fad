// Samplers of parts of a group, one after the other.
#pragma once

#include <string>
#include <vector>

#include <moveit/constraint_samplers/constraint_sampler.h>

namespace constraint_samplers
{
MOVEIT_CLASS_FORWARD(UnionConstraintSampler);

class UnionConstraintSampler : public ConstraintSampler
{
public:
  // In an order in which a sampler comes after those that move the frames it depends on, larger groups first.
  UnionConstraintSampler(const planning_scene::PlanningSceneConstPtr& scene, const std::string& group_name,
                         const std::vector<ConstraintSamplerPtr>& samplers);
  const std::vector<ConstraintSamplerPtr>& getSamplers() const { return samplers_; }
  bool configure(const moveit_msgs::Constraints& /*constraint*/) override { return true; }
  virtual bool canService(const moveit_msgs::Constraints& /*constraint*/) const { return true; }
  using ConstraintSampler::sample;
  bool sample(moveit::core::RobotState& state, const moveit::core::RobotState& reference_state,
              unsigned int max_attempts) override;
  const std::string& getName() const override;

protected:
  std::vector<ConstraintSamplerPtr> samplers_;
};
}  // namespace constraint_samplers
