// The solver for each island, and what becomes of numbers that are lost.
#include <algorithm>
#include <cmath>

#include "phases.hpp"

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
  return finite(body_pose(b)) && finite(body_velocity(b)) && finite(body_spin(b)) &&
         within(vec(dBodyGetPosition(b)), kFarthestPart);
}

std::string names_of(const std::vector<Cluster*>& clusters) {
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

// What ODE said of a pass goes to the user.
void tell(Scene& scene, const Pass& pass, std::vector<std::string>& said) {
  for (auto& s : said) scene.messages.report("ODE: " + s, names_of(pass.clusters));
  said.clear();
}

void run_direct(Scene& scene, const Pass& pass, std::vector<std::string>& said) {
  if (pass.bodies.empty()) return;
  said.clear();
  pass.enable(true);
  solver_pass(scene, true, 0);
  pass.enable(false);
  ++scene.counters.direct;
}

void run_iterative(Scene& scene, const Pass& pass, int times, std::vector<std::string>& said) {
  if (pass.bodies.empty()) return;
  said.clear();
  pass.enable(true);
  {
    std::lock_guard<std::mutex> lock(ode_mutex);
    dRandSetSeed(static_cast<unsigned long>(order_seed(scene) & 0xffffffffu));
    solver_pass(scene, false, times);
  }
  pass.enable(false);
  ++scene.counters.quick;
  tell(scene, pass, said);
}

// The direct solver lost its way in some island: finds it, and gives that one to the iterative solver.
void run_one_by_one(Scene& scene, StepState& state, std::vector<std::string>& said) {
  const int iters = scene.settings.iters;
  for (const Island* island : state.touching.islands) {
    Pass alone;
    alone.add(*island);
    const auto start = states_of(alone.bodies);
    run_direct(scene, alone, said);
    if (said.empty()) continue;
    recall(start);
    for (Cluster* c : alone.clusters) state.of(*c).iterative = true;
    run_iterative(scene, alone, std::max(iters, std::min(10 * iters, 10000)),
                  said);  // small: more iterations than usual are affordable
    ++scene.counters.fallbacks;
  }
  said.clear();
}

void run_touching(Scene& scene, StepState& state, std::vector<std::string>& said) {
  const auto start = states_of(state.touching.bodies);
  if (start.empty()) return;
  run_direct(scene, state.touching, said);
  if (said.empty()) return;
  recall(start);
  run_one_by_one(scene, state, said);
}

void drop_absurd_forces(Scene& scene, const StepState& state) {
  const double dt = scene.settings.dt;
  for (Cluster* c : state.nodes) {
    dBodyID b = c->root->body;
    const Vec3 f = vec(dBodyGetForce(b)), t = vec(dBodyGetTorque(b));
    const double size = norm(t);
    const double spin = size > 0 ? size * inverse_along(c->inertia, rotate(conjugate(c->root->X_WL.q), t * (1 / size))) : 0;
    if (norm(f) / c->mass * dt < kFastest && spin * dt < kFastest) continue;
    dBodySetForce(b, 0, 0, 0);
    dBodySetTorque(b, 0, 0, 0);
    scene.messages.report("a force beyond all reason was left out. Look at its masses, inertias and commands",
                          c->root->model->name);
  }
}

// Joints alone exactly, small islands with contacts exactly if the direct solver finds its way, trees of joints in larger ones exactly
// and their contacts by iterations, piles by iterations.
void choose_solvers(const Settings& set, StepState& state) {
  for (Pass* pass : {&state.exact, &state.touching, &state.iterative}) pass->clear();
  state.trees.clear(), state.piles.clear();
  for (auto& island : state.islands) {
    if (!island.awake) continue;
    const bool alone = island.contact_rows == 0 && island.rows <= kMostExactRows;
    const bool small = island.rows + island.contact_rows <= (island.joints ? set.direct_rows : set.heap_rows);
    Pass& pass = set.like_gazebo ? state.iterative : alone ? state.exact : small ? state.touching : state.iterative;
    const bool own = (island.geared || &pass == &state.iterative) && !set.like_gazebo;
    if (own) (island.joints ? state.trees : state.piles).push_back(&island);
    else pass.add(island);
    for (Cluster* c : island.clusters) state.of(*c).iterative = own || &pass == &state.iterative;
  }
}

std::vector<BodyState> kinematic_states(const StepState& state) {
  std::vector<BodyState> out;
  for (auto& island : state.islands)
    if (island.awake)
      for (Link* l : island.kinematic) out.push_back(state_of(l->body));
  return out;
}

void stop(BodyState at) {
  at.v = at.w = {};
  recall(at);
}

}  // namespace

// Of the order in which iterations go over the rows of this step.
uint64_t order_seed(const Scene& scene) { return mix(scene.settings.seed ^ mix(scene.iterations)); }

void solver_pass(Scene& scene, bool direct, int iterations) {
  const Settings& set = scene.settings;
  try {
    if (direct) {
      dWorldStep(scene.ode, set.dt);
    } else {
      dWorldSetQuickStepNumIterations(scene.ode, iterations);
      dWorldSetQuickStepW(scene.ode, set.sor);
      dWorldQuickStep(scene.ode, set.dt);
    }
  } catch (const OdeFailure&) {
    // What the pass has not moved stays where it is; guard_numbers mends what it has spoilt.
  }
}

// Steps the islands that are awake.
void solve(Scene& scene, StepState& state) {
  find_islands(scene, state);
  std::vector<Cluster*> woken;
  for (auto& island : state.islands) rest(scene, island, woken);
  state.left_behind = resting_on(scene, woken);
  std::vector<std::string> said;
  const OdeScope scope(said);
  state.before.clear();
  for (Cluster* c : state.nodes) state.before.push_back(state_of(c->root->body));
  drop_absurd_forces(scene, state);
  const auto kinematic = kinematic_states(state);
  choose_solvers(scene.settings, state);
  run_direct(scene, state.exact, said);
  tell(scene, state.exact, said);
  run_touching(scene, state, said);
  for (const Island* island : state.piles) run_pile(scene, state, *island);
  for (const Island* island : state.trees)
    if (!run_trees(scene, state, *island)) {
      Pass all;
      all.add(*island);
      if (island->geared) run_like_gazebo(scene, state, all);
      else state.iterative.add(*island);
    }
  if (scene.settings.like_gazebo) run_like_gazebo(scene, state, state.iterative);
  else run_iterative(scene, state.iterative, scene.settings.iters, said);
  for (auto& start : kinematic)
    if (!on_the_map(start.body)) {
      stop(start);
      scene.messages.report("a kinematic link left the map; it was stopped where it was. Look at the speeds commanded", "");
    }
}

// A body whose numbers are lost goes back to where it was, at rest. What its welds are said to bear is then no number either.
void guard_numbers(Scene& scene, StepState& state) {
  for (auto& t : scene.welds)
    for (dReal* v : {t.feedback.f1, t.feedback.t1, t.feedback.f2, t.feedback.t2})
      if (!finite(vec(v))) t.feedback = {};
  for (auto& s : state.before) {
    if (on_the_map(s.body)) continue;
    for (auto& n : state.nodes)
      if (n->root->body == s.body)
        scene.messages.report(
            "its motion became infinite; it was stopped where it was. Look at its masses, inertias and commands",
            n->root->model->name);
    BodyState still = s;
    still.f = still.t = {};
    stop(still);
  }
}

}  // namespace ode_sim
