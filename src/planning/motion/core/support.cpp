#include "support.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>

#include "collision_shape.hpp"

namespace motion
{
namespace
{
constexpr int FINEST = 16;         // cells along an edge of the cube of directions
constexpr int POINTS_A_CELL = 12;  // more are worth smaller cells
constexpr int LARGE = 512;         // triangles of a part whose corners are not worth knowing: its halves' are
constexpr int SMALL = 16;          // triangles of a part that is not cut
constexpr double FLAT = 1e-4;      // m that corners of a convex mesh may stand out
constexpr int DEEP = 14;           // times that a mesh is cut
constexpr int FEWER_TRIES = 4;     // of parts
constexpr int TRIES = 8;           // directions; where hulls are apart, three or four are enough as a rule
constexpr int PAIRS = 40;          // of parts, that are looked at before it is left to FCL
constexpr int LUCK = 2;            // times in vain before parts are left out
constexpr int SELDOM = 8;          // of so many times one
constexpr int KNOWN = 512;         // pairs of shapes whose last direction is kept, of each thread
constexpr double INFINITE = std::numeric_limits<double>::infinity();

// What was seen of two shapes the last times.
struct Seen
{
  const CollisionShape *a = nullptr, *b = nullptr;
  Vector3 way;            // in a's frame
  int luck = LUCK;        // with their parts: below 0 these are looked at seldom
  unsigned overlaps = 0;  // of their hulls
};

Seen& lastOf(const CollisionShape& a, const CollisionShape& b)
{
  static thread_local std::array<Seen, KNOWN> known;
  const auto one = reinterpret_cast<std::uintptr_t>(&a), other = reinterpret_cast<std::uintptr_t>(&b);
  return known[((one >> 5) * 31 + (other >> 5)) % KNOWN];
}

// A shape, or a part of its mesh.
struct Portion
{
  const CollisionShape* shape;
  int part = 0;

  const MeshParts::Part* node() const { return shape->parts ? &shape->parts->part(part) : nullptr; }
  const Vector3& centre() const { return node() ? node()->centre : shape->centre; }
  const Vector3& half() const { return node() ? node()->half : shape->half; }
  bool divisible() const { return node() && node()->first >= 0; }
  bool small() const { return !node() || node()->end - node()->begin <= LARGE; }
  Portion child(int which) const { return {shape, node()->first + which}; }

  // In the shape's own frame. Of a cone or an octree, that of its box.
  Vector3 farthest(const Vector3& direction) const
  {
    if (shape->parts)
      return shape->parts->corners(part).along(direction);
    Vector3 out = shape->half;
    for (int k = 0; k < 3; ++k)
      if (direction[k] < 0)
        out[k] = -out[k];
    const ShapeType type = shape->shape->type;
    if (type == ShapeType::Sphere)
      out = direction * (shape->half[0] / direction.norm());
    else if (type == ShapeType::Cylinder)
    {
      const double across = std::hypot(direction[0], direction[1]);
      if (across > 0)
        out.head<2>() = direction.head<2>() * (shape->half[0] / across);
    }
    return shape->centre + out;
  }
};

// One shape beside another, in the first one's frame.
class Beside
{
public:
  Beside(const Transform& at_a, const Transform& at_b, double enough)
    : turn_(at_a.linear().transpose() * at_b.linear())
    , size_(turn_.cwiseAbs())
    , off_(at_a.linear().transpose() * (at_b.translation() - at_a.translation()))
    , enough_(enough)
  {
  }

  Vector3 between(const Portion& a, const Portion& b) const { return turn_ * b.centre() + off_ - a.centre(); }

