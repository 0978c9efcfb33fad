// Islands, sleep, and the solver for each.
#include "ode_access.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ode_sim {

namespace {

constexpr double kFastest = 1e6;  // m/s, rad/s: a force that would give more in one step is a mistake

uint64_t mix(uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

// Whether the numbers of a body are still numbers, and its place one at which things can collide.
bool on_the_map(dBodyID b) {
  return finite(body_pose(b)) && finite(vec(dBodyGetLinearVel(b))) && finite(vec(dBodyGetAngularVel(b))) &&
         within(vec(dBodyGetPosition(b)), kFarthestPart);
}

}  // namespace

void World::remember_bodies(std::vector<BodyState>& out, const std::vector<Cluster*>& clusters) const {
  out.clear();
  for (Cluster* c : clusters) {
    BodyState s;
    s.body = c->root->body;
    s.p = vec(dBodyGetPosition(s.body));
    s.q = quat(dBodyGetQuaternion(s.body));
    s.v = vec(dBodyGetLinearVel(s.body));
    s.w = vec(dBodyGetAngularVel(s.body));
    s.f = vec(dBodyGetForce(s.body));
    s.t = vec(dBodyGetTorque(s.body));
    std::memcpy(s.R, dBodyGetRotation(s.body), sizeof s.R);
    out.push_back(s);
  }
}

void World::recall_bodies(const std::vector<BodyState>& in) const {
  for (auto& s : in) {
    set_body_pose(s.body, {s.p, s.q});
    set_body_twist(s.body, s.v, s.w);
    dBodySetForce(s.body, s.f.x, s.f.y, s.f.z);
    dBodySetTorque(s.body, s.t.x, s.t.y, s.t.z);
    const dReal q[4] = {s.q.w, s.q.x, s.q.y, s.q.z};
    std::memcpy(const_cast<dReal*>(dBodyGetQuaternion(s.body)), q, sizeof q);
    std::memcpy(const_cast<dReal*>(dBodyGetRotation(s.body)), s.R, sizeof s.R);
  }
}

std::string World::island_names(const std::vector<Cluster*>& clusters) const {
  std::vector<std::string> names;
  for (Cluster* c : clusters) {
    const std::string& n = c->root->model->name;
    if (std::find(names.begin(), names.end(), n) == names.end()) names.push_back(n);
  }
  std::string out;
  for (size_t i = 0; i < names.size() && i < 3; ++i) out += (i ? ", " : "") + names[i];
  if (names.size() > 3) out += " and " + std::to_string(names.size() - 3) + " more";
  return out;
}

void World::report(const std::string& text, const std::string& who) {
  const std::string line = (who.empty() ? "" : who + ": ") + text;
  if (message_counts_[line]++ == 0) messages_.push_back(line);
}

std::vector<std::string> World::take_messages() {
  std::vector<std::string> out;
  out.swap(messages_);
  return out;
}

void World::run(bool direct, int iterations_wanted) {
  try {
    if (direct) {
      dWorldStep(world_, dt);
    } else {
      dWorldSetQuickStepNumIterations(world_, iterations_wanted);
      dWorldSetQuickStepW(world_, sor);
      dWorldQuickStep(world_, dt);
    }
  } catch (const OdeFailure&) {
    // What the pass has not moved stays where it is; guard_nan mends what it has spoilt.
  }
}

// Finds the islands, puts those at rest to sleep, and steps the others: small ones exactly, large ones iteratively.
void World::solve() {
  nodes_.clear();
  for (auto& m : models_)
    for (auto& c : m->clusters) {
      c.node = -1;
      if (!c.root || c.root->kinematic) continue;
      c.node = static_cast<int>(nodes_.size());
      nodes_.push_back(&c);
    }
  std::vector<int> group(nodes_.size());
  std::iota(group.begin(), group.end(), 0);
  auto find = [&](int i) {
    while (group[i] != i) i = group[i] = group[group[i]];
    return i;
  };
  auto node = [&](const Link* l) { return l && !l->carrier ? l->model->clusters[l->cluster].node : -1; };
  auto merge = [&](int a, int b) {
    if (a < 0 || b < 0) return;
    a = find(a), b = find(b);
    if (a != b) group[std::max(a, b)] = std::min(a, b);
  };
  auto contact_node = [&](const Link* l) { return l->model->clusters[l->cluster].node; };
  for (auto& m : models_)
    for (auto& j : m->joints)
      if (j->joint) merge(node(j->parent), node(j->child));
  for (auto& t : ties_)
    if (t.joint) merge(node(t.parent.get()), node(t.child.get()));
  for (auto& c : contacts_)
    if (c.joint) merge(contact_node(c.a->link), contact_node(c.b->link));

  islands_.clear();
  std::vector<int> island_of(nodes_.size(), -1);
  for (size_t i = 0; i < nodes_.size(); ++i) {
    const int g = find(static_cast<int>(i));
    if (island_of[g] < 0) {
      island_of[g] = static_cast<int>(islands_.size());
      islands_.emplace_back();
    }
    island_of[i] = island_of[g];
    islands_[island_of[i]].clusters.push_back(nodes_[i]);
  }
  for (auto& m : models_)
    for (auto& j : m->joints)
      if (j->joint) {
        const int n = std::max(node(j->parent), node(j->child));
        if (n < 0) continue;
        islands_[island_of[n]].joints = true;
        islands_[island_of[n]].rows += j->type == JointType::Ball ? 3 : j->type == JointType::Universal ? 6 : 6;
      }
  for (auto& t : ties_)
    if (const int n = std::max(node(t.parent.get()), node(t.child.get())); t.joint && n >= 0) {
      islands_[island_of[n]].joints = true;
      islands_[island_of[n]].rows += 6;
    }
  for (auto& c : contacts_)
    if (c.joint) {
      const int n = std::max(contact_node(c.a->link), contact_node(c.b->link));
      if (n >= 0) islands_[island_of[n]].contact_rows += 3;
    }

  std::vector<Cluster*> exact, touching, iterative;
  std::vector<Island*> touching_islands;
  for (auto& island : islands_) {
    bool all_may_sleep = true, idle = true;
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
    for (Cluster* c : island.clusters) {
      if (island.awake) c->asleep = false;
      if (!island.awake) dBodySetForce(c->root->body, 0, 0, 0), dBodySetTorque(c->root->body, 0, 0, 0);
    }
    if (!island.awake) continue;
    auto& kind = island.contact_rows == 0 && island.rows <= kMostExactRows ? exact : island.rows + island.contact_rows <= (island.joints ? direct_rows : heap_rows) ? touching : iterative;
    kind.insert(kind.end(), island.clusters.begin(), island.clusters.end());
    if (&kind == &touching) touching_islands.push_back(&island);
  }

  auto enable = [&](const std::vector<Cluster*>& clusters, bool on) {
    for (Cluster* c : clusters) on ? dBodyEnable(c->root->body) : dBodyDisable(c->root->body);
  };
  // Kinematic bodies move in exactly one pass.
  std::vector<dBodyID> kinematic;
  std::vector<Pose> kinematic_start;
  for (auto& m : models_)
    for (auto& l : m->links)
      if (l->carrier || (l->kinematic && l->cluster >= 0 && m->clusters[l->cluster].root == l.get())) kinematic.push_back(l->body);
  for (dBodyID b : kinematic) {
    kinematic_start.push_back(body_pose(b));
    dBodyEnable(b);
  }

  auto run_iterative = [&](const std::vector<Cluster*>& clusters, int times, std::vector<std::string>& said) {
    said.clear();
    enable(clusters, true);
    {
      std::lock_guard<std::mutex> lock(ode_mutex);
      dRandSetSeed(static_cast<unsigned long>(mix(seed ^ mix(iterations)) & 0xffffffffu));
      run(false, times);
    }
    enable(clusters, false);
    ++counters.quick;
    for (auto& s : said) report("ODE: " + s, island_names(clusters));
    said.clear();
  };

  std::vector<std::string> said;
  const Listening listening(said);
  remember_bodies(before_, nodes_);
  for (Cluster* c : nodes_) {
    dBodyID b = c->root->body;
    const Vec3 f = vec(dBodyGetForce(b)), t = vec(dBodyGetTorque(b));
    const double size = norm(t);
    const double spin = size > 0 ? size * inverse_along(c->inertia, rotate(conjugate(c->root->X_WL.q), t * (1 / size))) : 0;
    if (norm(f) / c->mass * dt < kFastest && spin * dt < kFastest) continue;
    dBodySetForce(b, 0, 0, 0);
    dBodySetTorque(b, 0, 0, 0);
    report("a force beyond all reason was left out. Look at its masses, inertias and commands", c->root->model->name);
  }

  if (!exact.empty() || !kinematic.empty()) {
    enable(exact, true);
    run(true, 0);
    enable(exact, false);
    ++counters.direct;
    for (auto& s : said) report("ODE: " + s, island_names(exact));
    said.clear();
  }
  // ODE wakes them again with the islands that they touch: this is how far they have come in this step.
  std::vector<Pose> kinematic_poses;
  for (size_t i = 0; i < kinematic.size(); ++i) {
    const dBodyID b = kinematic[i];
    dBodyDisable(b);
    if (!on_the_map(b)) {
      set_body_pose(b, kinematic_start[i]);
      set_body_twist(b, {}, {});
      report("a kinematic link left the map; it was stopped where it was. Look at the speeds commanded", "");
    }
    kinematic_poses.push_back(body_pose(b));
  }
  if (!touching.empty()) {
    std::vector<BodyState> start;
    remember_bodies(start, touching);
    enable(touching, true);
    run(true, 0);
    enable(touching, false);
    ++counters.direct;
    if (!said.empty()) {
      // The direct solver lost its way in some island: find it, and give that one to the iterative solver.
      recall_bodies(start);
      for (Island* island : touching_islands) {
        said.clear();
        remember_bodies(start, island->clusters);
        enable(island->clusters, true);
        run(true, 0);
        enable(island->clusters, false);
        if (said.empty()) continue;
        recall_bodies(start);
        // Small, so that many more iterations than usual are affordable.
        run_iterative(island->clusters, 10 * iters, said);
        ++counters.fallbacks;
      }
      said.clear();
    }
  }
  if (!iterative.empty()) run_iterative(iterative, iters, said);
  for (size_t i = 0; i < kinematic.size(); ++i) {
    set_body_pose(kinematic[i], kinematic_poses[i]);
    dBodyDisable(kinematic[i]);
  }
}

// A body whose numbers are lost goes back to where it was, at rest.
void World::guard_nan() {
  for (auto& s : before_) {
    if (on_the_map(s.body)) continue;
    for (auto& n : nodes_)
      if (n->root->body == s.body)
        report("its motion became infinite; it was stopped where it was. Look at its masses, inertias and commands",
               n->root->model->name);
    BodyState still = s;
    still.v = still.w = still.f = still.t = {};
    recall_bodies({still});
  }
}

}  // namespace ode_sim
