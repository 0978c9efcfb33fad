// The farthest points of shapes in a direction, and directions in which two shapes, or all of their parts, are apart.
#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <vector>

#include "motion/shapes.hpp"

namespace motion
{
struct CollisionShape;

// m apart, or into each other: FCL says the same then, whatever its tolerances.
constexpr double CLEAR = 1e-5;

// The farthest of some points in any direction. Directions are sorted into the cells of a cube's faces; each cell knows the points of which
// no other is as far at all four of its corners, and so at none between these. They are few, and the others are never looked at.
class FarthestPoint
{
public:
  explicit FarthestPoint(std::vector<Vector3> points);
  const Vector3& along(const Vector3& direction) const;

private:
  // Cells of a face of the cube: size times size of them, from the one in row i and column j.
  struct Square
  {
    int face, i, j, size;
  };
  std::vector<int> candidates(const Square& square, const std::vector<int>& points) const;
  void sort(const Square& square, const std::vector<int>& points);
  void keepWanted();

  int side_ = 1;  // cells along an edge of the cube
  std::vector<Vector3> points_;
  std::vector<std::pair<int, int>> cells_;  // from where to before where in of_cell_ their points stand
  std::vector<int> of_cell_;
};

// A mesh cut into halves, and these again. For any number of threads; what a part's corners are is found out when it is first asked.
class MeshParts
{
public:
  struct Part
  {
    Vector3 centre, half;  // of its box along the mesh's axes
    int begin, end;        // its triangles
    int first = -1;        // of the two parts that it has; -1: none
  };

  explicit MeshParts(std::shared_ptr<const Mesh> mesh);
  ~MeshParts();
  MeshParts(const MeshParts&) = delete;
  MeshParts& operator=(const MeshParts&) = delete;

  const Part& part(int index) const { return parts_[index]; }  // 0: all of it
  using Triangle = std::array<const Vector3*, 3>;
  Triangle triangle(int i) const  // i: from a part's begin to before its end
  {
    const Eigen::Vector3i& t = mesh_->triangles[order_[i]];
    return {&mesh_->vertices[t[0]], &mesh_->vertices[t[1]], &mesh_->vertices[t[2]]};
  }
  const FarthestPoint& corners(int part) const;

private:
  Part made(int begin, int end) const;
  void split(int part, int depth);
  FarthestPoint cornersOf(const Part& part) const;

  std::shared_ptr<const Mesh> mesh_;
  std::vector<int> order_;  // of the triangles, so that those of a part stand together
  std::vector<Part> parts_;
  std::unique_ptr<std::atomic<const FarthestPoint*>[]> corners_;
};

// A lower bound of the distance of two shapes, m: the gap between the shadows of their convex hulls in the best of some directions (Chung
// and Wang, Quick elimination of non-interference polytopes in virtual environments, 1996; once one parts them, Gilbert, 1966), and where
// the hulls overlap, the least of those of the meshes' parts. Not positive where none was found. Once it is more than `enough`, nothing
// better is looked for.
double gapOfHulls(const CollisionShape& a, const Transform& at_a, const CollisionShape& b, const Transform& at_b,
                  double enough);

// Is such a gap found? Sooner: what parted the same two shapes the last time, in this thread, is tried first, and their parts only where
// they were of use. So what was asked before decides whether a gap is found, but only of shapes that FCL calls free too.
bool areApart(const CollisionShape& a, const Transform& at_a, const CollisionShape& b, const Transform& at_b);
}  // namespace motion
