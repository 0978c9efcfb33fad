// Joints as ODE has them: made, set, read.
#include <algorithm>
#include <cmath>

#include "phases.hpp"

namespace ode_sim {

Pose Joint::motion(double q) const {
  switch (type) {
    case JointType::Revolute: return {{}, axis_angle(axes[0].xyz, q)};
    case JointType::Prismatic: return {axes[0].xyz * q, {}};
    case JointType::Screw: return {axes[0].xyz * (q * slides()), axis_angle(axes[0].xyz, q)};
    default: return {};
  }
}

Pose Joint::motion() const {
  if (type != JointType::Universal) return motion(axes[0].q);
  return {{}, axis_angle(axes[0].xyz, axes[0].q) * axis_angle(axes[1].xyz, axes[1].q)};
}

Pose Joint::frame_W() const { return parent ? parent->X_WL * X_PJ : X_PJ; }

Pose Joint::child_frame_W() const { return child->X_WL * X_CJ; }

Quat Joint::reference_W() const { return reference ? reference->X_WL.q * q_RJ : q_RJ; }

void add_force(Axis& a, double force) {
  a.force += a.admitted(limited(force, kStrongest, "a force"));
  a.commanded = true;
}

void add_law(Axis& a, double force, double slope, double bound) {
  a.law = limited(force, kStrongest, "a force");
  a.slope = limited(slope, kStrongest, "a controller's slope");
  a.law_bound = std::max(limited(bound, kInf, "the bound of a force"), 0.0);
  a.force += a.lawful();
  a.commanded = true;
}

void set_motor(Axis& a, double velocity, double most_force) {
  const double v = limited(velocity, kFastestSet, "a motor's velocity"), f = limited(most_force, kInf, "a motor's force");
  a.motor_velocity = v;
  a.motor_force = f;
}

void set_thread_pitch(Joint& j, double pitch) {
  pitch = limited(pitch, kFarthest, "thread_pitch");
  if (std::abs(pitch) < 1 / kFarthest) throw std::invalid_argument("thread_pitch must not be 0");
  const double before = j.slides();
  j.thread_pitch = pitch;
  if (j.type == JointType::Screw) {
    j.X_PJ.p += rotate(j.X_PJ.q, j.axes[0].xyz * (j.axes[0].q * (before - j.slides())));
    j.axes[1].q = j.axes[0].q * j.slides();
  }
  j.model->dirty = true;
}

void set_gear_ratio(Joint& j, double ratio) {
  j.gear_ratio = limited(ratio, kFarthest, "gearbox_ratio");
  j.model->dirty = true;
}

void set_limot(const Joint& j, int axis, int parameter, double value) {
  switch (j.type) {
    case JointType::Revolute: dJointSetHingeParam(j.joint, parameter, value); break;
    case JointType::Prismatic: dJointSetSliderParam(j.joint, parameter, value); break;
    case JointType::Universal:
      // ODE's first axis is that of its first body: the child's, unless only the parent has a body.
      if ((axis == 0) == (j.sign > 0)) parameter += dParamGroup2;
      dJointSetUniversalParam(j.joint, parameter, value);
      break;
    case JointType::Screw: dJointSetPistonParam(j.joint, parameter + dParamGroup2, value); break;
    default: break;
  }
}

namespace {

// ODE has no screws and no gearboxes: what it lacks of them is in constraint_rows.cpp alone, which find_islands knows.
dJointID make_joint(dWorldID world, JointType type) {
  switch (type) {
    case JointType::Revolute: return dJointCreateHinge(world, nullptr);
    case JointType::Prismatic: return dJointCreateSlider(world, nullptr);
    case JointType::Universal: return dJointCreateUniversal(world, nullptr);
    case JointType::Ball: return dJointCreateBall(world, nullptr);
    case JointType::Screw: return dJointCreatePiston(world, nullptr);
    case JointType::Gearbox: return dJointCreateNull(world, nullptr);
    case JointType::Fixed: break;
  }
  return dJointCreateFixed(world, nullptr);
}

// Anchor and axes from where the bodies are now, with the joint's frame at X_WJ.
void set_geometry(const Joint& j, const Pose& X_WJ) {
  const Vec3 at = X_WJ.p, a0 = rotate(X_WJ.q, j.axes[0].xyz), a1 = rotate(X_WJ.q, j.axes[1].xyz);
  switch (j.type) {
    case JointType::Revolute:
      dJointSetHingeAnchor(j.joint, at.x, at.y, at.z);
      dJointSetHingeAxis(j.joint, a0.x, a0.y, a0.z);
      break;
    case JointType::Prismatic: dJointSetSliderAxis(j.joint, a0.x, a0.y, a0.z); break;
    case JointType::Universal: {
      const Vec3 f = j.sign > 0 ? a1 : a0, s = j.sign > 0 ? a0 : a1;
      dJointSetUniversalAnchor(j.joint, at.x, at.y, at.z);
      dJointSetUniversalAxis1(j.joint, f.x, f.y, f.z);
      dJointSetUniversalAxis2(j.joint, s.x, s.y, s.z);
      break;
    }
    case JointType::Ball: dJointSetBallAnchor(j.joint, at.x, at.y, at.z); break;
    case JointType::Fixed: dJointSetFixed(j.joint); break;
    case JointType::Screw:
      dJointSetPistonAnchor(j.joint, at.x, at.y, at.z);
      dJointSetPistonAxis(j.joint, a0.x, a0.y, a0.z);
      break;
    case JointType::Gearbox: break;
  }
}

// 1/kg or 1/(kg m^2): how much the two bodies, taken alone, give way along an axis, or about it.
double mobility(const Joint& j, const Vec3& axis, bool along) {
  double sum = 0;
  for (Link* l : {j.child, j.parent}) {
    if (!l || l->carrier) continue;
    const Cluster& c = cluster_of(*l);
    if (!c.root || c.root->kinematic) continue;
    if (along) {
      sum += 1 / c.mass;
    } else {
      const Quat q = l == j.child ? l->X_RL.q * j.X_CJ.q : l->X_RL.q * j.X_PJ.q;
      sum += inverse_along(c.inertia, rotate(q, axis));
    }
  }
  return sum;
}

double axis_inverse_inertia(const Joint& j, int axis) {
  const Vec3& xyz = j.axes[axis].xyz;
  if (j.type != JointType::Screw) return mobility(j, xyz, j.type == JointType::Prismatic);
  const double turn = mobility(j, xyz, false), slide = mobility(j, xyz, true) * j.thread_pitch * j.thread_pitch;
  return turn > 0 && slide > 0 ? 1 / (1 / turn + 1 / slide) : 0;
}

}  // namespace

// Makes the ODE joint. Its anchor and zero are taken with the bodies put, for a moment, exactly as the joint at zero has
// them; then they go back to where they are, so that the joint feels every deviation.
void install(Scene& scene, Joint& j) {
  dBodyID child = body_of(j.child), parent = body_of(j.parent);
  if (child == parent || (!child && !parent)) return;
  j.sign = child ? 1 : -1;
  dBodyID first = child ? child : parent, second = child ? parent : nullptr;
  const Pose X_CB_J = X_BL(*j.child) * j.X_CJ;  // joint frame in the child's body, or in the world
  const Pose X_PB_J = j.parent ? X_BL(*j.parent) * j.X_PJ : j.X_PJ;
  const Pose X_1J = child ? X_CB_J : X_PB_J, X_2J = child ? X_PB_J : X_CB_J;
  if (!j.joint) {
    j.joint.reset(make_joint(scene.ode, j.type));
    dJointAttach(j.joint, first, second);
    if (j.watched) {
      j.ode_feedback = kUnsolved;
      dJointSetFeedback(j.joint, &j.ode_feedback);
    }
  }
  const Posed posed(first, second, X_1J, X_2J);
  set_geometry(j, X_2J);
  for (int i = 0; i < j.driven_axes(); ++i) {
    j.inverse_inertia[i] = axis_inverse_inertia(j, i);
    set_limot(j, i, dParamStopERP, j.stop_erp);
    set_limot(j, i, dParamStopCFM, std::max(j.stop_cfm, 1e-10));
    set_limot(j, i, dParamBounce, 0);
  }
}

namespace {

// The angle next to the one before, of all that differ by whole turns.
void turn(Axis& a, double angle) { a.q = angle + 2 * kPi * std::round((a.q - angle) / (2 * kPi)); }

// About the axis, of a rotation.
double angle_about(const Vec3& axis, const Quat& q) { return 2 * std::atan2(dot({q.x, q.y, q.z}, axis), q.w); }

}  // namespace

void read_joint(Joint& j) {
  const Pose X_WJ = j.frame_W();
  const Pose X_J = inverse(X_WJ) * j.child->X_WL * j.X_CJ;
  const Vec3 vp = j.parent ? j.parent->velocity_at(j.child_frame_W().p) : Vec3{}, wp = j.parent ? j.parent->w : Vec3{};
  const Vec3 w = j.child->w - wp;
  switch (j.type) {
    case JointType::Revolute: {
      Axis& a = j.axes[0];
      a.qd = dot(w, rotate(X_WJ.q, a.xyz));
      turn(a, angle_about(a.xyz, X_J.q));
      break;
    }
    case JointType::Prismatic: {
      Axis& a = j.axes[0];
      a.q = dot(X_J.p, a.xyz);
      a.qd = dot(j.child->velocity_at(j.child_frame_W().p) - vp, rotate(X_WJ.q, a.xyz));
      break;
    }
    case JointType::Universal: {
      const Vec3 x = j.axes[0].xyz, y = j.axes[1].xyz, z = cross(x, y);
      const Vec3 cx = rotate(X_J.q, x), cy = rotate(X_J.q, y), cz = rotate(X_J.q, z);
      const Vec3 a0 = rotate(X_WJ.q, x), a1 = rotate(j.child_frame_W().q, y);
      j.axes[0].qd = dot(w, a0);
      j.axes[1].qd = dot(w, a1);
      turn(j.axes[0], std::atan2(dot(z, cy), dot(y, cy)));
      turn(j.axes[1], std::atan2(dot(x, cz), dot(x, cx)));
      break;
    }
    case JointType::Screw: {
      Axis &a = j.axes[0], &way = j.axes[1];
      const Vec3 axis_W = rotate(X_WJ.q, a.xyz);
      way.q = dot(X_J.p, a.xyz);
      way.qd = dot(j.child->velocity_at(j.child_frame_W().p) - vp, axis_W);
      a.q = way.q / j.slides();  // the turn of the thread that it is on, wherever somebody has put it
      a.qd = dot(w, axis_W);
      turn(a, angle_about(a.xyz, X_J.q));
      break;
    }
    case JointType::Gearbox: {
      const Quat q_W = j.reference_W(), seen = conjugate(q_W);
      const Vec3 spin = j.reference ? j.reference->w : Vec3{};
      Axis &a = j.axes[0], &b = j.axes[1];
      a.qd = dot(j.child->w - spin, rotate(j.child_frame_W().q, a.xyz));
      b.qd = dot(wp - spin, rotate(X_WJ.q, b.xyz));
      turn(a, angle_about(a.xyz, seen * j.child_frame_W().q));
      turn(b, angle_about(b.xyz, seen * X_WJ.q));
      break;
    }
    default: break;
  }
}

void read_feedback(Joint& j, JointStep& step) {
  if (!j.watched || !j.joint) return;
  const dJointFeedback f = j.ode_feedback;
  j.ode_feedback = kUnsolved;
  const bool child_first = j.sign > 0;
  const Vec3 at = j.frame_W().p;
  const dBodyID first = dJointGetBody(j.joint, 0);
  const Vec3 force = vec(f.f1) + step.carried_force;
  const Vec3 torque = vec(f.t1) + step.carried_torque - cross(at - vec(dBodyGetPosition(first)), force);
  if (!finite(force) || !finite(torque)) return;  // at rest, or the solver lost its way: that of the step before
  j.feedback.child_force = child_first ? force : -force;
  j.feedback.child_torque = child_first ? torque : -torque;
  j.feedback.parent_force = -j.feedback.child_force;
  j.feedback.parent_torque = -j.feedback.child_torque;
}

// ------------------------------------------------------------------------------------------------ welds

// Links that are welded do not collide, nor does what is rigidly joined to them.
bool welded(const Scene& scene, const Link& a, const Link& b) {
  const auto same = [](const std::shared_ptr<Link>& l, const Link& m) {
    return l && l->model == m.model && l->cluster == m.cluster;
  };
  for (auto& t : scene.welds)
    if ((same(t.parent, a) && same(t.child, b)) || (same(t.parent, b) && same(t.child, a))) return true;
  return false;
}

// Made anew for each step: which bodies carry the links changes when position drives lock and unlock.
void make_weld_joints(Scene& scene, StepState& state) {
  state.weld_joints.assign(scene.welds.size(), nullptr);
  for (size_t i = 0; i < scene.welds.size(); ++i) {
    Weld& t = scene.welds[i];
    const dBodyID child = body_of(t.child.get()), parent = body_of(t.parent.get());
    if (child == parent || (!child && !parent)) continue;
    const dJointID joint = dJointCreateFixed(scene.ode, scene.step_joints);
    dJointSetFeedback(joint, &t.feedback);
    dJointAttach(joint, child ? child : parent, child ? parent : nullptr);
    const Pose X_CB = X_BL(*t.child), X_PB = (t.parent ? X_BL(*t.parent) : Pose{}) * t.X_PC;
    const Posed posed(child ? child : parent, child ? parent : nullptr, child ? X_CB : X_PB, child ? X_PB : X_CB);
    dJointSetFixed(joint);
    state.weld_joints[i] = joint;
  }
}

}  // namespace ode_sim
