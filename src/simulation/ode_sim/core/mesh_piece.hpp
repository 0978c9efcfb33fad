// The part of a large mesh that a small one can touch. ODE searches the trees of two meshes level by level together: beside a lawn of
// twenty metres each triangle of a small roller is looked at, however few touch. A piece is of the roller's own size.
//
// A piece depends on the mesh and on the cells that a ball reaches into, on nothing of before: a step that follows a recalled state
// comes out as the first time.
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <tuple>
#include <vector>

#include "model.hpp"

namespace ode_sim {

struct MeshPiece {
  std::unique_ptr<MeshData> mesh;  // null: nothing is there
  OwnedGeom geom;                  // of the mesh; whoever collides with it puts it where the whole stands
  uint64_t number = 0;             // from 1 on, of all pieces of the world
};

class MeshPieces {
 public:
  // The triangles of `whole` that come near a ball, and some beside it. middle, radius: m, in the frame of the mesh.
  // :returns: null where no part is much smaller than all; good until the next call
  const MeshPiece* near(const std::shared_ptr<MeshData>& whole, const Vec3& middle, double radius);
  // Of the larger of two meshes, near the smaller one; null where both are to be taken whole.
  const MeshPiece* between(const Shape& a, const Shape& b);
  void forget();  // all: shapes have gone

 private:
  struct Whole {
    std::shared_ptr<MeshData> mesh;
    OwnedGeom geom;  // in its own frame; tells which triangles a box touches
  };
  using Cells = std::array<int, 6>;                     // first and last, along each axis
  using Key = std::tuple<const MeshData*, int, Cells>;  // the int: cells are 2 to that power wide, m
  std::vector<int> triangles_in(const std::shared_ptr<MeshData>& whole, int exponent, const Cells& cells);
  MeshPiece made(const std::shared_ptr<MeshData>& whole, const std::vector<int>& triangles);
  std::map<const MeshData*, Whole> wholes_;
  std::map<Key, MeshPiece> pieces_;
  size_t triangles_ = 0;  // of all pieces
  uint64_t made_ = 0;
};

// Whether the part that a piece is taken of is a's mesh.
bool piece_is_of_first(const Shape& a, const Shape& b);

}  // namespace ode_sim
