// Constraint samplers of other packages, named in ~constraint_samplers, separated by blanks.
#pragma once

#include <memory>

#include <moveit/constraint_samplers/constraint_sampler_manager.h>
#include <moveit/macros/class_forward.h>

namespace constraint_sampler_manager_loader
{
MOVEIT_CLASS_FORWARD(ConstraintSamplerManagerLoader);

class ConstraintSamplerManagerLoader
{
public:
  ConstraintSamplerManagerLoader(const constraint_samplers::ConstraintSamplerManagerPtr& csm =
                                     std::make_shared<constraint_samplers::ConstraintSamplerManager>());
  const constraint_samplers::ConstraintSamplerManagerPtr& getConstraintSamplerManager() const { return manager_; }

private:
  class Loader;
  std::shared_ptr<Loader> loader_;  // outlives what it has made
  constraint_samplers::ConstraintSamplerManagerPtr manager_;
};
}  // namespace constraint_sampler_manager_loader
