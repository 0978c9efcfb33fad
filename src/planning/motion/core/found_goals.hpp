// The states that were found for a goal, as OMPL samples them.
#pragma once

#include <ompl/base/goals/GoalSampleableRegion.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <vector>

#include "joint_space.hpp"

namespace motion
{
// OMPL's own GoalStates may not be sampled by several threads at once.
class FoundGoals : public ompl::base::GoalSampleableRegion
{
public:
  FoundGoals(const ompl::base::SpaceInformationPtr& si, const std::vector<std::vector<double>>& goals)
    : GoalSampleableRegion(si)
  {
    setThreshold(1e-9);
    for (const auto& values : goals)
    {
      ompl::base::State* state = si_->allocState();
      std::copy(values.begin(), values.end(), JointSpace::values(state));
      states_.push_back(state);
    }
  }
  ~FoundGoals() override
  {
    for (ompl::base::State* state : states_)
      si_->freeState(state);
  }
  void sampleGoal(ompl::base::State* state) const override { si_->copyState(state, states_[next_++ % states_.size()]); }
  unsigned int maxSampleCount() const override { return static_cast<unsigned int>(states_.size()); }
  double distanceGoal(const ompl::base::State* state) const override
  {
    double least = std::numeric_limits<double>::infinity();
    for (const ompl::base::State* goal : states_)
      least = std::min(least, si_->distance(state, goal));
    return least;
  }

private:
  std::vector<ompl::base::State*> states_;
  mutable std::atomic<std::size_t> next_{0};
};
}  // namespace motion
