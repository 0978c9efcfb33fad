#include "mesh_piece.hpp"

#include <algorithm>
#include <cmath>

#include "geometry.hpp"

namespace ode_sim {

namespace {

constexpr size_t kFew = 256;          // triangles: a mesh of fewer is taken whole
constexpr double kMuchLarger = 3;     // times the reach of the smaller one
constexpr double kGap = 1e-4;         // m beside the ball: ODE searches through triangles in single precision
constexpr size_t kMostKept = 300000;  // triangles of all pieces, before they are made anew
constexpr double kFarthestCell = 1e9;

void keep_triangles(dGeomID, dGeomID box, const int* triangles, int count) {
  static_cast<std::vector<int>*>(dGeomGetData(box))->assign(triangles, triangles + count);
}

// The cells that a ball reaches into; false where they are too many to count.
bool cells_of(const Vec3& middle, double radius, int exponent, std::array<int, 6>& cells) {
  const double size = std::ldexp(1.0, exponent), at[3] = {middle.x, middle.y, middle.z};
  for (int i = 0; i < 3; ++i) {
    const double low = std::floor((at[i] - radius) / size), high = std::floor((at[i] + radius) / size);
    if (!(std::abs(low) < kFarthestCell && std::abs(high) < kFarthestCell)) return false;
    cells[2 * i] = static_cast<int>(low), cells[2 * i + 1] = static_cast<int>(high);
  }
  return true;
}

// Whether a part of the mesh near a ball of this radius is much smaller than all of it.
bool is_worth_it(const MeshData& whole, double radius) {
  return whole.indices.size() >= 3 * kFew && radius > 0 && kMuchLarger * radius <= whole.reach;
}

}  // namespace

std::vector<int> MeshPieces::triangles_in(const std::shared_ptr<MeshData>& mesh, int exponent, const Cells& cells) {
  Whole& whole = wholes_[mesh.get()];
  if (!whole.geom) {
    whole.mesh = mesh;
    whole.geom = OwnedGeom(dCreateTriMesh(nullptr, mesh->data, nullptr, keep_triangles, nullptr));
  }
  const double size = std::ldexp(1.0, exponent);
  double middle[3], side[3];
  for (int i = 0; i < 3; ++i) {
    middle[i] = 0.5 * size * (cells[2 * i] + cells[2 * i + 1] + 1.0);
    side[i] = size * (cells[2 * i + 1] - cells[2 * i] + 1.0) + 2 * kGap;
  }
  const OwnedGeom box(dCreateBox(nullptr, side[0], side[1], side[2]));
  dGeomSetPosition(box, middle[0], middle[1], middle[2]);
  std::vector<int> triangles;
  dGeomSetData(box, &triangles);
  dContactGeom contact;
  dCollide(whole.geom, box, 1, &contact, sizeof contact);
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

MeshPiece MeshPieces::made(const std::shared_ptr<MeshData>& whole, const std::vector<int>& triangles) {
  MeshPiece piece;
  piece.number = ++made_;
  if (triangles.empty()) return piece;
  std::vector<dTriIndex> corners;
  for (int t : triangles)
    for (int i = 0; i < 3; ++i) corners.push_back(whole->indices[3 * t + i]);
  std::vector<dTriIndex> kept = corners;
  std::sort(kept.begin(), kept.end());
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
  std::vector<double> vertices;
  for (dTriIndex k : kept) vertices.insert(vertices.end(), &whole->vertices[3 * k], &whole->vertices[3 * k] + 3);
  for (dTriIndex& c : corners) c = static_cast<dTriIndex>(std::lower_bound(kept.begin(), kept.end(), c) - kept.begin());
  piece.mesh = std::make_unique<MeshData>(std::move(vertices), std::move(corners));
  piece.geom = OwnedGeom(dCreateTriMesh(nullptr, piece.mesh->data, nullptr, nullptr, nullptr));
  return piece;
}

const MeshPiece* MeshPieces::near(const std::shared_ptr<MeshData>& whole, const Vec3& middle, double radius) {
  if (!is_worth_it(*whole, radius)) return nullptr;
  const int exponent = std::ilogb(radius) + 1;
  Cells cells;
  if (!cells_of(middle, radius + kGap, exponent, cells)) return nullptr;
  const Key key{whole.get(), exponent, cells};
  if (const auto known = pieces_.find(key); known != pieces_.end()) return &known->second;
  const std::vector<int> triangles = triangles_in(whole, exponent, cells);
  if (triangles_ + triangles.size() > kMostKept) pieces_.clear(), triangles_ = 0;
  triangles_ += triangles.size() + 1;
  return &pieces_.emplace(key, made(whole, triangles)).first->second;
}

bool piece_is_of_first(const Shape& a, const Shape& b) { return a.mesh->reach > b.mesh->reach; }

const MeshPiece* MeshPieces::between(const Shape& a, const Shape& b) {
  if (!a.mesh || !b.mesh) return nullptr;
  const Shape &large = piece_is_of_first(a, b) ? a : b, &small = &large == &a ? b : a;
  if (!is_worth_it(*large.mesh, small.mesh->reach)) return nullptr;
  const Pose X_LS = inverse(large.link->X_WL * large.X_LC) * (small.link->X_WL * small.X_LC);
  return near(large.mesh, X_LS * small.mesh->middle, small.mesh->reach);
}

void MeshPieces::forget() {
  pieces_.clear();
  wholes_.clear();
  triangles_ = 0;
}

}  // namespace ode_sim
