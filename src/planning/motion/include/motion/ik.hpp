// Numerical inverse kinematics of any group of one-variable joints: chains of any length, several tips, mimic joints.
#pragma once

#include <atomic>
#include <functional>
#include <vector>

#include "motion/robot_state.hpp"

namespace motion
{
struct IkOptions
{
  double timeout = 0.005;   // s
  double tolerance = 1e-5;  // norm of the pose error (m and rad together)
  int max_restarts = -1;    // tries after the first, from random states; -1: until time is up
  std::size_t solutions = 1;
  bool return_approximate = false;
  std::vector<double> consistency;           // largest distance of each variable from the seed; empty: any
  std::function<bool(const double*)> valid;  // group values; asked for each solution
  std::uint64_t random_seed = 0;
  const std::atomic<bool>* cancelled = nullptr;
};

struct IkTarget
{
  int link = -1;
  Transform pose = Transform::Identity();  // of the link, in the model frame
  bool position = true, orientation = true;
};

struct IkResult
{
  std::vector<std::vector<double>> solutions;  // the nearest to the seed first
  bool approximate = false;
  double error = 0;  // of the first solution, or the least that was reached
  int iterations = 0, restarts = 0;
  int rejected = 0;  // poses reached, but not valid
  double time = 0;   // s
};

// Inverse kinematics that somebody else wrote for one group of one robot; asked from several threads.
class GroupSolver
{
public:
  virtual ~GroupSolver() = default;
  // Can it be asked for these? Else the library's own solver is.
  virtual bool takes(const std::vector<IkTarget>& targets) const = 0;
  virtual IkResult solve(const RobotState& seed, const std::vector<IkTarget>& targets, const IkOptions& options) const = 0;
};

class IkSolver
{
public:
  // Throws InvalidInput when the group has joints with several variables, or does not move a target's link.
  IkSolver(RobotModelPtr model, const JointModelGroup& group);

  // `seed` also says where the joints outside the group are.
  IkResult solve(const RobotState& seed, const std::vector<IkTarget>& targets, const IkOptions& options) const;

  struct Step;
  struct Chain;

private:
  std::vector<Chain> chains(const RobotState& seed, const std::vector<IkTarget>& targets) const;

  RobotModelPtr model_;
  const JointModelGroup& group_;
  std::vector<double> lower_, upper_;
  std::vector<char> turns_;  // may be shifted by whole turns when done, so that its limits do not matter on the way
  std::vector<char> prismatic_;
  std::vector<int> column_of_joint_;
};

// Throws what IkSolver's constructor would; also for targets.
void demandIk(const RobotModel& model, const JointModelGroup& group);
}  // namespace motion
