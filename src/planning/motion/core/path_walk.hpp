// Motions looked at all along, not only at some of their states: shapes that are farther from each other than they move in a
// step cannot meet in it.
#pragma once

#include <functional>
#include <unordered_map>

#include "checker.hpp"

namespace motion
{
class PathWalk
{
public:
  using At = std::function<const RobotState&(double)>;  // the state at a share (0 to 1) of a motion

  // The states must carry what the checker was made for.
  explicit PathWalk(std::shared_ptr<const CollisionChecker> checker);

  // Begin at a state that touches nothing.
  void start(const RobotState& state);
  // Go on along a motion that begins where the last one ended; `step` is the largest share to look at at once. Returns the share
  // that may be gone without touching: 1 if all of it.
  double go(const At& at, double step);

private:
  enum class Verdict
  {
    Free,
    Touches,
    Finer
  };
  struct Side
  {
    const CollisionShape* shape;
    const Transform *now, *next;
  };
  Verdict step();
  Verdict look(const Side& a, const Side& b, double boxes, double need, double& margin, double& following);
  double gap(const Side& a, const Side& b, double enough) const;  // m; at most `enough`
  bool touch(const CollisionShape& a, const Transform& at_a, const CollisionShape& b, const Transform& at_b) const;

  std::shared_ptr<const CollisionChecker> checker_;
  CollisionChecker::Scratch now_, next_;
  // How far shapes are from each other at least, m: of the pairs of the robot, and of (part, object) that are near each other.
  std::vector<double> self_now_, self_next_;
  std::unordered_map<std::size_t, double> world_now_, world_next_;
  double shrink_ = 0.5;
};
}  // namespace motion
