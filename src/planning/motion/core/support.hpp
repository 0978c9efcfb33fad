// The farthest points of shapes in a direction, and directions in which two shapes, or all of their parts, are apart.
#pragma once

#include <vector>

#include "motion/shapes.hpp"

namespace motion
{
struct CollisionShape;

// Points in a tree of boxes, so that the farthest of many is found soon.
class FarthestPoint
{
public:
  explicit FarthestPoint(std::vector<Vector3> points);
  Vector3 along(const Vector3& direction) const;

private:
  struct Node
  {
    Vector3 centre, half;
    int first;  // a leaf's point, or the first of two nodes
    int count;  // of a leaf's points; 0: it is none
  };
  void split(int node, int first, int last);

  std::vector<Vector3> points_;
  std::vector<Node> nodes_;
};

// A mesh cut into halves, and these again. Immutable after its making, for any number of threads.
class MeshParts
{
public:
  struct Part
  {
    Vector3 centre, half;  // of its box along the mesh's axes
    FarthestPoint corners;
    int first = -1;  // of the two parts that it has; -1: none
  };

  explicit MeshParts(const Mesh& mesh);
  const Part& part(int index) const { return parts_[index]; }  // 0: all of it

private:
  Part made(const Mesh& mesh, const std::vector<int>& order, int first, int last) const;
  void split(const Mesh& mesh, std::vector<int>& order, int part, int first, int last, int depth);

  std::vector<Part> parts_;
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
