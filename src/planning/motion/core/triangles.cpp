#include "triangles.hpp"

#include <algorithm>
#include <limits>

namespace motion
{
namespace
{
constexpr double TOUCHING = 1e-9;  // m: boxes around shapes that are nearer than this may touch
constexpr double PARALLEL = 1e-12;

// The triangles of a mesh around a box, in the box's frame.
class AroundBox
{
public:
  AroundBox(const MeshParts& mesh, const Transform& at_mesh, const Vector3& half, double enough)
    : mesh_(mesh)
    , turn_(at_mesh.linear())
    , size_(turn_.cwiseAbs())
    , off_(at_mesh.translation())
    , half_(half)
    , least_(enough)
  {
  }

  double least()
  {
    visit(0);
    return least_;
  }

private:
  double gapOf(const MeshParts::Part& part) const
  {
    return gapByFaces(turn_, size_, turn_ * part.centre + off_, half_, part.half, least_);
  }

  void visit(int index)
  {
    const MeshParts::Part& part = mesh_.part(index);
    if (part.first < 0)
    {
      for (int i = part.begin; i < part.end && least_ >= -CLEAR; ++i)
        least_ = std::min(least_, gapOfTriangle(mesh_.triangle(i)));
      return;
    }
    int near = part.first, far = part.first + 1;
    double gap = gapOf(mesh_.part(near)), other = gapOf(mesh_.part(far));
    if (other < gap)
    {
      std::swap(near, far);
      std::swap(gap, other);
    }
    if (gap < least_ && least_ >= -CLEAR)
      visit(near);
    if (other < least_ && least_ >= -CLEAR)
      visit(far);
  }

  double gapOfTriangle(const MeshParts::Triangle& corners) const
  {
    const Vector3 v[3] = {turn_ * *corners[0] + off_, turn_ * *corners[1] + off_, turn_ * *corners[2] + off_};
    const Vector3 low = v[0].cwiseMin(v[1]).cwiseMin(v[2]), high = v[0].cwiseMax(v[1]).cwiseMax(v[2]);
    double widest = (low - half_).cwiseMax(-high - half_).maxCoeff();
    if (widest >= least_)
      return widest;
    const Vector3 edges[3] = {v[1] - v[0], v[2] - v[1], v[0] - v[2]};
    const Vector3 normal = edges[0].cross(edges[1]);
    const double length = normal.norm();
    if (length > PARALLEL * edges[0].norm() * edges[1].norm())
      widest = std::max(widest, (std::abs(normal.dot(v[0])) - half_.dot(normal.cwiseAbs())) / length);
    for (int e = 0; e < 3 && widest < least_; ++e)
    {
      const Vector3 &edge = edges[e], &on = v[e], &opposite = v[(e + 2) % 3];
      for (int k = 0; k < 3; ++k)
      {
        // The edge crossed with the box's axis k.
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        const double across_i = edge[j], across_j = -edge[i], square = across_i * across_i + across_j * across_j;
        if (!(square > PARALLEL * edge.squaredNorm()))
          continue;
        const double one = across_i * on[i] + across_j * on[j], two = across_i * opposite[i] + across_j * opposite[j];
        const double reach = half_[i] * std::abs(across_i) + half_[j] * std::abs(across_j);
        widest = std::max(widest, (std::max(std::min(one, two), -std::max(one, two)) - reach) / std::sqrt(square));
      }
    }
    return widest;
  }

  const MeshParts& mesh_;
  const Eigen::Matrix3d turn_, size_;
  const Vector3 off_, half_;
  double least_;
};

bool isBox(const CollisionShape& shape) { return shape.shape->type == ShapeType::Box; }
}  // namespace

double gapOfTriangles(const CollisionShape& a, const Transform& at_a, const CollisionShape& b, const Transform& at_b,
                      double enough)
{
  if (a.parts && isBox(b))
    return AroundBox(*a.parts, at_b.inverse(Eigen::Isometry) * at_a, b.half, enough).least();
  if (b.parts && isBox(a))
    return AroundBox(*b.parts, at_a.inverse(Eigen::Isometry) * at_b, a.half, enough).least();
  return std::numeric_limits<double>::quiet_NaN();
}

Touch knownTouch(const CollisionShape& a, const Transform& at_a, const CollisionShape& b, const Transform& at_b)
{
  if (gapOfBoxes(a, at_a, b, at_b) > TOUCHING || areApart(a, at_a, b, at_b))
    return Touch::No;
  const double gap = gapOfTriangles(a, at_a, b, at_b, 2 * CLEAR);
  return gap > CLEAR ? Touch::No : gap < -CLEAR ? Touch::Yes : Touch::Unsure;
}
}  // namespace motion
