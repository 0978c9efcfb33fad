// The solver of Gazebo Classic's own version of ODE, as pure functions: projected Gauss-Seidel over the rows of all constraints.
//
// What tells it from ODE's quickStep: rows keep their order (joints, contact normals, friction); friction is relaxed by a quarter
// of `sor` and gets ten rounds of its own; joints start from half of what they bore before. It solves twice at once: overlap and
// gaping joints are corrected in full by the second solution, which moves the bodies; the first one, in which the speed of
// correction is limited (max_vel), gives the velocities that stay.
#pragma once
#include <vector>

#include "math.hpp"

namespace ode_sim::gazebo_like {

struct Body {
  double inverse_mass = 0;      // 1/kg; 0 = moves as it does
  Sym3 inverse_inertia;         // 1/(kg m^2), about the CoM, world axes
  Vec3 v, w;                    // of the CoM, world axes
  Vec3 force, torque;           // about the CoM, gravity and gyroscopic torque included
  Vec3 push, turn;              // result: acceleration by the constraints, m/s^2, rad/s^2
  Vec3 push_fully, turn_fully;  // result: the same with errors of position corrected in full
};

enum Kind { kBilateral = -1, kNormal = -2 };

// l1.v1 + a1.w1 + l2.v2 + a2.w2 = c, kept by a force `lambda` (N or N m) between lo and hi.
struct Row {
  int first = 0, second = -1;  // bodies; -1 = the world
  Vec3 l1, a1, l2, a2;
  double c = 0, cfm = 0, lo = -1e300, hi = 1e300;
  double fastest = 1e300;  // m/s or rad/s: how much of c stays as velocity
  int kind = kBilateral;   // or the row of the normal force that bounds this one, which is friction of coefficient hi
  double lambda = 0, lambda_fully = 0;  // where it starts from, then the result
};

struct Settings {
  double dt = 0.001, sor = 1.3;
  int iterations = 50, friction_iterations = 10;
  double friction_scale = 0.25, smoothing = 0.01, warm_start = 0.5;
};

void solve(std::vector<Row>& rows, std::vector<Body>& bodies, const Settings& settings);

Sym3 inverse(const Sym3& m);

// Rows of joints between a body at X_W1 and one at X_W2 (both: pose of the joint's frame as that body has it). p1, p2: their CoM.
struct Pair {
  int first, second;
  Pose X_W1, X_W2;
  Vec3 p1, p2;
  double erp_rate;  // 1/s: erp / dt
  double cfm, fastest;
};
void add_point(std::vector<Row>& rows, const Pair& pair);                                   // three rows: origins together
void add_turn(std::vector<Row>& rows, const Pair& pair, const Vec3& axis_W, double speed);  // about one axis
void add_alignment(std::vector<Row>& rows, const Pair& pair);                               // three rows: no rotation
void add_hinge(std::vector<Row>& rows, const Pair& pair, const Vec3& axis1_W, const Vec3& axis2_W);  // two rows
void add_slide(std::vector<Row>& rows, const Pair& pair, const Vec3& axis_W);                        // two rows across the axis
void add_thread(std::vector<Row>& rows, const Pair& pair, const Vec3& axis_W, double pitch, double off);  // three rows
Row along(const Pair& pair, const Vec3& axis_W, bool linear);            // a limit or motor of an axis
Row point_row(const Pair& pair, const Vec3& at, const Vec3& direction);  // of contacts

}  // namespace ode_sim::gazebo_like
