// The solver for each island, and what becomes of numbers that are lost.
#include "ode_access.hpp"

#include <algorithm>
#include <cmath>

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

World::BodyState World::state_of(dBodyID b) {
  BodyState s;
  s.body = b;
  s.p = vec(dBodyGetPosition(b));
  s.q = quat(dBodyGetQuaternion(b));
  s.v = vec(dBodyGetLinearVel(b));
  s.w = vec(dBodyGetAngularVel(b));
  s.f = vec(dBodyGetForce(b));
  s.t = vec(dBodyGetTorque(b));
  std::memcpy(s.R, dBodyGetRotation(b), sizeof s.R);
  return s;
}

std::vector<World::BodyState> World::states_of(const std::vector<dBodyID>& bodies) {
  std::vector<BodyState> out;
  for (dBodyID b : bodies) out.push_back(state_of(b));
  return out;
}

void World::recall_bodies(const std::vector<BodyState>& in) {
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

// Bodies that a pass of a solver moves together.
void World::Pass::add(const Island& island) {
  for (Cluster* c : island.clusters) {
    clusters.push_back(c);
    bodies.push_back(c->root->body);
  }
  for (Link* l : island.kinematic) bodies.push_back(l->body);
}

void World::Pass::enable(bool on) const {
  for (dBodyID b : bodies) on ? dBodyEnable(b) : dBodyDisable(b);
}

// Steps the islands that are awake: small ones exactly, large ones iteratively.
void World::solve() {
  find_islands();
  for (auto& island : islands_) rest(island);
  std::vector<std::string> said;
  const Listening listening(said);
  before_.clear();
  for (Cluster* c : nodes_) before_.push_back(state_of(c->root->body));
  drop_absurd_forces();
  std::vector<BodyState> kinematic;
  std::vector<const Island*> touching_islands;
  Pass &exact = passes_[0], &touching = passes_[1], &iterative = passes_[2];
  for (Pass& pass : passes_) pass.clear();
  for (auto& island : islands_) {
    if (!island.awake) continue;
    for (Link* l : island.kinematic) kinematic.push_back(state_of(l->body));
    bool iterate = like_gazebo;
    if (like_gazebo) {
      iterative.add(island);
    } else if (island.contact_rows == 0 && island.rows <= kMostExactRows) {
      exact.add(island);
    } else if (island.rows + island.contact_rows <= (island.joints ? direct_rows : heap_rows)) {
      touching.add(island);
      touching_islands.push_back(&island);
    } else {
      iterative.add(island);
      iterate = true;
    }
    for (Cluster* c : island.clusters) c->iterative = iterate;
  }
  run_direct(exact, said);
  for (auto& s : said) report("ODE: " + s, island_names(exact.clusters));
  said.clear();
  if (const auto start = states_of(touching.bodies); !start.empty()) {
    run_direct(touching, said);
    if (!said.empty()) {
      recall_bodies(start);
      run_one_by_one(touching_islands, said);
    }
  }
  like_gazebo ? run_like_gazebo(iterative) : run_iterative(iterative, iters, said);
  for (auto& start : kinematic)
    if (!on_the_map(start.body)) {
      BodyState still = start;
      still.v = still.w = {};
      recall_bodies({still});
      report("a kinematic link left the map; it was stopped where it was. Look at the speeds commanded", "");
    }
}

void World::run_direct(const Pass& pass, std::vector<std::string>& said) {
  if (pass.bodies.empty()) return;
  said.clear();
  pass.enable(true);
  run(true, 0);
  pass.enable(false);
  ++counters.direct;
}

void World::run_iterative(const Pass& pass, int times, std::vector<std::string>& said) {
  if (pass.bodies.empty()) return;
  said.clear();
  pass.enable(true);
  {
    std::lock_guard<std::mutex> lock(ode_mutex);
    dRandSetSeed(static_cast<unsigned long>(mix(seed ^ mix(iterations)) & 0xffffffffu));
    run(false, times);
  }
  pass.enable(false);
  ++counters.quick;
  for (auto& s : said) report("ODE: " + s, island_names(pass.clusters));
  said.clear();
}

// The direct solver lost its way in some island: finds it, and gives that one to the iterative solver.
void World::run_one_by_one(const std::vector<const Island*>& islands, std::vector<std::string>& said) {
  for (const Island* island : islands) {
    Pass alone;
    alone.add(*island);
    const auto start = states_of(alone.bodies);
    run_direct(alone, said);
    if (said.empty()) continue;
    recall_bodies(start);
    for (Cluster* c : alone.clusters) c->iterative = true;
    run_iterative(alone, std::max(iters, std::min(10 * iters, 10000)), said);  // small: more iterations than usual are affordable
    ++counters.fallbacks;
  }
  said.clear();
}

void World::drop_absurd_forces() {
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
}

// A body whose numbers are lost goes back to where it was, at rest. What its ties are said to bear is then no number either.
void World::guard_nan() {
  for (auto& t : ties_)
    for (dReal* v : {t.feedback.f1, t.feedback.t1, t.feedback.f2, t.feedback.t2})
      if (!finite(vec(v))) t.feedback = {};
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
