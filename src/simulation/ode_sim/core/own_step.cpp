// Islands that solvers of our own take: trees of joints, and piles. See tree_solver.hpp, pile_solver.hpp.
#include "constraint_rows.hpp"
#include "pile_solver.hpp"
#include "tree_solver.hpp"

namespace ode_sim {

namespace {

// What the turning of a body's own axes of inertia does to its spin in the step, taken at the spin that the step arrives at: a torque
// as it is at the start feeds energy to whatever tumbles. The explicit one is in the torque already.
void turn_implicitly(gazebo_like::Body& b, double dt) {
  if (!(b.inverse_mass > 0)) return;
  const Sym3 I = gazebo_like::inverse(b.inverse_inertia);
  const Vec3 L = I * b.w, gyro = cross(b.w, L);
  if (dot(gyro, gyro) == 0) return;
  // (I + dt ([w] I - [I w])) dw = -dt w x I w, by Cramer's rule on its columns.
  auto column = [&](const Vec3& e) { return I * e + (cross(b.w, I * e) - cross(L, e)) * dt; };
  const Vec3 x = column({1, 0, 0}), y = column({0, 1, 0}), z = column({0, 0, 1}), wanted = gyro * -dt;
  const double det = dot(x, cross(y, z));
  if (det == 0) return;
  const Vec3 dw = Vec3{dot(wanted, cross(y, z)), dot(x, cross(wanted, z)), dot(x, cross(y, wanted))} * (1 / det);
  b.torque += gyro + I * dw * (1 / dt);
}

PassRows rows_of(Scene& scene, StepState& state, const Island& island) {
  Pass pass;
  pass.add(island);
  PassRows all(scene, state, pass);
  for (gazebo_like::Body& b : all.bodies) turn_implicitly(b, scene.settings.dt);
  return all;
}

}  // namespace

void run_pile(Scene& scene, StepState& state, const Island& island) {
  PassRows all = rows_of(scene, state, island);
  piles::Settings settings;
  settings.dt = scene.settings.dt, settings.sor = scene.settings.sor, settings.iterations = scene.settings.iters;
  settings.seed = order_seed(scene);
  piles::solve(all.rows, all.bodies, settings);
  all.tell();
  all.move(settings.dt);
  ++scene.counters.piles;
}

bool run_trees(Scene& scene, StepState& state, const Island& island) {
  PassRows all = rows_of(scene, state, island);
  std::vector<trees::Branch> joints;
  for (size_t i = 0; i < all.joints; ++i)
    if (!all.owners[i].joint || all.owners[i].joint->holds()) joints.push_back({all.owners[i].from, all.owners[i].to});
  trees::Settings settings;
  settings.dt = scene.settings.dt, settings.iterations = scene.settings.iters;
  if (!trees::solve(all.rows, all.bodies, joints, settings)) return false;
  all.tell();
  all.move(settings.dt);
  ++scene.counters.trees;
  return true;
}

}  // namespace ode_sim
