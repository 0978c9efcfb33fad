// Dry friction of contacts: its directions, and its greatest force.
//
// ODE's direct solver bounds friction (dContactApprox1) by the normal forces that it finds while nothing rubs yet. Where friction and
// motors shift the load - a braked wheel, a caster that is dragged - these are not the normal forces of the step: casters hold up
// to four times what they bear. So the bound follows from what the contact bore before, which is right as soon as it lasts.
// Not while something that moves pushes the model as well: what presses down as it pushes would let the two jam each other.
#include <algorithm>
#include <cmath>

#include "contact_rules.hpp"
#include "phases.hpp"

namespace ode_sim {

namespace {

// That of the same two shapes in the last step which was nearest, if any.
const Borne* borne_before(const std::vector<Borne>& borne, const Contact& c) {
  auto key = [](const Borne& b) { return std::make_pair(b.a, b.b); };
  const auto wanted = std::make_pair(c.a->id, c.b->id);
  const Borne* nearest = nullptr;
  auto it = std::lower_bound(borne.begin(), borne.end(), wanted, [&](const Borne& b, const auto& k) { return key(b) < k; });
  for (double least = dInfinity; it != borne.end() && key(*it) == wanted; ++it) {
    const Vec3 off = it->pos - c.pos;
    if (dot(off, off) < least) least = dot(off, off), nearest = &*it;
  }
  return nearest;
}

// The way that a belt is meant to go, else fdir1 of the surface that counts; world axes.
Vec3 asked_for(const Contact& c) {
  if (c.a->link->belt.told) return c.a->link->belt.meant(c.pos, c.normal);
  if (c.b->link->belt.told) return c.b->link->belt.meant(c.pos, -c.normal);
  const Surface* surface = directed(c.a->surface, c.b->surface);
  if (!surface) return {};
  const Shape& shape = surface == &c.a->surface ? *c.a : *c.b;
  return rotate(shape.link->X_WL.q * shape.X_LC.q, surface->fdir1);
}

}  // namespace

// N: the share of the lighter model's weight, taken as even; for what only needs its size.
double borne_by_contact(const Scene& scene, const StepState& state, const Contact& c) {
  double least = dInfinity;
  for (const Link* l : {c.a->link, c.b->link})
    if (!l->model->is_static) least = std::min(least, l->model->mass / state.of(*l->model).contact_count);
  return std::isfinite(least) ? c.merged * least * norm(scene.settings.gravity) : 0;
}

// After the solver: what each contact bore, as the mean with before; the blow of touching down is not what it will bear.
// Iterations bound friction by themselves, and between two things that move the load comes and goes with every step.
void remember_loads(Scene& scene, const StepState& state) {
  std::vector<Borne> now;
  now.reserve(state.contacts.size());
  auto iterated = [&](const Link& l) { return cluster_of(l).root && state.of(cluster_of(l)).iterative; };
  for (auto& c : state.contacts) {
    if (!c.joint || scene.settings.like_gazebo || c.a->link->model->is_static == c.b->link->model->is_static) continue;
    if (iterated(*c.a->link) || iterated(*c.b->link)) continue;
    const double normal = dot(vec(state.feedback[c.feedback].f1), c.swapped ? -c.normal : c.normal);
    if (!std::isfinite(normal)) continue;
    const Borne* before = borne_before(scene.borne, c);
    const double lasting = before ? 0.5 * (before->normal + normal) : std::min(normal, borne_by_contact(scene, state, c));
    now.push_back({c.a->id, c.b->id, c.pos, std::max(lasting, 0.0)});
  }
  scene.borne.swap(now);
}

void forget_loads(Scene& scene, const Model& model) {
  auto gone = [&](const Borne& b) {
    const Shape *a = scene.find_shape(b.a), *c = scene.find_shape(b.b);
    return !a || !c || a->link->model == &model || c->link->model == &model;
  };
  scene.borne.erase(std::remove_if(scene.borne.begin(), scene.borne.end(), gone), scene.borne.end());
}

// Coefficients, slip and first direction. n: normal of the contact as ODE has it.
void set_friction(const Scene& scene, const StepState& state, Contact& c, const Vec3& n, dContact& d) {
  const Settings& set = scene.settings;
  double load = borne_by_contact(scene, state, c);
  // The contacts of the default solver are softer than their surfaces: what presses goes as deep as kp lets it.
  const double depth = set.like_gazebo ? d.geom.depth : load * (1 / c.a->surface.kp + 1 / c.b->surface.kp);
  const Roughness rough = contact_roughness(c.a->surface, c.b->surface, std::min(depth, c.depth));
  d.surface.mu = rough.mu, d.surface.mu2 = rough.mu2;
  d.surface.slip1 = rough.slip1 * c.count;
  d.surface.slip2 = rough.slip2 * c.count;
  if (rough.spin > 0) d.surface.mode |= dContactRolling, d.surface.rhoN = rough.spin;
  c.spin_slip = rough.spin_slip * c.count;
  if (!set.like_gazebo) {
    double inverse_mass = 0;
    for (const Link* l : {c.a->link, c.b->link})
      if (!l->model->is_static) inverse_mass += 1 / l->model->mass;
    d.surface.slip1 += set.friction_softness * set.dt * inverse_mass;
    d.surface.slip2 += set.friction_softness * set.dt * inverse_mass;
    const bool pushed = state.of(*c.a->link->model).touches_others || state.of(*c.b->link->model).touches_others;
    if (const Borne* before = pushed ? nullptr : borne_before(scene.borne, c)) {
      d.surface.mode &= ~dContactApprox1;
      d.surface.mu *= before->normal, d.surface.mu2 *= before->normal, d.surface.rhoN *= before->normal;
      load = std::max(before->normal, 1e-3 * load);
    }
    if (c.spin_slip > 0) {  // ODE knows no slip of it: no moment beyond that of the speed
      const double moment = std::abs(dot(n, c.a->link->w - c.b->link->w)) / c.spin_slip;
      const bool known = !(d.surface.mode & dContactApprox1);
      if (known || load > 0) d.surface.rhoN = std::min(d.surface.rhoN, known ? moment : moment / load);
    }
  }
  Vec3 wanted;
  if (rough.isotropic() && !set.like_gazebo) {
    // Where it slides, friction is to point against the motion, not along two fixed axes at once: fully along the slip, and
    // across it in proportion (Coulomb), or a wheel that spins would still be held sideways like one that stands.
    wanted = c.a->link->velocity_at(c.pos) - c.b->link->velocity_at(c.pos) + c.a->link->belt.surface_velocity(c.normal) -
             c.b->link->belt.surface_velocity(-c.normal);
    const double speed = norm(wanted - n * dot(n, wanted));
    if (speed < 1e-5) wanted = {};
    else if (load > 0 && rough.mu > 0) d.surface.slip2 += speed / (rough.mu * load);
  } else {
    wanted = asked_for(c);
  }
  const Vec3 t1 = friction_direction(n, wanted);
  d.fdir1[0] = t1.x, d.fdir1[1] = t1.y, d.fdir1[2] = t1.z;
}

}  // namespace ode_sim
