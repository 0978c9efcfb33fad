// What acts on the links and joints of a step: motors, springs, friction, limits, forces, gravity.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "forces.hpp"
#include "phases.hpp"

namespace ode_sim {

namespace {

constexpr double kStopSkin = 1e-12;               // a joint put exactly on its stop is to be found there despite rounding
constexpr double kNearStop = 1e-9;                // within the reach of the skin
constexpr double kBackTurn = 10, kBackSlide = 1;  // rad/s, m/s: from beyond a stop
constexpr double kStiffLaw = 1;   // share of a speed error that a controller makes good in one step; more swings
constexpr double kSwings = 0.05;  // the same of a law of the position alone, where nothing else damps the joint
// Square of the angle (rad) that a free spring swings in one step: softer ones act as they are at its beginning, which keeps their energy.
// At the step's end, as harder ones do, each swing of theirs loses some; from 4 on the others would grow.
constexpr double kStiffSpring = 0.25;

void apply_axis_force(const Joint& j, int axis, double f) {
  if (f == 0) return;
  const dBodyID child = body_of(j.child), parent = body_of(j.parent);
  const Pose X_WJ = axis == 0 ? j.frame_W() : j.child_frame_W();
  const Vec3 v = rotate(X_WJ.q, j.axes[axis].xyz) * f;
  if (j.type == JointType::Prismatic || (j.type == JointType::Screw && axis == 1)) {
    const Vec3 p = j.child_frame_W().p;
    if (child) dBodyAddForceAtPos(child, v.x, v.y, v.z, p.x, p.y, p.z);
    if (parent) dBodyAddForceAtPos(parent, -v.x, -v.y, -v.z, p.x, p.y, p.z);
  } else {
    if (child) dBodyAddTorque(child, v.x, v.y, v.z);
    if (parent) dBodyAddTorque(parent, -v.x, -v.y, -v.z);
  }
}

// ODE knows angles within a turn: its stops move along with the turns.
void set_stops(const Settings& set, const Joint& j, int i) {
  const Axis& a = j.axes[i];
  double lower = a.lower, upper = a.upper;
  if (!set.like_gazebo) {  // a joint that begins far beyond a stop, as many do at zero, comes back without throwing the robot
    const double near = (j.type == JointType::Prismatic ? kBackSlide : kBackTurn) * set.dt / std::max(j.stop_erp, 1e-3);
    lower = std::min(lower, a.q + near);
    upper = std::max(upper, a.q - near);
  }
  if (j.type == JointType::Revolute && std::abs(a.q) > 3) {
    const double turns = 2 * kPi * std::round((a.q - j.sign * dJointGetHingeAngle(j.joint)) / (2 * kPi));
    lower -= turns;
    upper -= turns;
  }
  if (upper - lower > 1e-9) {  // with both stops at one place ODE holds the joint there by itself
    lower += kStopSkin;
    upper -= kStopSkin;
  }
  if (j.sign < 0) std::tie(lower, upper) = std::make_pair(-upper, -lower);
  // ODE's hinge looks at no stop while both are out of its reach, and takes itself to be where it was when it last looked. Its
  // angle is always less than pi: it looks at this stop and never meets it.
  if (j.type == JointType::Revolute && lower < -kPi && upper > kPi && (std::isfinite(lower) || std::isfinite(upper)))
    upper = kPi;
  set_limot(j, i, dParamLoStop, std::isfinite(lower) ? lower : -dInfinity);
  set_limot(j, i, dParamHiStop, std::isfinite(upper) ? upper : dInfinity);
  set_limot(j, i, dParamLoStop, std::isfinite(lower) ? lower : -dInfinity);  // ODE refuses a low stop above the old high one
}

// The row of a position drive that pushes.
MotorRow drive_row(const Scene& scene, Joint& j) {
  const Axis& a = j.axes[0];
  const double fastest = a.velocity > 0 && a.velocity < kUnlimited ? a.velocity : 100.0;
  return {std::min(std::max((j.target - a.q) / scene.settings.dt, -fastest), fastest), motor_load(scene, j)};
}

}  // namespace

double speed_by_law(const Axis& a, double dt, double inverse_inertia) {
  const double slope = a.steepness();
  double speed = a.undamped() ? a.law / slope : a.qd + a.law / slope;
  if (a.velocity > 0) {
    const double over = (std::abs(speed) - a.velocity) * slope;  // the law's force at the limit
    const double push = std::min(std::max(over, 0.0), a.effort >= 0 ? std::min(a.law_bound, a.effort) : a.law_bound);
    const double most = a.velocity + dt * inverse_inertia * push;
    speed = std::min(std::max(speed, -most), most);
  }
  return std::copysign(std::max(std::abs(speed) - a.friction / slope, 0.0), speed);
}

MotorRow axis_row(const Axis& a, double dt, double inverse_inertia, bool like_gazebo, bool always_implicit,
                  const MotorRow* drive) {
  double damping = a.damping;
  const double stiffness = a.spring_stiffness;
  const double pull = stiffness > 0 ? -stiffness * (a.q - a.spring_reference) : 0;
  const bool spring_in_row = always_implicit || (dt * dt * stiffness * inverse_inertia > kStiffSpring && !like_gazebo);
  const double in_row = damping + (spring_in_row ? dt * stiffness : 0), stiff = dt * in_row * inverse_inertia;
  // At a stop ODE turns motors into torques of their greatest size.
  const bool off_stops = a.q - a.lower > kNearStop && a.upper - a.q > kNearStop;
  const bool stiff_law = dt * a.steepness() * inverse_inertia > (a.undamped() ? kSwings : kStiffLaw);
  const bool by_law =
      !like_gazebo && off_stops && !drive && a.motor_force <= 0 && stiff_law && (a.law == 0 || a.admitted(a.law) != 0);
  const double bound = a.effort >= 0 ? std::min(a.law_bound, a.effort) : a.law_bound;
  const double at_rest = std::min(std::max(a.law_at_rest(), -bound), bound);  // what the law gives when the step ends at rest
  MotorRow row;
  bool by_row = false;  // springs and dampers are in it
  row.force = a.force;
  if (drive) {
    row.speed = drive->speed;
    row.most = drive->most;
  } else if (a.motor_force > 0) {
    row.speed = a.motor_velocity;
    row.most = a.motor_force;
  } else if (by_law && std::abs(at_rest) <= a.friction) {
    // Dry friction holds it, against what else pulls as well: a row as soft as the law would let it creep. Where it is pulled along
    // all the same, the law is held through the step, and so damps no more than one step can bear.
    row.most = a.friction;
    row.force += at_rest - a.qd * std::min(a.steepness(), 1 / (dt * inverse_inertia)) - a.lawful();
  } else if (by_law) {
    row.speed = speed_by_law(a, dt, inverse_inertia);
    row.softness = 1 / a.steepness();
    row.most = bound;
    row.force -= a.lawful();
  } else if (a.friction > 0) {
    row.most = a.friction;
  } else if (in_row > 0 && (always_implicit || (stiff > 0.05 && !like_gazebo)) && off_stops) {
    // Implicit: a motor row whose softness is the damper, and whose speed is that at which the spring balances it.
    if (spring_in_row) row.speed = pull / in_row;
    else row.force += pull;
    row.softness = 1 / in_row;
    row.most = dInfinity;
    by_row = true;
  }
  if (!by_row) {
    if (stiff > 0.05 && !like_gazebo) damping /= 1 + stiff;
    row.force += pull - damping * a.qd;
  }
  return row;
}

namespace {

void update_axis(const Scene& scene, StepState& state, Joint& j, int i) {
  const Settings& set = scene.settings;
  const bool pushes = i == 0 && j.drive == DriveMode::Motor;
  const MotorRow drive = pushes ? drive_row(scene, j) : MotorRow{};
  const MotorRow row =
      axis_row(j.axes[i], set.dt, j.inverse_inertia[i], set.like_gazebo, j.implicit_spring_damper, pushes ? &drive : nullptr);
  set_limot(j, i, dParamFMax, row.most);
  double& speed = state.of(j).speed[i];
  speed = row.speed * j.sign;
  set_limot(j, i, dParamVel, speed);
  set_limot(j, i, dParamCFM, row.softness);
  set_stops(set, j, i);
  apply_axis_force(j, i, row.force);
}

void apply_link_forces(Model& m) {
  for (auto& l : m.links) {
    l->applied_force = l->force;
    l->applied_torque = l->torque;
    if (l->cluster < 0) continue;
    Cluster& c = m.clusters[l->cluster];
    if (!c.root) continue;
    dBodyID body = c.root->body;
    if (l->force.x != 0 || l->force.y != 0 || l->force.z != 0) {
      const Vec3 p = l->com_W();
      dBodyAddForceAtPos(body, l->force.x, l->force.y, l->force.z, p.x, p.y, p.z);
    }
    dBodyAddTorque(body, l->torque.x, l->torque.y, l->torque.z);
  }
}

// Where some members of a cluster have no weight, ODE's gravity is off for all of it.
void apply_uneven_gravity(Model& m, const Vec3& gravity) {
  for (auto& c : m.clusters)
    if (c.root && !c.uniform_gravity && c.gravity_mass > 0) {
      const Vec3 p = c.root->X_WL * c.gravity_com, f = gravity * c.gravity_mass;
      dBodyAddForceAtPos(c.root->body, f.x, f.y, f.z, p.x, p.y, p.z);
    }
}

}  // namespace

void apply_forces(Scene& scene, StepState& state) {
  const Settings& set = scene.settings;
  dWorldSetGravity(scene.ode, set.gravity.x, set.gravity.y, set.gravity.z);
  dWorldSetERP(scene.ode, set.erp);
  // Links are put back into their joints after each step, see projection.cpp. By a joint that gives way to its load, as a file's
  // cfm has it, they would be carried along: a rover whose wheels stand glides over the floor.
  dWorldSetCFM(scene.ode, std::max(set.like_gazebo ? set.cfm : 0.0, 1e-10));
  for (auto& m : scene.models) {
    apply_link_forces(*m);
    apply_uneven_gravity(*m, set.gravity);
    for (auto& j : m->joints)
      if (j->joint) {
        for (int i = 0; i < j->driven_axes(); ++i) update_axis(scene, state, *j, i);
        if (j->type == JointType::Screw) apply_axis_force(*j, 1, j->axes[1].force);
      }
    if (!set.like_gazebo || m->has_drives) apply_inertial_forces(scene, state, *m);
  }
}

}  // namespace ode_sim