  // By the directions that `way` leads to; the best one is left in it.
  double gapOf(const Portion& a, const Portion& b, Vector3& way, int tries) const
  {
    Vector3 next = way, nearest = Vector3::Zero();  // of the points from one to the other, the one next to none that is known
    double widest = -INFINITE;
    for (int i = 0; i < tries; ++i)
    {
      const double length = next.norm();
      if (!(length > 0))
        break;
      next /= length;
      const Vector3 there = turn_ * b.farthest(turn_.transpose() * -next) + off_ - a.farthest(next);
      const double gap = next.dot(there), square = there.squaredNorm();
      if (gap > widest)
      {
        widest = gap;
        way = next;
      }
      if (gap > enough_ || !(square > 0))
        break;
      if (widest <= 0)
      {
        next -= 2 * next.dot(there) / square * there;
        continue;
      }
      if (nearest.isZero())
        nearest = there;
      const Vector3 side = there - nearest;
      const double side_squared = side.squaredNorm();
      if (side_squared > 0)
        nearest += std::clamp(-nearest.dot(side) / side_squared, 0.0, 1.0) * side;
      if (widest > 0.9 * nearest.norm())  // no direction has much more
        break;
      next = nearest;
    }
    return widest;
  }

  // The least of the parts' gaps; once one has none, that one's.
  double gapOfParts(const Portion& a, const Portion& b, int& pairs) const
  {
    const bool first = a.divisible() && (!b.divisible() || a.half().squaredNorm() > b.half().squaredNorm());
    if (!first && !b.divisible())
      return 0;
    double least = INFINITE;
    for (int which = 0; which < 2; ++which)
    {
      const Portion one = first ? a.child(which) : a, other = first ? b : b.child(which);
      Vector3 way = between(one, other);
      double gap = gapByFaces(turn_, size_, way, one.half(), other.half(), enough_);
      if (gap <= enough_)
      {
        if (--pairs < 0)
          return 0;
        if (one.small() && other.small())
          gap = std::max(gap, gapOf(one, other, way, FEWER_TRIES));
        if (gap <= 0)
          gap = gapOfParts(one, other, pairs);
      }
      least = std::min(least, gap);
      if (least <= 0)
        return least;
    }
    return least;
  }

private:
  Eigen::Matrix3d turn_, size_;
  Vector3 off_;
  double enough_;
};
}  // namespace

namespace
{
// Is no corner outside the plane of any triangle?
bool convex(const Mesh& mesh)
{
  for (const Eigen::Vector3i& t : mesh.triangles)
  {
    const Vector3& at = mesh.vertices[t[0]];
    const Vector3 normal = (mesh.vertices[t[1]] - at).cross(mesh.vertices[t[2]] - at);
    const double slack = FLAT * normal.norm();
    double low = 0, high = 0;
    for (const Vector3& corner : mesh.vertices)
    {
      const double off = normal.dot(corner - at);
      low = std::min(low, off);
      high = std::max(high, off);
      if (low < -slack && high > slack)
        return false;
    }
  }
  return true;
}
}  // namespace

FarthestPoint::FarthestPoint(std::vector<Vector3> points) : points_(std::move(points))
{
  const std::size_t count = points_.size();
  while (side_ < FINEST && count > static_cast<std::size_t>(POINTS_A_CELL * side_ * side_))
    side_ *= 2;
  cells_.resize(6 * side_ * side_);
  std::vector<int> all(count);
  for (std::size_t i = 0; i < count; ++i)
    all[i] = static_cast<int>(i);
  for (int face = 0; face < 6; ++face)
    sort({face, 0, 0, side_}, all);
  keepWanted();
}

namespace
{
// Which are the farthest in the middle of a square, at its corners and in the middle of its sides: they leave few others.
std::array<std::size_t, 9> champions(const std::vector<Eigen::Vector4d>& fars)
{
  constexpr int SHARES[9][4] = {{1, 1, 1, 1}, {1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1},
                                {1, 1, 0, 0}, {0, 0, 1, 1}, {1, 0, 1, 0}, {0, 1, 0, 1}};
  std::array<std::size_t, 9> best{};
  std::array<double, 9> most;
  most.fill(-INFINITE);
  for (std::size_t p = 0; p < fars.size(); ++p)
    for (int k = 0; k < 9; ++k)
    {
      const double there =
          SHARES[k][0] * fars[p][0] + SHARES[k][1] * fars[p][1] + SHARES[k][2] * fars[p][2] + SHARES[k][3] * fars[p][3];
      if (there > most[k])
      {
        most[k] = there;
        best[k] = p;
      }
    }
  return best;
}
}  // namespace

// Of the points those of which none, among some, is as far at all four corners of the square; the farthest in its middle first.
std::vector<int> FarthestPoint::candidates(const Square& square, const std::vector<int>& points) const
{
  const int axis = square.face / 2;
  const auto along = [&](int i, int j) {
    Vector3 way;
    way[axis] = square.face % 2 ? -1.0 : 1.0;
    way[(axis + 1) % 3] = 2.0 * i / side_ - 1.0;
    way[(axis + 2) % 3] = 2.0 * j / side_ - 1.0;
    return way;
  };
  const int i = square.i, j = square.j, size = square.size;
  const Vector3 corners[4] = {along(i, j), along(i + size, j), along(i, j + size), along(i + size, j + size)};
  const auto far = [&](int point) {
    Eigen::Vector4d out;
    for (int k = 0; k < 4; ++k)
      out[k] = corners[k].dot(points_[point]);
    return out;
  };
  std::vector<Eigen::Vector4d> fars(points.size());
  for (std::size_t p = 0; p < points.size(); ++p)
    fars[p] = far(points[p]);
  const auto best = champions(fars);
  const auto asFar = [&](std::size_t a, std::size_t b) { return (fars[a].array() >= fars[b].array()).all(); };
  std::vector<std::pair<double, std::size_t>> left;
  for (std::size_t p = 0; p < points.size(); ++p)
    if (std::none_of(best.begin(), best.end(),
                     [&](std::size_t other) { return other != p && asFar(other, p) && !asFar(p, other); }))
      left.emplace_back(-fars[p].sum(), p);
  std::vector<int> found;
  if (size > 1)  // its quarters will leave out more
  {
    for (const auto& [less, p] : left)
      found.push_back(points[p]);
    return found;
  }
  std::sort(left.begin(), left.end());  // what no earlier one is as far as, no later one is
  std::vector<std::size_t> kept;
  for (const auto& [less, p] : left)
    if (std::none_of(kept.begin(), kept.end(), [&, p = p](std::size_t other) { return asFar(other, p); }))
      kept.push_back(p);
  for (std::size_t p : kept)
    found.push_back(points[p]);
  return found;
}

void FarthestPoint::sort(const Square& square, const std::vector<int>& points)
{
  const std::vector<int> left = candidates(square, points);
  if (square.size == 1)
  {
    const int begin = static_cast<int>(of_cell_.size());
    of_cell_.insert(of_cell_.end(), left.begin(), left.end());
    cells_[(square.face * side_ + square.i) * side_ + square.j] = {begin, static_cast<int>(of_cell_.size())};
    return;
  }
  const int half = square.size / 2;
  for (int quarter = 0; quarter < 4; ++quarter)
    sort({square.face, square.i + quarter / 2 * half, square.j + quarter % 2 * half, half}, left);
}

void FarthestPoint::keepWanted()
{
  std::vector<int> becomes(points_.size(), -1);
  for (int point : of_cell_)
    becomes[point] = 0;
  int kept = 0;
  for (std::size_t i = 0; i < points_.size(); ++i)
    if (becomes[i] == 0)
    {
      becomes[i] = kept;
      points_[kept++] = points_[i];
    }
  points_.resize(kept);
  points_.shrink_to_fit();
  for (int& point : of_cell_)
    point = becomes[point];
}

const Vector3& FarthestPoint::along(const Vector3& direction) const
{
  int axis;
  const double scale = 0.5 * side_ / direction.cwiseAbs().maxCoeff(&axis);
  const auto cell = [&](int k) {
    return std::clamp(static_cast<int>(direction[(axis + k) % 3] * scale + 0.5 * side_), 0, side_ - 1);
  };
  const auto& [begin, end] = cells_[((2 * axis + (direction[axis] < 0)) * side_ + cell(1)) * side_ + cell(2)];
  int best = of_cell_[begin];
  double farthest = direction.dot(points_[best]);
  for (int k = begin + 1; k < end; ++k)
  {
    const double there = direction.dot(points_[of_cell_[k]]);
    if (there > farthest)
    {
      farthest = there;
      best = of_cell_[k];
    }
  }
  return points_[best];
}

MeshParts::MeshParts(std::shared_ptr<const Mesh> mesh) : mesh_(std::move(mesh)), order_(mesh_->triangles.size())
{
  for (std::size_t i = 0; i < order_.size(); ++i)
    order_[i] = static_cast<int>(i);
  parts_.push_back(made(0, static_cast<int>(order_.size())));
  if (!convex(*mesh_))  // else it is its own hull
    split(0, 0);
  corners_ = std::make_unique<std::atomic<const FarthestPoint*>[]>(parts_.size());
}

MeshParts::~MeshParts()
{
  for (std::size_t i = 0; i < parts_.size(); ++i)
    delete corners_[i].load();
}

const FarthestPoint& MeshParts::corners(int part) const
{
  std::atomic<const FarthestPoint*>& place = corners_[part];
  if (const FarthestPoint* known = place.load(std::memory_order_acquire))
    return *known;
  auto found = std::make_unique<const FarthestPoint>(cornersOf(parts_[part]));
  const FarthestPoint* before = nullptr;
  if (place.compare_exchange_strong(before, found.get(), std::memory_order_acq_rel))
    return *found.release();
  return *before;  // another thread was sooner
}

FarthestPoint MeshParts::cornersOf(const Part& part) const
{
  std::vector<int> indices;
  for (int i = part.begin; i < part.end; ++i)
    for (int k = 0; k < 3; ++k)
      indices.push_back(mesh_->triangles[order_[i]][k]);
  std::sort(indices.begin(), indices.end());
  indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
  std::vector<Vector3> points;
  points.reserve(indices.size());
  for (int index : indices)
    points.push_back(mesh_->vertices[index]);
  return FarthestPoint(std::move(points));
}

MeshParts::Part MeshParts::made(int begin, int end) const
{
  Vector3 low = Vector3::Constant(INFINITE), high = -low;
  for (int i = begin; i < end; ++i)
    for (const Vector3* corner : triangle(i))
    {
      low = low.cwiseMin(*corner);
      high = high.cwiseMax(*corner);
    }
  return {0.5 * (low + high), 0.5 * (high - low), begin, end};
}

void MeshParts::split(int part, int depth)
{
  const auto [centre, half, begin, end, first] = parts_[part];
  if (end - begin <= SMALL || depth == DEEP)
    return;
  int axis;
  half.maxCoeff(&axis);
  const auto along = [this, axis](int i) {
    const Eigen::Vector3i& t = mesh_->triangles[i];
    return mesh_->vertices[t[0]][axis] + mesh_->vertices[t[1]][axis] + mesh_->vertices[t[2]][axis];
  };
  const int middle = (begin + end) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](int a, int b) { return along(a) < along(b); });
  const int children = static_cast<int>(parts_.size());
  parts_[part].first = children;
  parts_.push_back(made(begin, middle));
  parts_.push_back(made(middle, end));
  split(children, depth + 1);
  split(children + 1, depth + 1);
}

