#include "support.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <utility>

#include "collision_shape.hpp"

namespace motion
{
namespace
{
constexpr int FEW = 8;          // points that are looked at one by one
constexpr int SMALL = 16;       // triangles of a part that is not cut
constexpr double FLAT = 1e-4;   // m that corners of a convex mesh may stand out
constexpr int DEEP = 6;         // times that a mesh is cut
constexpr int FEWER_TRIES = 4;  // of parts
constexpr int TRIES = 8;        // directions; where hulls are apart, three or four are enough as a rule
constexpr int PAIRS = 40;       // of parts, that are looked at before it is left to FCL
constexpr int LUCK = 2;         // times in vain before parts are left out
constexpr int SELDOM = 8;       // of so many times one
constexpr double CLEAR = 1e-5;  // m: what is farther apart FCL calls free as well, whatever its tolerances
constexpr int KNOWN = 512;      // pairs of shapes whose last direction is kept, of each thread
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
  Portion child(int which) const { return {shape, node()->first + which}; }

  // In the shape's own frame. Of a cone or an octree, that of its box.
  Vector3 farthest(const Vector3& direction) const
  {
    if (shape->parts)
      return node()->corners.along(direction);
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
  nodes_.reserve(2 * points_.size() / FEW + 2);
  nodes_.emplace_back();
  split(0, 0, static_cast<int>(points_.size()));
}

void FarthestPoint::split(int node, int first, int last)
{
  Vector3 low = Vector3::Constant(INFINITE), high = -low;
  for (int i = first; i < last; ++i)
  {
    low = low.cwiseMin(points_[i]);
    high = high.cwiseMax(points_[i]);
  }
  nodes_[node] = {0.5 * (low + high), 0.5 * (high - low), first, last - first};
  if (last - first <= FEW)
    return;
  int axis;
  (high - low).maxCoeff(&axis);
  const int middle = (first + last) / 2;
  std::nth_element(points_.begin() + first, points_.begin() + middle, points_.begin() + last,
                   [axis](const Vector3& a, const Vector3& b) { return a[axis] < b[axis]; });
  const int children = static_cast<int>(nodes_.size());
  nodes_[node].first = children;
  nodes_[node].count = 0;
  nodes_.resize(nodes_.size() + 2);
  split(children, first, middle);
  split(children + 1, middle, last);
}

Vector3 FarthestPoint::along(const Vector3& direction) const
{
  const Vector3 size = direction.cwiseAbs();
  const auto most = [&](int i) { return direction.dot(nodes_[i].centre) + size.dot(nodes_[i].half); };
  std::array<std::pair<int, double>, 64> stack;  // halves of halves: no tree is deeper than 32
  int top = 0, best = 0;
  double farthest = -INFINITE;
  stack[top++] = {0, INFINITE};
  while (top)
  {
    const auto [here, bound] = stack[--top];
    if (bound <= farthest)
      continue;
    const Node& node = nodes_[here];
    if (node.count == 0)
    {
      std::pair<int, double> near(node.first, most(node.first)), far(node.first + 1, most(node.first + 1));
      if (near.second > far.second)
        std::swap(near, far);
      stack[top++] = near;
      stack[top++] = far;
      continue;
    }
    for (int i = node.first; i < node.first + node.count; ++i)
    {
      const double there = direction.dot(points_[i]);
      if (there > farthest)
      {
        farthest = there;
        best = i;
      }
    }
  }
  return points_[best];
}

MeshParts::MeshParts(const Mesh& mesh)
{
  std::vector<int> order(mesh.triangles.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    order[i] = static_cast<int>(i);
  const int count = static_cast<int>(order.size());
  parts_.push_back(made(mesh, order, 0, count));
  if (!convex(mesh))  // else it is its own hull
    split(mesh, order, 0, 0, count, 0);
}

MeshParts::Part MeshParts::made(const Mesh& mesh, const std::vector<int>& order, int first, int last) const
{
  std::vector<int> indices;
  for (int i = first; i < last; ++i)
    for (int k = 0; k < 3; ++k)
      indices.push_back(mesh.triangles[order[i]][k]);
  std::sort(indices.begin(), indices.end());
  indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
  std::vector<Vector3> corners;
  Vector3 low = Vector3::Constant(INFINITE), high = -low;
  for (int index : indices)
  {
    corners.push_back(mesh.vertices[index]);
    low = low.cwiseMin(corners.back());
    high = high.cwiseMax(corners.back());
  }
  return {0.5 * (low + high), 0.5 * (high - low), FarthestPoint(std::move(corners))};
}

void MeshParts::split(const Mesh& mesh, std::vector<int>& order, int part, int first, int last, int depth)
{
  if (last - first <= SMALL || depth == DEEP)
    return;
  int axis;
  parts_[part].half.maxCoeff(&axis);
  const auto along = [&](int i) {
    const Eigen::Vector3i& t = mesh.triangles[i];
    return mesh.vertices[t[0]][axis] + mesh.vertices[t[1]][axis] + mesh.vertices[t[2]][axis];
  };
  const int middle = (first + last) / 2;
  std::nth_element(order.begin() + first, order.begin() + middle, order.begin() + last,
                   [&](int a, int b) { return along(a) < along(b); });
  const int children = static_cast<int>(parts_.size());
  parts_[part].first = children;
  parts_.push_back(made(mesh, order, first, middle));
  parts_.push_back(made(mesh, order, middle, last));
  split(mesh, order, children, first, middle, depth + 1);
  split(mesh, order, children + 1, middle, last, depth + 1);
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
