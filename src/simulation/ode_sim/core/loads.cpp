// Force and torque of joints that ODE does not have. A position drive held exactly is no joint for ODE. What it bears follows from what
// is beyond: the change of its momentum less what else acts on it.
#include <algorithm>

#include "phases.hpp"

namespace ode_sim {

namespace {

// Once for each link, however many joints bear it; all about one point, so that those of a joint are sums.
void find_momentum(const Link& l, LinkStep& step, const Vec3& origin) {
  const Vec3 com = l.com_W();
  step.momentum = l.velocity_at(com) * l.mass;
  step.spin = rotate(l.X_WL.q, l.inertia * rotate(conjugate(l.X_WL.q), l.w)) + cross(com - origin, step.momentum);
}

void find_forces(const Scene& scene, const Link& l, LinkStep& step, const Vec3& origin) {
  step.force = (l.gravity ? scene.settings.gravity * l.mass : Vec3{}) + l.force;
  step.torque = cross(l.com_W() - origin, step.force) + l.torque;
}

// The sum of forces or momenta of the links, and of their moments, which come about the origin, about the anchor.
void sum(const StepState& state, const Load& load, Vec3 LinkStep::*what, Vec3 LinkStep::*moment, Vec3& total, Vec3& about) {
  total = about = {};
  for (const Link* l : *load.links) {
    const LinkStep& step = state.of(*l);
    total += step.*what;
    about += step.*moment;
  }
  about = about - cross(load.anchor - state.origin, total);
}

Load load_beyond(const Scene& scene, StepState& state, Joint& j) {
  Load load;
  bool loop = false;
  load.links = &links_beyond(j, &loop);
  if (loop) load.links = nullptr;
  if (loop) return load;
  load.anchor = j.frame_W().p;
  if (state.weighed.empty()) state.origin = j.child->X_WL.p;
  for (Link* l : *load.links) {
    LinkStep& step = state.of(*l);
    if (step.weighed) continue;
    step.weighed = true;
    state.weighed.push_back(l);
    find_momentum(*l, step, state.origin);
    find_forces(scene, *l, step, state.origin);
  }
  sum(state, load, &LinkStep::force, &LinkStep::torque, load.force, load.torque);
  sum(state, load, &LinkStep::momentum, &LinkStep::spin, load.momentum, load.spin);
  return load;
}

// What contacts, welds and joints that came while the world ran give the load, about its anchor.
void add_outer_forces(const Scene& scene, const StepState& state, const Load& load, Vec3& force, Vec3& torque) {
  auto beyond = [&](const Link* l) { return std::find(load.links->begin(), load.links->end(), l) != load.links->end(); };
  for (auto& c : state.contacts) {
    const bool a = beyond(c.a->link), b = beyond(c.b->link);
    if (c.feedback < 0 || a == b) continue;
    const Vec3 f = vec(state.feedback[c.feedback].f1) * ((c.swapped ? -1.0 : 1.0) * (a ? 1.0 : -1.0));
    force += f;
    torque += cross(c.pos - load.anchor, f);
  }
  for (auto& t : scene.welds) {
    const bool child = beyond(t.child.get()), parent = t.parent && beyond(t.parent.get());
    const dJointID joint = state.weld_joint(scene, t);
    if (!joint || child == parent) continue;
    const bool first = child == (body_of(t.child.get()) != nullptr);  // whether ODE's first body is of the load
    const Vec3 f = vec(first ? t.feedback.f1 : t.feedback.f2), at = vec(dBodyGetPosition(dJointGetBody(joint, first ? 0 : 1)));
    force += f;
    torque += vec(first ? t.feedback.t1 : t.feedback.t2) + cross(at - load.anchor, f);
  }
  if (!scene.bonds) return;
  for (auto& j : scene.bonds->joints) {
    const bool child = beyond(j->child), parent = j->parent && beyond(j->parent);
    if (child == parent) continue;
    const Feedback& its = j->feedback;
    force += child ? its.child_force : its.parent_force;
    torque += (child ? its.child_torque : its.parent_torque) +
              cross(j->frame_W().p - load.anchor, child ? its.child_force : its.parent_force);
  }
}

void read_load(const Scene& scene, const StepState& state, Joint& j, const Load& load) {
  j.feedback = {};
  if (!load.links) return;
  Vec3 linear, spin, force = load.force, torque = load.torque;
  sum(state, load, &LinkStep::momentum, &LinkStep::spin, linear, spin);
  add_outer_forces(scene, state, load, force, torque);
  force = -force;
  torque = -torque;
  if (!state.of(*j.model).jump) {
    force += (linear - load.momentum) * (1 / scene.settings.dt);
    torque += (spin - load.spin) * (1 / scene.settings.dt);
  }
  if (!finite(force) || !finite(torque)) return;
  j.feedback.child_force = force;
  j.feedback.child_torque = torque;
  j.feedback.parent_force = -j.feedback.child_force;
  j.feedback.parent_torque = -j.feedback.child_torque;
}

}  // namespace

// Before the step ...
void weigh(const Scene& scene, StepState& state, Model& model) {
  for (auto& j : model.joints)
    if (j->watched && j->drive == DriveMode::Locked) state.loads.push_back({j.get(), load_beyond(scene, state, *j)});
}

// ... and after it.
void read_loads(const Scene& scene, StepState& state) {
  for (Link* l : state.weighed) find_momentum(*l, state.of(*l), state.origin);
  for (auto& [joint, load] : state.loads)
    if (joint->drive == DriveMode::Locked) read_load(scene, state, *joint, load);
}

}  // namespace ode_sim
