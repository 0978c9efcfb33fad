// `solver: gazebo`: a step as Gazebo Classic's own solver makes it.
#include "constraint_rows.hpp"

namespace ode_sim {

void run_like_gazebo(Scene& scene, StepState& state, const Pass& pass) {
  if (pass.bodies.empty()) return;
  PassRows all(scene, state, pass);
  gazebo_like::Settings settings;
  settings.dt = scene.settings.dt, settings.sor = scene.settings.sor, settings.iterations = scene.settings.iters;
  gazebo_like::solve(all.rows, all.bodies, settings);
  all.tell();
  for (const RowOwner& o : all.owners)
    for (size_t i = 0; o.joint && i < 6; ++i) {
      o.joint->borne[i] = o.from + i < o.to ? all.rows[o.from + i].lambda : 0;
      o.joint->borne[6 + i] = o.from + i < o.to ? all.rows[o.from + i].lambda_fully : 0;
    }
  all.move(settings.dt);
  ++scene.counters.quick;
}

}  // namespace ode_sim
