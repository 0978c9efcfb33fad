// A step, phase by phase.
#include <algorithm>

#include "phases.hpp"

namespace ode_sim {

void StepState::forget() {
  pairs.clear(), contacts.clear(), feedback.clear(), ode_contacts.clear(), weld_joints.clear();
  nodes.clear(), islands.clear(), left_behind.clear(), before.clear(), loads.clear(), weighed.clear();
}

void StepState::number(Scene& scene) {
  int model = 0, link = 0, joint = 0;
  for (auto& m : scene.models) {
    m->at = model++;
    for (auto& l : m->links) l->at = link++;
    for (auto& j : m->joints) j->at = joint++;
  }
  models.assign(model, {});
  links.assign(link, {});
  joints.assign(joint, {});
  number_clusters(scene);
}

void StepState::number_clusters(Scene& scene) {
  int cluster = 0;
  for (auto& m : scene.models)
    for (auto& c : m->clusters) c.at = cluster++;
  clusters.assign(cluster, {});
}

namespace {

void start_drives(Scene& scene, StepState& state) {
  for (auto& m : scene.models)
    if (m->has_drives) {
      weigh(scene, state, *m);
      for (auto& j : m->joints) j->previous_rate = j->rate;
      set_rates(scene, state, *m);
    }
  spread_carried(scene);
}

// What is pushed wakes up, before its contacts are looked for.
void wake_pushed(Scene& scene) {
  auto pushed = [](const auto& l) {
    return dot(l->force, l->force) > 0 || dot(l->torque, l->torque) > 0 || l->belt.speed != 0;
  };
  for (auto& m : scene.models)
    if (m->may_sleep && std::any_of(m->links.begin(), m->links.end(), pushed)) wake(scene, *m);
}

// Position drives whose links touch something become motors, and the clusters others.
void yield_to_contacts(Scene& scene, StepState& state) {
  if (!promote(scene, state)) return;
  reassemble(scene);
  state.number_clusters(scene);
  for (auto& m : scene.models)
    if (m->has_drives) set_rates(scene, state, *m);
  spread_carried(scene);
}

// The configuration of the cluster changed: the root link stays where the step took it, the composite mass follows.
void recompose(Scene& scene, Model& m, Cluster& c) {
  compose(c);
  place_cluster(c);
  if (!c.has_joints) return;
  const auto renew = [&](const Model& of) {
    for (auto& j : of.joints)
      if (j->joint && ((j->parent && &cluster_of(*j->parent) == &c) || &cluster_of(*j->child) == &c)) install(scene, *j);
  };
  renew(m);
  if (scene.bonds) renew(*scene.bonds);
}

bool drives_move(const Cluster& c) {
  return std::any_of(c.members.begin(), c.members.end(),
                     [](const Link* l) { return l->up && l->up->drive == DriveMode::Locked && l->up->rate != 0; });
}

void move_drives(Scene& scene, StepState& state) {
  keep_relations(scene);
  integrate_drives(scene);
  bool moved = false;
  for (auto& m : scene.models) {
    for (auto& j : m->joints) read_feedback(*j, state.of(*j));
    for (auto& c : m->clusters) {
      if (!c.moving || !drives_move(c)) continue;
      moved |= c.root != nullptr;
      recompose(scene, *m, c);
    }
  }
  if (moved) carry_along(scene);
}

void forget_forces(Scene& scene) {
  for (auto& m : scene.models) {
    for (auto& l : m->links) l->force = l->torque = {}, l->belt = {};
    for (auto& j : m->joints)
      for (auto& a : j->axes) a.stepped();
  }
}

void drop_step_joints(Scene& scene, StepState& state) {
  dJointGroupEmpty(scene.step_joints);
  for (auto& c : state.contacts) c.joint = nullptr;
  state.weld_joints.clear();
}

}  // namespace

void step_once(Scene& scene, StepState& state) {
  state.forget();
  refresh(scene);
  state.number(scene);
  start_drives(scene, state);
  wake_pushed(scene);
  take_led_velocities(scene);
  collide(scene, state);
  yield_to_contacts(scene, state);

  apply_forces(scene, state);
  make_weld_joints(scene, state);
  follow_drives(scene, state);
  make_contact_joints(scene, state);
  solve(scene, state);
  remember_loads(scene, state);
  guard_numbers(scene, state);

  pull(scene, false);
  move_drives(scene, state);
  for (auto& m : scene.models)
    if (!scene.settings.like_gazebo || m->has_drives) project_joints(scene, state, *m);
  forget_forces(scene);
  forget_led(scene);
  pull(scene);
  publish(scene, [&](const Joint& j) { return state.of(j).projected; });
  read_loads(scene, state);
  drop_step_joints(scene, state);
  rouse_all(state.left_behind);
  demote(scene);
}

// What a step that broke off has left in ODE goes; everything is put together anew for the next one.
void abandon_step(Scene& scene, StepState& state) {
  drop_step_joints(scene, state);
  state.contacts.clear();
  scene.borne.clear();
  guard_numbers(scene, state);
  scene.carried.clear();
  scene.replan = true;
  for (auto& m : scene.models) {
    m->dirty = true;
    for (auto& l : m->links) {
      l->force = l->torque = {}, l->belt = {};
      if (l->body) dBodySetForce(l->body, 0, 0, 0), dBodySetTorque(l->body, 0, 0, 0), dBodyDisable(l->body);
    }
    for (auto& j : m->joints)
      for (auto& a : j->axes) a.stepped();
  }
}

}  // namespace ode_sim
