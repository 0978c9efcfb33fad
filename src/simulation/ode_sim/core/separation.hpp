// Pairs of meshes that are known to be apart: nobody looks for contacts between them until they have moved by as much.
//
// It spares work and decides nothing: what it says is apart has no contacts, so that a step comes out the same without it.
#pragma once
#include <cstdint>
#include <unordered_map>

#include "model.hpp"

namespace ode_sim {

// m, a lower bound of the distance between the convex hulls of two meshes; not positive where none was found. X_AB: pose of b's frame in
// a's. n: unit, from a to b in a's frame, where to begin; then the direction in which they are apart. By Gilbert's iteration (An Iterative
// Procedure for Computing the Minimum of a Quadratic Form on a Convex Set, SIAM J. Control 1966), whose every turn gives a bound.
double hulls_apart(const MeshData& a, const MeshData& b, const Pose& X_AB, Vec3& n);

// m, the most that a point within `reach` of `middle` (both in a body's frame) moved while the body went from X to Y.
double most_moved(const Pose& X, const Pose& Y, const Vec3& middle, double reach);

class Separations {
 public:
  // Whether the two are meshes with no contacts, as far as is known or quickly found out.
  bool apart(const Shape& a, const Shape& b);
  void forget();  // all: shapes have gone

 private:
  struct Known {
    Pose X_AB;            // when it was found out
    double distance = 0;  // m, at least, then
    Vec3 n{1, 0, 0};
    int wait = 0;  // steps before it is looked for again
  };
  std::unordered_map<uint64_t, Known> known_;  // by the ids of both
};

}  // namespace ode_sim
