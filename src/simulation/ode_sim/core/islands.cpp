// What moves together in a step, and what is at rest.
#include <utility>

#include "groups.hpp"
#include "phases.hpp"

namespace ode_sim {

void Pass::add(const Island& island) {
  for (Cluster* c : island.clusters) {
    clusters.push_back(c);
    bodies.push_back(c->root->body);
  }
  for (Link* l : island.kinematic) bodies.push_back(l->body);
  islands.push_back(&island);
}

void Pass::enable(bool on) const {
  for (dBodyID b : bodies) on ? dBodyEnable(b) : dBodyDisable(b);
}

namespace {

bool moves(const Link& l) { return dot(l.v, l.v) + dot(l.w, l.w) > 0 || l.belt.speed != 0; }

// Clusters that joints and contacts connect. ODE takes joints on a kinematic body for connections too, and so they are ones here:
// it would wake what hangs there in every pass in which the body takes part, and step it twice. A contact with a kinematic
// body is none, see make_contact_joints.
class IslandSearch {
 public:
  IslandSearch(Scene& scene, StepState& state) : scene_(scene), state_(state) {}

  void run() {
    number();
    Groups groups(state_.nodes.size() + kinematic_.size());
    each_joint([&](const Link* parent, const Link* child) { groups.merge(node(parent), node(child)); });
    for (auto& c : state_.contacts)
      if (c.joint) groups.merge(node_of_contact(*c.a->link), node_of_contact(*c.b->link));
    gather(groups);
    count_rows(groups);
  }

 private:
  Scene& scene_;
  StepState& state_;
  std::vector<Link*> kinematic_;
  std::vector<int> island_of_;

  void number() {
    for (auto& m : scene_.models) {
      for (auto& c : m->clusters) {
        if (!c.root || c.root->kinematic) continue;
        state_.of(c).node = static_cast<int>(state_.nodes.size());
        state_.nodes.push_back(&c);
      }
      for (auto& l : m->links)
        if (l->carrier || (l->cluster >= 0 && l->kinematic && cluster_of(*l).root == l.get())) kinematic_.push_back(l.get());
    }
    for (size_t i = 0; i < kinematic_.size(); ++i) state_.of(*kinematic_[i]).node = static_cast<int>(state_.nodes.size() + i);
  }

  int node_of_contact(const Link& l) const { return state_.of(cluster_of(l)).node; }

  // Of the body that a joint on this link holds.
  int node(const Link* l) const {
    if (!l) return -1;
    if (l->carrier) return state_.of(*l).node;
    const Cluster& c = cluster_of(*l);
    return c.root && c.root->kinematic ? state_.of(*c.root).node : state_.of(c).node;
  }

  template <class Do>
  void each_joint(Do what) {
    for (auto& m : scene_.models)
      for (auto& j : m->joints)
        if (j->joint) what(j->parent, j->child);
    for (auto& t : scene_.welds)
      if (state_.weld_joint(scene_, t)) what(t.parent.get(), t.child.get());
  }

  Island& island(Groups& groups, int node) {
    int& number = island_of_[groups.find(node)];
    if (number < 0) {
      number = static_cast<int>(state_.islands.size());
      state_.islands.emplace_back();
    }
    return state_.islands[number];
  }

  void gather(Groups& groups) {
    state_.islands.clear();
    island_of_.assign(groups.size(), -1);
    for (size_t i = 0; i < state_.nodes.size(); ++i) island(groups, static_cast<int>(i)).clusters.push_back(state_.nodes[i]);
    for (Link* l : kinematic_) {
      Island& its = island(groups, state_.of(*l).node);
      its.kinematic.push_back(l);
      its.driven |= moves(*l);
    }
  }

  void count_rows(Groups& groups) {
    each_joint([&](const Link* parent, const Link* child) {
      const int i = std::max(node(parent), node(child));
      if (i < 0) return;
      island(groups, i).joints = true;
      island(groups, i).rows += 6;
    });
    for (auto& m : scene_.models)
      for (auto& j : m->joints)
        if (j->joint && j->unknown_to_ode())
          if (const int i = std::max(node(j->parent), node(j->child)); i >= 0) island(groups, i).geared = true;
    for (auto& c : state_.contacts) {
      if (!c.joint) continue;
      const int a = node_of_contact(*c.a->link), b = node_of_contact(*c.b->link);
      if (a < 0 && b < 0) continue;
      Island& touched = island(groups, std::max(a, b));
      touched.contact_rows += 3;
      touched.driven |= (a < 0 && moves(*c.a->link)) || (b < 0 && moves(*c.b->link));
    }
  }
};

// Counts how long the cluster has hardly moved; whether that is long enough to sleep.
bool idle_for_long(Cluster& c, double dt) {
  const Vec3 v = body_velocity(c.root->body), w = body_spin(c.root->body);
  if (dot(v, v) < 0.01 && dot(w, w) < 0.01) {
    ++c.idle_steps;
    c.idle_time += dt;
  } else {
    c.idle_steps = 0;
    c.idle_time = 0;
  }
  return c.idle_steps >= 5 && c.idle_time >= 1.0;
}

void fall_asleep(Cluster& c) {
  c.asleep = true;
  set_body_twist(c.root->body, {}, {});
  c.root->v = c.root->w = {};
  spread_twists(c);
}

}  // namespace

void find_islands(Scene& scene, StepState& state) { IslandSearch(scene, state).run(); }

// Decides whether the island takes part in the step. What nothing moves from outside goes to sleep after a while of standing still.
void rest(const Scene& scene, Island& island, std::vector<Cluster*>& woken) {
  bool all_may_sleep = !island.driven, idle = true;
  island.awake = island.driven || island.clusters.empty();
  for (Cluster* c : island.clusters) {
    all_may_sleep &= c->root->model->may_sleep;
    if (!c->asleep) island.awake = true;
  }
  if (island.awake && all_may_sleep)
    for (Cluster* c : island.clusters) idle &= idle_for_long(*c, scene.settings.dt);
  if (island.awake && all_may_sleep && idle && island.contact_rows > 0) {
    for (Cluster* c : island.clusters) fall_asleep(*c);
    island.awake = false;
  }
  if (island.awake) {
    for (Cluster* c : island.clusters)
      if (std::exchange(c->asleep, false)) c->idle_steps = 0, c->idle_time = 0, woken.push_back(c);
    return;
  }
  Pass all;
  all.add(island);
  for (dBodyID b : all.bodies) dBodySetForce(b, 0, 0, 0), dBodySetTorque(b, 0, 0, 0);
}

}  // namespace ode_sim
