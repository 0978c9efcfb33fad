// Meshes that are known to be apart from another mesh or from a plane: nobody looks for contacts between the two until they have moved by
// as much.
//
// It spares work and decides nothing: what it says is apart has no contacts, so that a step comes out the same without it.
#pragma once
#include <cstdint>
#include <unordered_map>

#include "mesh_piece.hpp"
#include "model.hpp"

namespace ode_sim {

// m, a lower bound of the distance between the convex hulls of two meshes; not positive where none was found. X_AB: pose of b's frame in
// a's. n: unit, from a to b in a's frame, where to begin; then the direction in which they are apart. By Gilbert's iteration (An Iterative
// Procedure for Computing the Minimum of a Quadratic Form on a Convex Set, SIAM J. Control 1966), whose every turn gives a bound.
double hulls_apart(const MeshData& a, const MeshData& b, const Pose& X_AB, Vec3& n);

// Whether no triangle of the mesh comes into a ball, m. `ball`: a sphere of ODE's, which is moved. `triangles`: the mesh where it stands.
bool outside_ball(dGeomID triangles, dGeomID ball, const Vec3& middle, double radius);

// m, the most that a point within `reach` of `middle` (both in a body's frame) moved while the body went from X to Y.
double most_moved(const Pose& X, const Pose& Y, const Vec3& middle, double reach);

class Separations {
 public:
  // Whether the two are two meshes, or a mesh and a plane, with no contacts, as far as is known or quickly found out.
  // piece: of the larger of two meshes, if a part of it is all that can be touched
  bool apart(const Shape& a, const Shape& b, const MeshPiece* piece);
  void forget();  // all: shapes have gone

 private:
  struct Known {
    Pose X_AB;            // when it was found out
    double distance = 0;  // m, at least, then
    Vec3 n{1, 0, 0};
    int wait = 0;        // steps before it is looked for again
    uint64_t piece = 0;  // number of the piece that it was found out of; 0: the whole
  };
  bool meshes_apart(Known& known, const Shape& a, const Shape& b, const MeshPiece* piece);
  bool apart_from_plane(Known& known, const Shape& mesh, const Shape& plane);
  std::unordered_map<uint64_t, Known> known_;  // by the ids of both
  OwnedGeom ball_;
};

}  // namespace ode_sim
