#include "separation.hpp"

#include <algorithm>
#include <cmath>

namespace ode_sim {

namespace {

constexpr double kGap = 1e-4;         // m, left aside: ODE searches through triangles in single precision
constexpr int kTurns = 12;            // of Gilbert's iteration
constexpr double kGoodEnough = 0.8;   // of the distance, for a bound
constexpr size_t kCornersAStep = 50;  // looked at, on the average, for each pair
constexpr double kBeside = 0.1;       // of the reach of the smaller mesh: how far beside it a ball round it looks
constexpr int kPlaneWait = 4;         // steps, after a plane was found to touch

// The corner that lies furthest along d.
Vec3 furthest(const MeshData& mesh, const Vec3& d) {
  const std::vector<double>& v = mesh.vertices;
  size_t best = 0;
  double most = -kInf;
  for (size_t i = 0; i + 2 < v.size(); i += 3) {
    const double along = d.x * v[i] + d.y * v[i + 1] + d.z * v[i + 2];
    if (along > most) most = along, best = i;
  }
  return {v[best], v[best + 1], v[best + 2]};
}

// Of all points between two, the one nearest to the origin.
Vec3 nearest_between(const Vec3& p, const Vec3& q) {
  const Vec3 d = q - p;
  const double length2 = dot(d, d);
  return length2 > 0 ? p + d * std::clamp(-dot(p, d) / length2, 0.0, 1.0) : p;
}

}  // namespace

double hulls_apart(const MeshData& a, const MeshData& b, const Pose& X_AB, Vec3& n) {
  // Of b less that of a, in the furthest directions towards each other.
  const auto towards = [&](const Vec3& d) { return X_AB * furthest(b, rotate(conjugate(X_AB.q), -d)) - furthest(a, d); };
  Vec3 w = towards(n);
  double bound = dot(n, w);
  for (int turn = 0; turn < kTurns; ++turn) {
    const double length = norm(w);
    if (!(length > kGap) || bound > kGoodEnough * length) break;
    const Vec3 d = w * (1 / length), s = towards(d);
    if (dot(d, s) > bound) bound = dot(d, s), n = d;
    w = nearest_between(w, s);
  }
  return bound;
}

double most_moved(const Pose& X, const Pose& Y, const Vec3& middle, double reach) {
  const Quat turn = conjugate(X.q) * Y.q;
  const double chord = 2 * std::sqrt(turn.x * turn.x + turn.y * turn.y + turn.z * turn.z);  // of a circle of radius 1
  return norm(Y * middle - X * middle) + chord * reach;
}

bool outside_ball(dGeomID triangles, dGeomID ball, const Vec3& middle, double radius) {
  dGeomSphereSetRadius(ball, radius);
  dGeomSetPosition(ball, middle.x, middle.y, middle.z);
  dContactGeom first;
  return dCollide(triangles, ball, 1 | CONTACTS_UNIMPORTANT, &first, sizeof first) == 0;
}

bool Separations::apart(const Shape& a, const Shape& b, const MeshPiece* piece) {
  if (!(a.mesh || a.infinite) || !(b.mesh || b.infinite) || !(a.mesh || b.mesh)) return false;
  Known& known = known_[static_cast<uint64_t>(a.id) << 32 | static_cast<uint32_t>(b.id)];
  if (a.infinite) return apart_from_plane(known, b, a);
  if (b.infinite) return apart_from_plane(known, a, b);
  return meshes_apart(known, a, b, piece);
}

bool Separations::apart_from_plane(Known& known, const Shape& mesh, const Shape& plane) {
  const Pose X_WM = mesh.link->X_WL * mesh.X_LC;
  if (known.distance > most_moved(known.X_AB, X_WM, mesh.mesh->middle, mesh.mesh->reach)) return true;
  known.distance = 0;
  if (known.wait > 0) {
    --known.wait;
    return false;
  }
  const Vec3 lowest = X_WM * furthest(*mesh.mesh, rotate(conjugate(X_WM.q), -plane.plane_normal));
  known.X_AB = X_WM;
  known.distance = -dGeomPlanePointDepth(plane.geom, lowest.x, lowest.y, lowest.z) - kGap;
  if (known.distance > 0) return true;
  known.wait = kPlaneWait;
  return false;
}

bool Separations::meshes_apart(Known& known, const Shape& a, const Shape& b, const MeshPiece* piece) {
  if (piece && !piece->mesh) return true;
  const Pose X_WA = a.link->X_WL * a.X_LC, X_WB = b.link->X_WL * b.X_LC, X_AB = inverse(X_WA) * X_WB;
  if (const uint64_t number = piece ? piece->number : 0; known.piece != number) known = {X_AB, 0, known.n, 0, number};
  const bool first_is_larger = piece_is_of_first(a, b);
  const MeshData& ma = piece && first_is_larger ? *piece->mesh : *a.mesh;
  const MeshData& mb = piece && !first_is_larger ? *piece->mesh : *b.mesh;
  if (known.wait > 0) --known.wait;
  if (known.distance > most_moved(known.X_AB, X_AB, mb.middle, mb.reach)) return true;
  known.distance = 0;
  if (known.wait == 0) {
    known.wait = static_cast<int>((ma.vertices.size() + mb.vertices.size()) / 3 / kCornersAStep);
    known.X_AB = X_AB;
    known.distance = hulls_apart(ma, mb, X_AB, known.n) - kGap;
    if (known.distance > 0) return true;
    known.distance = 0;
  }
  const MeshData& small = first_is_larger ? mb : ma;
  const double beside = kBeside * small.reach;
  if (beside < kGap) return false;
  if (!ball_) ball_ = OwnedGeom(dCreateSphere(nullptr, 1));
  const Vec3 middle = (first_is_larger ? X_WB : X_WA) * small.middle;
  if (!outside_ball(first_is_larger ? a.geom : b.geom, ball_, middle, small.reach + beside)) return false;
  known.X_AB = X_AB;
  known.distance = beside - kGap;
  return true;
}

void Separations::forget() { known_.clear(); }

}  // namespace ode_sim
