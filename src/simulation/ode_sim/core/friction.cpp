// Dry friction of contacts: its directions, and its greatest force.
//
// ODE's direct solver bounds friction (dContactApprox1) by the normal forces that it finds while nothing rubs yet. Where friction and
// motors shift the load - a braked wheel, a caster that is dragged - these are not the normal forces of the step: casters hold up
// to four times what they bear. So the bound follows from what the contact bore before, which is right as soon as it lasts.
// Not while something that moves pushes the model as well: what presses down as it pushes would let the two jam each other.
#include <algorithm>
#include <cmath>

#include "ode_access.hpp"

namespace ode_sim {

// N: the share of the lighter model's weight, taken as even; for what only needs its size.
double World::borne_by_contact(const Contact& c) const {
  double least = dInfinity;
  for (const Link* l : {c.a->link, c.b->link})
    if (!l->model->is_static) least = std::min(least, l->model->mass / l->model->contact_count);
  return std::isfinite(least) ? c.merged * least * norm(gravity) : 0;
}

// That of the same two shapes in the last step which was nearest, if any.
const Borne* World::borne_before(const Contact& c) const {
  auto key = [](const Borne& b) { return std::make_pair(b.a, b.b); };
  const auto wanted = std::make_pair(c.a->id, c.b->id);
  const Borne* nearest = nullptr;
  auto it = std::lower_bound(borne_.begin(), borne_.end(), wanted, [&](const Borne& b, const auto& k) { return key(b) < k; });
  for (double least = dInfinity; it != borne_.end() && key(*it) == wanted; ++it) {
    const Vec3 off = it->pos - c.pos;
    if (dot(off, off) < least) least = dot(off, off), nearest = &*it;
  }
  return nearest;
}

// After the solver: what each contact bore, as the mean with before; the blow of touching down is not what it will bear.
// Iterations bound friction by themselves, and between two things that move the load comes and goes with every step.
void World::remember_loads() {
  std::vector<Borne> now;
  now.reserve(contacts_.size());
  auto iterated = [&](const Link& l) { return cluster_of(l).root && cluster_of(l).iterative; };
  for (auto& c : contacts_) {
    if (!c.joint || like_gazebo || c.a->link->model->is_static == c.b->link->model->is_static || iterated(*c.a->link) || iterated(*c.b->link)) continue;
    const double normal = dot(vec(feedback_[c.feedback].f1), c.swapped ? -c.normal : c.normal);
    if (!std::isfinite(normal)) continue;
    const Borne* before = borne_before(c);
    const double lasting = before ? 0.5 * (before->normal + normal) : std::min(normal, borne_by_contact(c));
    now.push_back({c.a->id, c.b->id, c.pos, std::max(lasting, 0.0)});
  }
  borne_.swap(now);
}

void World::forget_loads(const Model& model) {
  auto gone = [&](const Borne& b) {
    const Shape *a = find_shape(b.a), *c = find_shape(b.b);
    return !a || !c || a->link->model == &model || c->link->model == &model;
  };
  borne_.erase(std::remove_if(borne_.begin(), borne_.end(), gone), borne_.end());
}

// Coefficients and slip of both directions of friction; returns the first one. n: normal of the contact as ODE has it.
Vec3 World::set_friction(const Contact& c, const Vec3& n, dContact& d) const {
  const Surface &sa = c.a->surface, &sb = c.b->surface;
  const double mu = std::max(std::min(sa.mu, sb.mu), 0.0), mu2 = std::max(std::min(sa.mu2, sb.mu2), 0.0);
  d.surface.mu = mu, d.surface.mu2 = mu2;
  d.surface.slip1 = (sa.slip1 + sb.slip1) * c.count;
  d.surface.slip2 = (sa.slip2 + sb.slip2) * c.count;
  double load = borne_by_contact(c);
  if (!like_gazebo) {
    double inverse_mass = 0;
    for (const Link* l : {c.a->link, c.b->link})
      if (!l->model->is_static) inverse_mass += 1 / l->model->mass;
    d.surface.slip1 += friction_softness * dt * inverse_mass;
    d.surface.slip2 += friction_softness * dt * inverse_mass;
    const bool pushed = c.a->link->model->touches_others || c.b->link->model->touches_others;
    if (const Borne* before = pushed ? nullptr : borne_before(c)) {
      d.surface.mode &= ~dContactApprox1;
      d.surface.mu *= before->normal, d.surface.mu2 *= before->normal;
      load = std::max(before->normal, 1e-3 * load);
    }
  }
  // First friction direction, where friction is not the same all around: what a collision asks for (of two that do, the one
  // with less friction), as seen in the contact plane; else any tangent.
  Vec3 t1{};
  const bool second = norm(sb.fdir1) > 0 && (norm(sa.fdir1) == 0 || sb.mu < sa.mu);
  const Shape& directed = second ? *c.b : *c.a;
  const bool isotropic = mu == mu2 && sa.slip1 + sb.slip1 == sa.slip2 + sb.slip2;
  if (isotropic && !like_gazebo) {
    // Where it slides, friction is to point against the motion, not along two fixed axes at once: fully along the slip, and
    // across it in proportion (Coulomb), or a wheel that spins would still be held sideways like one that stands.
    t1 = c.a->link->velocity_at(c.pos) - c.b->link->velocity_at(c.pos);
    t1 = t1 - n * dot(n, t1);
    const double speed = norm(t1);
    if (speed < 1e-5) t1 = {};
    else if (load > 0 && mu > 0) d.surface.slip2 += speed / (mu * load);
  } else if (norm(directed.surface.fdir1) > 0) {
    t1 = rotate(directed.link->X_WL.q * directed.X_LC.q, directed.surface.fdir1);
    t1 = t1 - n * dot(n, t1);
  }
  if (norm(t1) < 1e-6) {
    const dReal nn[3] = {n.x, n.y, n.z};
    dReal p[3], q[3];
    dPlaneSpace(nn, p, q);
    t1 = vec(p);
  }
  return t1 * (1 / norm(t1));
}

}  // namespace ode_sim
