// What an axis of a joint gives in a step, as pure functions of its state.
#pragma once
#include "joint.hpp"

namespace ode_sim {

// A motor row as ODE has them, and a force beside it.
struct MotorRow {
  double speed = 0, most = 0;  // rad/s or m/s that the row aims at with at most so many N m or N
  double softness = 1e-10;     // (rad/s)/(N m)
  double force = 0;
};

// A controller's law as the speed that a soft motor row aims at: the row gives what the law gives at the speed that the step arrives
// at. What it gives at the speed before, held through the step, throws a light wheel to and fro. Friction is taken off first.
// A limit of speed takes a force away that would make the joint still faster, as in Gazebo, and what one step gives a light joint is
// over it: it goes as far beyond as one step at the limit pushes it. Legs that walk there walk here.
double speed_by_law(const Axis& axis, double dt, double inverse_inertia);

// Motor, friction, damping, spring and the forces of controllers. `drive`: the row of a position drive that pushes, before all else.
// always_implicit: springs and dampers too stiff for the step are rows in any case, else only where they would swing.
MotorRow axis_row(const Axis& axis, double dt, double inverse_inertia, bool like_gazebo, bool always_implicit,
                  const MotorRow* drive);

}  // namespace ode_sim
