#include "contact_rules.hpp"

#include <algorithm>
#include <cmath>

namespace ode_sim {

namespace {

// Resting contacts must persist, or friction is lost every other step: this much overlap (m) is left alone.
constexpr double kSlack = 2e-5;
constexpr double kDeep = 0.01;  // m: was put there, not pressed in
// Softness takes a part of what a blow gives back: as much as it is of the mass that is hit. A contact that bounces is as hard as the
// solvers can bear.
constexpr double kBouncing = 0.01;  // of the softness at rest

// Of two things that can move the lesser counts; what cannot has no say.
double lesser(const Surface* a, const Surface* b, double Surface::*field) {
  return !a ? b->*field : !b ? a->*field : std::min(a->*field, b->*field);
}

double fastest_allowed(const Surface* a, const Surface* b, double world) {
  auto own = [&](const Surface* s) { return s && s->max_vel >= 0 ? std::min(s->max_vel, world) : world; };
  return std::min(own(a), own(b));
}

// Share of the speed V of an impact with which it parts, so that it rises by `e` squared of what it fell. It is found where the step has
// put it, at a depth below the surface, and steps lead the law by half of one: both belong to the energy, which is V^2/2 - g d + g dt V/2
// below the surface when it comes, and u^2/2 - g d + g dt u/2 when it goes with u.
double rebound(double e, const Touch& touch, double dt) {
  const double V = -touch.leaving, g = touch.one_is_fixed ? -touch.outwards : 0, depth = touch.depth;
  if (!(g > 0) || V < 4 * g * dt || depth > V * dt) return e;  // too slow for a flight, or put there
  const double half = 0.5 * g * dt, came = V * V - 2 * g * depth + 2 * half * V;
  return (std::sqrt(half * half + 2 * g * depth + e * e * came) - half) / V;
}

}  // namespace

bool is_deep(double depth) { return depth > kDeep; }

Hardness contact_hardness(const Surface& a, const Surface& b, const Touch& touch, const HardnessSettings& set) {
  Hardness out;
  const double kp = a.kp > 0 && b.kp > 0 ? 1 / (1 / a.kp + 1 / b.kp) : 0;
  const double soft = set.dt * kp + a.kd + b.kd;
  out.soft_erp = soft > 0 ? set.dt * kp / soft : set.erp;
  out.bounce = std::min(a.restitution, b.restitution);
  out.bounce_speed = std::min(a.bounce_threshold, b.bounce_threshold);
  const bool both = !touch.corrected_a && !touch.corrected_b;
  const Surface *first = both ? &a : touch.corrected_a, *second = both ? &b : touch.corrected_b;
  double fastest = out.fastest = fastest_allowed(first, second, set.fastest);
  const double allowed = lesser(first, second, &Surface::min_depth);
  if (set.like_gazebo) {
    out.soft_cfm = soft > 0 ? 1 / soft : 1e-9;
    out.depth = std::max(touch.depth - allowed, 0.0);
    return out;
  }
  // A merged contact is as hard as those that it stands for.
  const bool bounces = out.bounce > 0 && -touch.leaving > out.bounce_speed;
  if (bounces) out.bounce = rebound(out.bounce, touch, set.dt);
  const double softness = bounces ? kBouncing * set.softness : set.softness;
  out.soft_cfm = std::max(soft > 0 ? 1 / soft : 1e-9, softness * set.dt * touch.inverse_mass) / touch.merged;

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

Roughness contact_roughness(const Surface& a, const Surface& b, double depth) {
  const bool by_patch = a.use_patch_radius && b.use_patch_radius;
  const double curvature = 1 / a.surface_radius + 1 / b.surface_radius;  // infinite of a point
  const double patch = by_patch ? std::max(a.patch_radius, b.patch_radius) : std::sqrt(std::max(depth, 0.0) / curvature);
  return {std::max(std::min(a.mu, b.mu), 0.0),
          std::max(std::min(a.mu2, b.mu2), 0.0),
          a.slip1 + b.slip1,
          a.slip2 + b.slip2,
          3 * M_PI / 16 * std::max(std::min(a.torsional_mu, b.torsional_mu), 0.0) * patch,  // that of Hertz's pressure
          a.torsional_slip + b.torsional_slip};
}

}  // namespace ode_sim
