// How hard, how rough and how fast a contact is, as pure functions of what touches.
#pragma once
#include "contact.hpp"
#include "math.hpp"
#include "model.hpp"

namespace ode_sim {

// What a contact is between, besides the two surfaces.
struct Touch {
  double depth = 0;           // m
  int merged = 1;             // contacts that it stands for
  double inverse_mass = 0;    // 1/kg, sum over the models that are not static
  bool one_is_fixed = false;  // of the two models, exactly one is static
  double leaving = 0;         // m/s, how fast they part already
  bool emerging = false;      // the other model still comes out of the static one
  double outwards = 0;        // m/s^2, gravity along the normal out of the static one: negative as on a floor
  // Whose max_vel and min_depth count: what cannot move has no part in it. Null where the other alone counts; both null: both surfaces.
  const Surface *corrected_a = nullptr, *corrected_b = nullptr;
};

// As dSurfaceParameters and dContactGeom::depth have them.
struct Hardness {
  double soft_erp = 0, soft_cfm = 0, depth = 0;
  double bounce = 0, bounce_speed = 0;  // speed: m/s from which it bounces
  double fastest = 0;                   // m/s, of pushing apart
};

// Of the world. gravity: its size, m/s^2; fastest: m/s.
struct HardnessSettings {
  double dt = 0.001, erp = 0.2, softness = 0.02, fastest = 100, gravity = 9.8;
  bool like_gazebo = false;
};

// More overlap (m) than falling presses in: it was put there.
bool is_deep(double depth);

// How hard the contact is, and how fast overlap is undone.
Hardness contact_hardness(const Surface& a, const Surface& b, const Touch& touch, const HardnessSettings& settings);

// Whose fdir1 counts: of two that have one, that with less friction. Null if neither has one.
const Surface* directed(const Surface& a, const Surface& b);

// The first of two directions of friction, in the contact plane: along `wanted`; any tangent where that has no part in the plane.
Vec3 friction_direction(const Vec3& normal, const Vec3& wanted);

// Friction in the first and second direction, and the slip of a single contact in each. spin: the greatest moment about the normal for
// each newton that presses, m.
struct Roughness {
  double mu = 0, mu2 = 0, slip1 = 0, slip2 = 0, spin = 0, spin_slip = 0;
  bool isotropic() const { return mu == mu2 && slip1 == slip2; }
};
Roughness contact_roughness(const Surface& a, const Surface& b, double depth);

}  // namespace ode_sim
