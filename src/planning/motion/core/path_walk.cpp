#include "path_walk.hpp"

#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <cmath>

#include "triangles.hpp"

namespace motion
{
namespace
{
constexpr double RESOLUTION = 5e-4;  // m: shapes that move by less and touch at neither end are believed not to touch
constexpr double COARSE = 0.01;      // m: the same for shapes whose distance is not known (planes, octrees)
constexpr double UNKNOWN = -1;
// Part of what a step needs: where that much is known to be free, a smaller step is sooner made than FCL asked for the rest.
constexpr double WORTH = 0.25;
constexpr double ENOUGH = 1.2;  // times what a step needs: how much larger a distance is, is not asked

// How far the points of a shape move at most, the way between the two poses being short.
double moved(const CollisionShape& shape, const Transform& from, const Transform& to)
{
  const double turned = (to.linear() - from.linear()).norm() * M_SQRT1_2;
  return 1.05 * ((to * shape.centre - from * shape.centre).norm() + turned * shape.half.norm()) + 1e-7;
}

bool measurable(const CollisionShape& shape) { return !shape.unbounded && shape.shape->type != ShapeType::OcTree; }
}  // namespace

PathWalk::PathWalk(std::shared_ptr<const CollisionChecker> checker)
  : checker_(std::move(checker))
  , self_now_(checker_->self_pairs_.size())
  , self_next_(checker_->self_pairs_.size())
{
}

void PathWalk::start(const RobotState& state)
{
  checker_->place(state, now_);
  std::fill(self_now_.begin(), self_now_.end(), 0.0);
  world_now_.clear();
}

double PathWalk::go(const At& at, double step_size)
{
  double gone = 0, size = step_size;
  while (gone < 1)
  {
    const double there = gone + size > 1 - 1e-9 ? 1 : gone + size;
    checker_->place(at(there), next_);
    switch (step())
    {
      case Verdict::Touches:
        return gone;
      case Verdict::Finer:
        size = (there - gone) * shrink_;
        break;
      case Verdict::Free:
        std::swap(now_, next_);
        self_now_.swap(self_next_);
        world_now_.swap(world_next_);
        gone = there;
        size = std::min(step_size, 2 * size);
    }
  }
  return 1;
}

bool PathWalk::touch(const CollisionShape& a, const Transform& at_a, const CollisionShape& b, const Transform& at_b) const
{
  const Touch known = knownTouch(a, at_a, b, at_b);
  if (known != Touch::Unsure)
    return known == Touch::Yes;
  fcl::CollisionResultd result;
  return fcl::collide(a.geometry.get(), at_a, b.geometry.get(), at_b, fcl::CollisionRequestd(1, false), result) != 0;
}

double PathWalk::gap(const Side& a, const Side& b, double enough) const
{
  if (!measurable(*a.shape) || !measurable(*b.shape))
    return UNKNOWN;
  fcl::DistanceResultd result(enough);  // what is farther away than this is not looked at
  const double found =
      fcl::distance(a.shape->geometry.get(), *a.now, b.shape->geometry.get(), *b.now, fcl::DistanceRequestd(), result);
  return std::max(0.0, found);
}

PathWalk::Verdict PathWalk::look(const Side& a, const Side& b, double boxes, double need, double& margin, double& following)
{
  if (margin < need)
    margin = std::max(margin, boxes);
  if (margin < need)
    margin = std::max(margin, gapOfBoxes(*a.shape, *a.now, *b.shape, *b.now));
  if (margin < need)
    margin = std::max(margin, gapOfHulls(*a.shape, *a.now, *b.shape, *b.now, ENOUGH * need));
  if (margin < need)
    margin = std::fmax(margin, gapOfTriangles(*a.shape, *a.now, *b.shape, *b.now, ENOUGH * need));
  if (margin < need && need > RESOLUTION && margin > WORTH * need)
  {
    shrink_ = 0.9 * margin / need;
    return Verdict::Finer;
  }
  if (margin < need)
  {
    const double exact = gap(a, b, ENOUGH * need);
    margin = std::max(margin, exact);
    if (margin < need)
    {
      const double fine = exact == UNKNOWN ? COARSE : RESOLUTION;
      if (need > fine)
      {
        shrink_ = std::clamp(0.9 * std::max(margin, fine) / need, 0.02, 0.6);
        return Verdict::Finer;
      }
      if (touch(*a.shape, *a.next, *b.shape, *b.next))
        return Verdict::Touches;
    }
  }
  following = std::max(0.0, margin - need);
  return Verdict::Free;
}

PathWalk::Verdict PathWalk::step()
{
  const auto& parts = checker_->parts_;
  for (std::size_t p = 0; p < self_now_.size(); ++p)
  {
    const auto& [i, j] = checker_->self_pairs_[p];
    const Side a{parts[i].bare.get(), &now_.poses[i], &next_.poses[i]}, b{parts[j].bare.get(), &now_.poses[j], &next_.poses[j]};
    const double need = moved(*b.shape, a.now->inverse(Eigen::Isometry) * *b.now, a.next->inverse(Eigen::Isometry) * *b.next);
    const Verdict verdict = look(a, b, now_.bare[i].distance(now_.bare[j]), need, self_now_[p], self_next_[p]);
    if (verdict != Verdict::Free)
      return verdict;
  }
  world_next_.clear();
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    if (!parts[i].meets_world)
      continue;
    const Side a{parts[i].padded.get(), &now_.poses[i], &next_.poses[i]};
    const double need = moved(*a.shape, *a.now, *a.next);
    Aabb reach = now_.padded[i];
    reach.low.array() -= need;
    reach.high.array() += need;
    const char* allowed = &checker_->world_allowed_[parts[i].body * checker_->world_bodies_];
    Verdict verdict = Verdict::Free;
    checker_->tree_.query(reach, [&](int k) {
      const auto& other = checker_->world_parts_[k];
      if (allowed[other.body - checker_->robot_bodies_])
        return false;
      const Side b{other.part->shape.get(), &other.part->pose, &other.part->pose};
      const std::size_t key = i * checker_->world_parts_.size() + k;
      verdict = look(a, b, now_.padded[i].distance(other.part->box), need, world_now_[key], world_next_[key]);
      return verdict != Verdict::Free;
    });
    if (verdict != Verdict::Free)
      return verdict;
  }
  return Verdict::Free;
}
}  // namespace motion