double gapOfHulls(const CollisionShape& a, const Transform& at_a, const CollisionShape& b, const Transform& at_b, double enough)
{
  if (a.unbounded || b.unbounded)
    return -INFINITE;
  const Beside pair(at_a, at_b, enough);
  const Portion one{&a}, other{&b};
  Vector3 way = pair.between(one, other);
  const double gap = pair.gapOf(one, other, way, TRIES);
  int pairs = PAIRS;
  return gap > 0 ? gap : std::max(gap, pair.gapOfParts(one, other, pairs));
}

bool areApart(const CollisionShape& a, const Transform& at_a, const CollisionShape& b, const Transform& at_b)
{
  if (a.unbounded || b.unbounded)
    return false;
  const Beside pair(at_a, at_b, CLEAR);
  const Portion one{&a}, other{&b};
  Seen& seen = lastOf(a, b);
  if (seen.a != &a || seen.b != &b)
    seen = {&a, &b, pair.between(one, other)};
  if (pair.gapOf(one, other, seen.way, TRIES) > CLEAR)
    return true;
  if (seen.luck < 0 && ++seen.overlaps % SELDOM != 0)
    return false;
  int pairs = PAIRS;
  const bool apart = pair.gapOfParts(one, other, pairs) > CLEAR;
  seen.luck = apart ? LUCK : seen.luck - 1;
  return apart;
}
}  // namespace motion
