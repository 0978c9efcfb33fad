#include "contact_rules.hpp"

#include <algorithm>
#include <cmath>

namespace ode_sim {

namespace {

// Resting contacts must persist, or friction is lost every other step: this much overlap (m) is left alone.
constexpr double kSlack = 2e-5;
constexpr double kDeep = 0.01;  // m: was put there, not pressed in

}  // namespace

bool is_deep(double depth) { return depth > kDeep; }

Hardness contact_hardness(const Surface& a, const Surface& b, const Touch& touch, const HardnessSettings& set) {
  Hardness out;
  const double kp = a.kp > 0 && b.kp > 0 ? 1 / (1 / a.kp + 1 / b.kp) : 0;
  const double soft = set.dt * kp + a.kd + b.kd;
  out.soft_erp = soft > 0 ? set.dt * kp / soft : set.erp;
  out.bounce = std::min(a.restitution, b.restitution);
  out.bounce_speed = std::min(a.bounce_threshold, b.bounce_threshold);
  double fastest = set.fastest;
  for (double v : {a.max_vel, b.max_vel})
    if (v >= 0) fastest = std::min(fastest, v);
  out.fastest = fastest;
  const double allowed = std::min(a.min_depth, b.min_depth);
  if (set.like_gazebo) {
    out.soft_cfm = soft > 0 ? 1 / soft : 1e-9;
    out.depth = std::max(touch.depth - allowed, 0.0);
    return out;
  }
  // A merged contact is as hard as those that it stands for.
  out.soft_cfm = std::max(soft > 0 ? 1 / soft : 1e-9, set.softness * set.dt * touch.inverse_mass) / touch.merged;

  // Depth beyond the tolerated one, cut so that it is corrected no faster than allowed, and no faster than gravity brings back
  // what is pushed out: it would fly. What was put deep into the floor comes out just that fast. What the model's own weight
  // presses in at this stiffness is no error to correct: cut as well, it would carry less than the weight, which then sinks
  // and sinks.
  double depth = std::max(touch.depth - std::max(allowed, kSlack), 0.0);
  const double g = set.gravity, comes_back = std::sqrt(2 * g * depth);
  if (g > 0) fastest = std::min(fastest, std::max(comes_back, 0.01));
  if (depth > kDeep && touch.one_is_fixed && -touch.outwards > 0.7 * g)
    fastest = std::max(fastest, 0.9 * std::sqrt(2 * g * (depth - kDeep)));
  double pressed_in = kp > 0 && touch.inverse_mass > 0 ? g / (touch.inverse_mass * kp) : 0;
  // A soft spring that was put in deeper pushes no more than it is to: each of several would carry the weight, and throw it.
  if ((touch.depth > kDeep || touch.emerging) && touch.leaving > 0 && pressed_in > kSlack)
    pressed_in *= std::max(1 - touch.leaving / fastest, 0.0);
  if (out.soft_erp > 0) depth = std::min(depth, fastest * set.dt / out.soft_erp + pressed_in);
  out.depth = depth;
  return out;
}

const Surface* directed(const Surface& a, const Surface& b) {
  const bool has_a = norm(a.fdir1) > 0, has_b = norm(b.fdir1) > 0;
  if (has_b && (!has_a || b.mu < a.mu)) return &b;
  return has_a ? &a : nullptr;
}

Vec3 friction_direction(const Vec3& n, const Vec3& wanted) {
  Vec3 t = wanted - n * dot(n, wanted);
  if (norm(t) < 1e-6) {
    const dReal normal[3] = {n.x, n.y, n.z};
    dReal p[3], q[3];
    dPlaneSpace(normal, p, q);
    t = vec(p);
  }
  return t * (1 / norm(t));
}

Roughness contact_roughness(const Surface& a, const Surface& b) {
  return {std::max(std::min(a.mu, b.mu), 0.0), std::max(std::min(a.mu2, b.mu2), 0.0), a.slip1 + b.slip1, a.slip2 + b.slip2};
}

}  // namespace ode_sim
