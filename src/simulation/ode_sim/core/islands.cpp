// What moves together in a step, and what is at rest.
#include "ode_access.hpp"

#include <algorithm>
#include <numeric>

namespace ode_sim {

namespace {

bool moves(const Link& l) { return dot(l.v, l.v) + dot(l.w, l.w) > 0; }

}  // namespace

// Clusters that joints and contacts connect. ODE takes joints on a kinematic body for connections too, and so they are ones here:
// it would wake what hangs there in every pass in which the body takes part, and step it twice. A contact with a kinematic
// body is none, see make_contact_joints.
void World::find_islands() {
  nodes_.clear();
  std::vector<Link*> kinematic;
  for (auto& m : models_) {
    for (auto& c : m->clusters) {
      c.node = -1;
      if (!c.root || c.root->kinematic) continue;
      c.node = static_cast<int>(nodes_.size());
      nodes_.push_back(&c);
    }
    for (auto& l : m->links)
      if (l->carrier || (l->cluster >= 0 && l->kinematic && m->clusters[l->cluster].root == l.get())) kinematic.push_back(l.get());
  }
  for (size_t i = 0; i < kinematic.size(); ++i) kinematic[i]->node = static_cast<int>(nodes_.size() + i);

  std::vector<int> group(nodes_.size() + kinematic.size());
  std::iota(group.begin(), group.end(), 0);
  auto find = [&](int i) {
    while (group[i] != i) i = group[i] = group[group[i]];
    return i;
  };
  auto merge = [&](int a, int b) {
    if (a < 0 || b < 0) return;
    a = find(a), b = find(b);
    if (a != b) group[std::max(a, b)] = std::min(a, b);
  };
  auto node = [&](const Link* l) {  // of the body that a joint on this link holds
    if (!l || l->carrier) return l ? l->node : -1;
    const Cluster& c = cluster_of(*l);
    return c.root && c.root->kinematic ? c.root->node : c.node;
  };
  for (auto& m : models_)
    for (auto& j : m->joints)
      if (j->joint) merge(node(j->parent), node(j->child));
  for (auto& t : ties_)
    if (t.joint) merge(node(t.parent.get()), node(t.child.get()));
  for (auto& c : contacts_)
    if (c.joint) merge(cluster_of(*c.a->link).node, cluster_of(*c.b->link).node);

  islands_.clear();
  std::vector<int> island_of(group.size(), -1);
  auto island = [&](int i) -> Island& {
    int& number = island_of[find(i)];
    if (number < 0) {
      number = static_cast<int>(islands_.size());
      islands_.emplace_back();
    }
    return islands_[number];
  };
  for (size_t i = 0; i < nodes_.size(); ++i) island(static_cast<int>(i)).clusters.push_back(nodes_[i]);
  for (Link* l : kinematic) {
    Island& its = island(l->node);
    its.kinematic.push_back(l);
    its.driven |= moves(*l);
  }
  auto joined = [&](const Link* parent, const Link* child) {
    const int i = std::max(node(parent), node(child));
    if (i < 0) return;
    island(i).joints = true;
    island(i).rows += 6;
  };
  for (auto& m : models_)
    for (auto& j : m->joints)
      if (j->joint) joined(j->parent, j->child);
  for (auto& t : ties_)
    if (t.joint) joined(t.parent.get(), t.child.get());
  for (auto& c : contacts_) {
    if (!c.joint) continue;
    const int a = cluster_of(*c.a->link).node, b = cluster_of(*c.b->link).node;
    if (a < 0 && b < 0) continue;
    Island& touched = island(std::max(a, b));
    touched.contact_rows += 3;
    touched.driven |= (a < 0 && moves(*c.a->link)) || (b < 0 && moves(*c.b->link));
  }
}

// Decides whether the island takes part in the step. What nothing moves from outside goes to sleep after a while of standing still.
void World::rest(Island& island) {
  bool all_may_sleep = !island.driven, idle = true;
  island.awake = island.driven || island.clusters.empty();
  for (Cluster* c : island.clusters) {
    all_may_sleep &= c->root->model->may_sleep;
    if (!c->asleep) island.awake = true;
  }
  if (island.awake && all_may_sleep)
    for (Cluster* c : island.clusters) {
      dBodyID b = c->root->body;
      const Vec3 v = vec(dBodyGetLinearVel(b)), w = vec(dBodyGetAngularVel(b));
      if (dot(v, v) < 0.01 && dot(w, w) < 0.01) {
        ++c->idle_steps;
        c->idle_time += dt;
      } else {
        c->idle_steps = 0;
        c->idle_time = 0;
      }
      if (c->idle_steps < 5 || c->idle_time < 1.0) idle = false;
    }
  if (island.awake && all_may_sleep && idle && island.contact_rows > 0) {
    for (Cluster* c : island.clusters) {
      c->asleep = true;
      set_body_twist(c->root->body, {}, {});
      c->root->v = c->root->w = {};
      spread_twists(*c);
    }
    island.awake = false;
  }
  if (island.awake) {
    for (Cluster* c : island.clusters) c->asleep = false;
    return;
  }
  Pass all;
  all.add(island);
  for (dBodyID b : all.bodies) dBodySetForce(b, 0, 0, 0), dBodySetTorque(b, 0, 0, 0);
}

}  // namespace ode_sim
