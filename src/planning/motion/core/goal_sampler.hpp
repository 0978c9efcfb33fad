// Group values that meet a goal: as many different ones as are wanted.
#pragma once

#include <functional>

#include "motion/ik.hpp"
#include "motion/planning.hpp"

namespace motion
{
class GoalSampler
{
public:
  GoalSampler(const PlanningScene& scene, const RobotState& start, const JointModelGroup& group, const Constraints& goal,
              const ConstraintSet& path, const CollisionFree& free);

  // Why samples were refused.
  struct Refusals
  {
    int reached = 0, out_of_bounds = 0, colliding = 0, path = 0, goal = 0;
    std::vector<double> example;  // one that collides
  };

  // Up to `wanted` values; `stop` ends the search early.
  std::vector<std::vector<double>> sample(std::size_t wanted, Random& random, const std::function<bool()>& stop);
  const Refusals& refusals() const { return refusals_; }

private:
  bool good(const RobotState& state);
  void keep(const RobotState& state);
  bool allJointsConstrained() const;
  bool makeTargets(bool centre, Random& random, std::vector<IkTarget>& targets) const;
  void sampleJoints(std::size_t wanted, Random& random, const std::function<bool()>& stop);
  void samplePoses(std::size_t wanted, Random& random, const std::function<bool()>& stop);
  void sampleByProjection(std::size_t wanted, Random& random, const std::function<bool()>& stop);

  RobotModelPtr model_;
  RobotState start_;
  const JointModelGroup& group_;
  ConstraintSet goal_;
  const ConstraintSet& path_;
  const CollisionFree& free_;
  Refusals refusals_;
  std::vector<std::vector<double>> found_;
};
}  // namespace motion
