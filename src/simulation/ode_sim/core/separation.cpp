#include "separation.hpp"

#include <algorithm>
#include <cmath>

namespace ode_sim {

namespace {

constexpr double kGap = 1e-4;         // m, left aside: ODE searches through triangles in single precision
constexpr int kTurns = 12;            // of Gilbert's iteration
constexpr double kGoodEnough = 0.8;   // of the distance, for a bound
constexpr size_t kCornersAStep = 50;  // looked at, on the average, for each pair

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

bool Separations::apart(const Shape& a, const Shape& b) {
  if (!a.mesh || !b.mesh) return false;
  Known& known = known_[static_cast<uint64_t>(a.id) << 32 | static_cast<uint32_t>(b.id)];
  const Pose X_AB = inverse(a.link->X_WL * a.X_LC) * (b.link->X_WL * b.X_LC);
  if (known.wait > 0) --known.wait;
  if (known.distance > most_moved(known.X_AB, X_AB, b.mesh->middle, b.mesh->reach)) return true;
  known.distance = 0;
  if (known.wait > 0) return false;
  known.wait = static_cast<int>((a.mesh->vertices.size() + b.mesh->vertices.size()) / 3 / kCornersAStep);
  known.X_AB = X_AB;
  known.distance = hulls_apart(*a.mesh, *b.mesh, X_AB, known.n) - kGap;
  return known.distance > 0;
}

void Separations::forget() { known_.clear(); }

}  // namespace ode_sim
