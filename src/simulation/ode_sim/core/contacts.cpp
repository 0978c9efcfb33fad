// Contact joints, with the rules of Gazebo Classic.
#include "phases.hpp"

#include "contact_rules.hpp"

namespace ode_sim {

namespace {

void count_contacts(StepState& state) {
  for (auto& c : state.contacts) {
    const Model &a = *c.a->link->model, &b = *c.b->link->model;
    state.of(a).contact_count += c.merged;
    state.of(b).contact_count += c.merged;
    if (&a != &b && !a.is_static && !b.is_static) state.of(a).touches_others = state.of(b).touches_others = true;
  }
}

// The body that a contact acts on. None where a kinematic one would not feel it: it connects nothing with anything.
dBodyID pushed(const Link& l) {
  const Cluster& c = cluster_of(l);
  return c.root && !c.root->kinematic ? static_cast<dBodyID>(c.root->body) : nullptr;
}

// m/s, how fast the two part at the contact.
double leaving(const Contact& c) { return dot(c.normal, c.a->link->velocity_at(c.pos) - c.b->link->velocity_at(c.pos)); }

// What was put deep into something static keeps to its way out until nothing of it has risen for a while.
void see_what_emerges(const Scene& scene, const StepState& state) {
  constexpr double kRises = 0.02, kWhile = 0.1;  // m/s, s
  for (auto& m : scene.models) m->emerging = std::max(m->emerging - scene.settings.dt, 0.0);
  for (auto& c : state.contacts) {
    Model &a = *c.a->link->model, &b = *c.b->link->model;
    if (a.is_static == b.is_static) continue;
    Model& m = a.is_static ? b : a;
    if (is_deep(c.depth) || (m.emerging > 0 && leaving(c) > kRises)) m.emerging = kWhile;
  }
}

// The surface whose max_vel and min_depth are those of the link's body; null where it has none. In Gazebo the last collision of the
// link gives them to the whole body.
const Surface* corrected(const Shape& shape, bool like_gazebo) {
  const Link& l = *shape.link;
  if (l.model->is_static) return nullptr;
  if (like_gazebo)
    for (auto s = l.shapes.rbegin(); s != l.shapes.rend(); ++s)
      if (!(*s)->infinite) return &(*s)->surface;
  return &shape.surface;
}

void set_hardness(const Settings& set, Contact& c, dContact& d) {
  const Model &a = *c.a->link->model, &b = *c.b->link->model;
  Touch touch;
  touch.depth = c.depth;
  touch.merged = c.merged;
  for (const Model* m : {&a, &b})
    if (!m->is_static) touch.inverse_mass += 1 / m->mass;
  touch.one_is_fixed = a.is_static != b.is_static;
  touch.outwards = a.is_static ? -dot(c.normal, set.gravity) : dot(c.normal, set.gravity);
  touch.leaving = leaving(c);
  touch.emerging = a.emerging > 0 || b.emerging > 0;
  touch.corrected_a = corrected(*c.a, set.like_gazebo), touch.corrected_b = corrected(*c.b, set.like_gazebo);
  const Hardness hard =
      contact_hardness(c.a->surface, c.b->surface, touch,
                       {set.dt, set.erp, set.contact_softness, set.contact_max_vel, norm(set.gravity), set.like_gazebo});
  d.surface.mode = dContactMu2 | dContactSoftERP | dContactSoftCFM | dContactApprox1 | dContactFDir1 | dContactBounce |
                   dContactSlip1 | dContactSlip2;
  d.surface.soft_erp = hard.soft_erp;
  d.surface.soft_cfm = hard.soft_cfm;
  d.surface.bounce = hard.bounce;
  d.surface.bounce_vel = hard.bounce_speed;
  d.geom.depth = hard.depth;
  c.fastest = hard.fastest;
}

// Surface speed that the bodies do not have: links moved by position drives, kinematic ones, and belts.
void set_surface_speed(const StepState& state, const Contact& c, const Vec3& n, const Vec3& t1, dBodyID first, dBodyID second,
                       dContact& d) {
  const Link *l1 = c.a->link, *l2 = c.b->link;
  if (c.swapped) std::swap(l1, l2);
  auto driven = [&](const Link* l) {
    const Cluster& k = cluster_of(*l);
    return l->moving || l->led || (k.root && k.root->kinematic) || (k.by && !state.of(*cluster_of(*k.by).root->model).jump);
  };
  const bool driven1 = driven(l1), driven2 = driven(l2);
  if (!driven1 && !driven2 && !l1->belt.told && !l2->belt.told) return;
  auto slide = [&](const Link* l, dBodyID body) {
    Vec3 u = l->velocity_at(c.pos);
    if (body) u = u - (body_velocity(body) + cross(body_spin(body), c.pos - vec(dBodyGetPosition(body))));
    return u;
  };
  const Vec3 u = (driven1 ? slide(l1, first) : Vec3{}) - (driven2 ? slide(l2, second) : Vec3{}) + l1->belt.surface_velocity(n) -
                 l2->belt.surface_velocity(-n);
  d.surface.mode |= dContactMotion1 | dContactMotion2 | dContactMotionN;
  d.surface.motion1 = -dot(t1, u);
  d.surface.motion2 = -dot(cross(n, t1), u);
  d.surface.motionN = -dot(n, u);
}

dContact as_ode_has_it(const Scene& scene, const StepState& state, Contact& c, dBodyID first, dBodyID second) {
  dContact d{};
  const Vec3 n = c.swapped ? -c.normal : c.normal;
  d.geom.pos[0] = c.pos.x;
  d.geom.pos[1] = c.pos.y;
  d.geom.pos[2] = c.pos.z;
  d.geom.normal[0] = n.x;
  d.geom.normal[1] = n.y;
  d.geom.normal[2] = n.z;
  set_hardness(scene.settings, c, d);
  set_friction(scene, state, c, n, d);
  set_surface_speed(state, c, n, vec(d.fdir1), first, second, d);
  return d;
}

}  // namespace

void make_contact_joints(Scene& scene, StepState& state) {
  count_contacts(state);
  see_what_emerges(scene, state);
  state.feedback.assign(state.contacts.size(), {});
  int next = 0;
  for (auto& c : state.contacts) {
    if (c.a->surface.collide_without_contact || c.b->surface.collide_without_contact) continue;
    dBodyID first = pushed(*c.a->link), second = pushed(*c.b->link);
    if (first == second) continue;
    c.swapped = !first;  // ODE's contact motion is only well defined with a first body
    if (c.swapped) std::swap(first, second);
    const dContact d = as_ode_has_it(scene, state, c, first, second);
    c.joint = dJointCreateContact(scene.ode, scene.step_joints, &d);
    dJointAttach(c.joint, first, second);
    c.row = static_cast<int>(state.ode_contacts.size());
    state.ode_contacts.push_back(d);
    c.told = c.a->watched || c.b->watched || state.of(*c.a->link).weighed || state.of(*c.b->link).weighed;
    c.feedback = next++;
    dJointSetFeedback(c.joint, &state.feedback[c.feedback]);
  }
}

std::vector<ContactRecord> contact_records(const StepState& state) {
  std::vector<ContactRecord> out;
  out.reserve(state.contacts.size());
  for (auto& c : state.contacts) {
    ContactRecord r{};
    r.collision1 = c.a->id;
    r.collision2 = c.b->id;
    r.position[0] = c.pos.x;
    r.position[1] = c.pos.y;
    r.position[2] = c.pos.z;
    r.normal[0] = c.normal.x;
    r.normal[1] = c.normal.y;
    r.normal[2] = c.normal.z;
    r.depth = c.depth;
    if (c.told && c.feedback >= 0 && c.feedback < static_cast<int>(state.feedback.size())) {
      // ODE gives what acts on its first body about that body's CoM; here: on the first link, about its CoM.
      const dJointFeedback& f = state.feedback[c.feedback];
      Vec3 force = c.swapped ? -vec(f.f1) : vec(f.f1);
      Vec3 torque = cross(c.pos - c.a->link->com_W(), force);
      if (!finite(force) || !finite(torque)) force = torque = {};  // the solver lost its way: nothing is known
      r.force[0] = force.x;
      r.force[1] = force.y;
      r.force[2] = force.z;
      r.torque[0] = torque.x;
      r.torque[1] = torque.y;
      r.torque[2] = torque.z;
    }
    out.push_back(r);
  }
  return out;
}

}  // namespace ode_sim
