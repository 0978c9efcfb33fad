#include "constraint_rows.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace ode_sim {

using gazebo_like::Body;
using gazebo_like::Pair;
using gazebo_like::Row;

namespace {

// The bodies with all that acts on them but the constraints.
std::vector<Body> bodies_of(dWorldID world, const std::vector<dBodyID>& ids) {
  std::vector<Body> out;
  dVector3 g;
  dWorldGetGravity(world, g);
  for (dBodyID b : ids) {
    Body body;
    body.v = vec(dBodyGetLinearVel(b)), body.w = vec(dBodyGetAngularVel(b));
    if (!dBodyIsKinematic(b)) {
      dMass m;
      dBodyGetMass(b, &m);
      const Sym3 local{m.I[0], m.I[5], m.I[10], m.I[1], m.I[2], m.I[6]};
      const Sym3 I = rotate(quat(dBodyGetQuaternion(b)), local);
      body.inverse_mass = 1 / m.mass;
      body.inverse_inertia = gazebo_like::inverse(I);
      body.force = vec(dBodyGetForce(b)) + (dBodyGetGravityMode(b) ? vec(g) * m.mass : Vec3{});
      body.torque = vec(dBodyGetTorque(b)) - cross(body.w, I * body.w);
    }
    out.push_back(body);
  }
  return out;
}

// What a limit or motor of an axis is set to, as ODE holds it.
struct Limot {
  double most, speed, softness, lower, upper, stop_erp, stop_cfm, q;
};
Limot limot_of(const Joint& j, int axis) {
  auto read = [&](int parameter) {
    switch (j.type) {
      case JointType::Revolute: return dJointGetHingeParam(j.joint, parameter);
      case JointType::Prismatic: return dJointGetSliderParam(j.joint, parameter);
      case JointType::Screw: return dJointGetPistonParam(j.joint, parameter + dParamGroup2);
      default: return dJointGetUniversalParam(j.joint, axis ? parameter + dParamGroup2 : parameter);
    }
  };
  const double q = j.type == JointType::Revolute    ? dJointGetHingeAngle(j.joint)
                   : j.type == JointType::Prismatic ? dJointGetSliderPosition(j.joint)
                   : j.type == JointType::Screw     ? j.sign * j.axes[0].q
                   : axis                           ? dJointGetUniversalAngle2(j.joint)
                                                    : dJointGetUniversalAngle1(j.joint);
  return {read(dParamFMax),   read(dParamVel),     read(dParamCFM),     read(dParamLoStop),
          read(dParamHiStop), read(dParamStopERP), read(dParamStopCFM), q};
}

// A motor is a row, and so is a stop that is reached; a motor at a stop is a force of its greatest size, as in ODE.
void add_limot(std::vector<Row>& rows, std::vector<Body>& bodies, const Pair& pair, const Limot& a, const Vec3& axis_W,
               bool linear, double dt) {
  const int limit = a.q <= a.lower ? 1 : a.q >= a.upper ? 2 : 0;
  const bool fixed = a.lower == a.upper, powered = a.most > 0 && !(limit && fixed);
  if (!powered && !limit) return;
  Row r = gazebo_like::along(pair, axis_W, linear);
  if (powered && !limit) {
    r.c = a.speed, r.cfm = a.softness, r.lo = -a.most, r.hi = a.most;
  } else {
    if (powered) {
      const double f = a.speed > 0 || (a.speed == 0 && limit == 2) ? a.most : -a.most;
      auto act = [&](int i, const Vec3& l, const Vec3& t) {
        if (i >= 0) bodies[i].force += l * f, bodies[i].torque += t * f;
      };
      act(r.first, r.l1, r.a1), act(r.second, r.l2, r.a2);
    }
    r.c = -a.stop_erp / dt * (a.q - (limit == 1 ? a.lower : a.upper));
    r.cfm = a.stop_cfm;
    if (!fixed) (limit == 1 ? r.lo : r.hi) = 0;
  }
  rows.push_back(r);
}

constexpr double kFastestMesh = 10;  // rad/s: teeth that are out of step come back

// The child turns at -gear_ratio times the rate of the parent. Gazebo's ODE takes rates in the world, not those against the reference, and so
// holds gears back whose box turns.
Row gear_row(const Joint& j, const Pair& pair, const Settings& set) {
  const Vec3 child = rotate(j.child_frame_W().q, j.axes[0].xyz), parent = rotate(j.frame_W().q, j.axes[1].xyz) * j.gear_ratio;
  Row r;
  r.first = pair.first, r.second = pair.second, r.cfm = pair.cfm, r.fastest = pair.fastest;
  r.a1 = j.sign > 0 ? child : parent;
  if (r.second >= 0) r.a2 = j.sign > 0 ? parent : child;
  r.c = -pair.erp_rate * std::remainder(j.axes[0].q + j.gear_ratio * j.axes[1].q, 2 * kPi);
  if (set.like_gazebo) return r;
  r.c = std::min(std::max(r.c, -kFastestMesh), kFastestMesh);
  if (j.reference) r.c += dot(child + parent, j.reference->w);
  return r;
}

void add_joint_rows(std::vector<Row>& rows, std::vector<Body>& bodies, const Joint& j, const Pair& pair, const Settings& set) {
  const double dt = set.dt;
  const Vec3 a0 = j.axes[0].xyz;
  const Vec3 axis1 = rotate(pair.X_W1.q, a0), axis2 = rotate(pair.X_W2.q, a0);
  switch (j.type) {
    case JointType::Revolute:
      gazebo_like::add_point(rows, pair);
      gazebo_like::add_hinge(rows, pair, axis1, axis2);
      add_limot(rows, bodies, pair, limot_of(j, 0), axis1, false, dt);
      break;
    case JointType::Prismatic:
      gazebo_like::add_alignment(rows, pair);
      gazebo_like::add_slide(rows, pair, axis1);
      add_limot(rows, bodies, pair, limot_of(j, 0), axis1, true, dt);
      break;
    case JointType::Universal: {
      const Vec3 a1 = j.axes[1].xyz;
      const Vec3 first = rotate(pair.X_W1.q, j.sign > 0 ? a1 : a0), second = rotate(pair.X_W2.q, j.sign > 0 ? a0 : a1);
      gazebo_like::add_point(rows, pair);
      const Vec3 square = cross(first, second);
      gazebo_like::add_turn(rows, pair, square * (1 / std::max(norm(square), 1e-9)), -pair.erp_rate * dot(first, second));
      add_limot(rows, bodies, pair, limot_of(j, 0), first, false, dt);
      add_limot(rows, bodies, pair, limot_of(j, 1), second, false, dt);
      break;
    }
    case JointType::Screw:
      gazebo_like::add_thread(rows, pair, axis1, j.thread_pitch, j.sign * (j.axes[1].q + j.axes[0].q / j.thread_pitch));
      gazebo_like::add_hinge(rows, pair, axis1, axis2);
      add_limot(rows, bodies, pair, limot_of(j, 0), axis1, false, dt);
      break;
    case JointType::Gearbox: rows.push_back(gear_row(j, pair, set)); break;
    case JointType::Ball: gazebo_like::add_point(rows, pair); break;
    case JointType::Fixed:
      gazebo_like::add_point(rows, pair);
      gazebo_like::add_alignment(rows, pair);
      break;
  }
}

// Normal force, two of friction along fixed tangents (a pyramid), and a moment of friction about the normal.
void add_contact_rows(std::vector<Row>& rows, const std::vector<Body>& bodies, const Pair& pair, const dContact& d,
                      double spin_slip, const Settings& set) {
  const double dt = set.dt;
  const Vec3 at = vec(d.geom.pos), n = vec(d.geom.normal);
  Row r = gazebo_like::point_row(pair, at, n);
  r.cfm = d.surface.soft_cfm;
  r.c = d.surface.soft_erp / dt * d.geom.depth + d.surface.motionN;
  const Body& b1 = bodies[r.first];
  double leaving = dot(r.l1, b1.v) + dot(r.a1, b1.w) - d.surface.motionN;
  if (r.second >= 0) leaving += dot(r.l2, bodies[r.second].v) + dot(r.a2, bodies[r.second].w);
  if (-leaving > d.surface.bounce_vel) r.c = std::max(r.c, -d.surface.bounce * leaving + d.surface.motionN);
  r.lo = 0, r.kind = gazebo_like::kNormal;
  const int normal = static_cast<int>(rows.size());
  rows.push_back(r);
  const Vec3 t1 = vec(d.fdir1), t2 = cross(n, t1);
  auto friction = [&](Row f, double mu, double slip, double motion) {
    if (mu <= 0) return;
    f.c = motion, f.cfm = slip, f.hi = mu, f.fastest = set.contact_max_vel;  // overlap alone is undone slowly
    if (d.surface.mode & dContactApprox1) f.kind = normal;
    else f.lo = -mu;  // a force that is known
    rows.push_back(f);
  };
  friction(gazebo_like::point_row(pair, at, t1), d.surface.mu, d.surface.slip1, d.surface.motion1);
  friction(gazebo_like::point_row(pair, at, t2), d.surface.mu2, d.surface.slip2, d.surface.motion2);
  if (d.surface.mode & dContactRolling) friction(gazebo_like::along(pair, n, false), d.surface.rhoN, spin_slip, 0);
}

// A step of the body: the place by what the full correction makes of its velocity, which does not stay.
void move(dBodyID id, const Body& b, double dt) {
  if (dBodyIsKinematic(id)) {
    set_body_pose(
        id, {vec(dBodyGetPosition(id)) + b.v * dt,
             normalized(axis_angle(b.w * (1 / std::max(norm(b.w), 1e-300)), norm(b.w) * dt) * quat(dBodyGetQuaternion(id)))});
    return;
  }
  const Vec3 v = b.v + b.force * (b.inverse_mass * dt), w = b.w + b.inverse_inertia * (b.torque * dt);
  const Vec3 v_move = v + b.push_fully * dt, w_move = w + b.turn_fully * dt;
  const double turn = norm(w_move);
  const Quat q = quat(dBodyGetQuaternion(id));
  set_body_pose(
      id, {vec(dBodyGetPosition(id)) + v_move * dt, turn > 0 ? normalized(axis_angle(w_move * (1 / turn), turn * dt) * q) : q});
  auto damped = [](const Vec3& x, double scale) { return dot(x, x) > 1e-4 ? x * (1 - scale) : x; };
  set_body_twist(id, damped(v + b.push * dt, dBodyGetLinearDamping(id)), damped(w + b.turn * dt, dBodyGetAngularDamping(id)));
  dBodySetForce(id, 0, 0, 0);
  dBodySetTorque(id, 0, 0, 0);
}

void tell(dJointFeedback& f, const std::vector<Row>& rows, size_t from, size_t to) {
  Vec3 sums[4];
  for (size_t i = from; i < to; ++i) {
    const Row& r = rows[i];
    sums[0] += r.l1 * r.lambda, sums[1] += r.a1 * r.lambda, sums[2] += r.l2 * r.lambda, sums[3] += r.a2 * r.lambda;
  }
  dReal* to_ode[4] = {f.f1, f.t1, f.f2, f.t2};
  for (int k = 0; k < 4; ++k) to_ode[k][0] = sums[k].x, to_ode[k][1] = sums[k].y, to_ode[k][2] = sums[k].z;
}

using Numbers = std::unordered_map<dBodyID, int>;

// The rows of all joints, welds and contacts between some bodies, and who is to be told what they bear.
class Rows {
 public:
  Rows(Scene& scene, StepState& state, const Numbers& number, std::vector<Body>& bodies)
      : scene_(scene), set_(scene.settings), state_(state), number_(number), bodies_(bodies) {
    const RowOrder all = order();
    for (Joint* j : all.joints) add_joint(*j);
    add_welds();
    joints = owners.size();
    for (const Contact* c : all.contacts) add_contact(*c);
  }
  std::vector<Row> rows;
  std::vector<RowOwner> owners;
  size_t joints = 0;

 private:
  Scene& scene_;
  const Settings& set_;
  StepState& state_;
  const Numbers& number_;
  std::vector<Body>& bodies_;
  Pair pair_{};

  // The bodies of an ODE joint, when they take part. X_1J, X_2J: its frame in each.
  bool take(dJointID joint, const Pose& X_1J, const Pose& X_2J, double fastest) {
    const dBodyID first = dJointGetBody(joint, 0), second = dJointGetBody(joint, 1);
    const auto a = number_.find(first), b = number_.find(second);
    if (a == number_.end() || (second && b == number_.end())) return false;
    auto place = [](dBodyID body) { return body ? body_pose(body) : Pose{}; };
    pair_ = {a->second,
             second ? b->second : -1,
             place(first) * X_1J,
             place(second) * X_2J,
             vec(dBodyGetPosition(first)),
             place(second).p,
             set_.erp / set_.dt,
             set_.like_gazebo ? set_.cfm : 0,
             fastest};
    return true;
  }

  // As they were made, or as Gazebo has them.
  RowOrder order() const {
    if (set_.like_gazebo) return gazebo_order(scene_, state_);
    RowOrder all;
    for (auto& m : scene_.models)
      for (auto& j : m->joints)
        if (j->joint) all.joints.push_back(j.get());
    for (auto& c : state_.contacts) all.contacts.push_back(&c);
    return all;
  }

  void add_joint(Joint& j) {
    const Pose X_C = X_BL(*j.child) * j.X_CJ, X_P = j.parent ? X_BL(*j.parent) * j.X_PJ : j.X_PJ;
    if (!take(j.joint, j.sign > 0 ? X_C : X_P, j.sign > 0 ? X_P : X_C, set_.contact_max_vel)) return;
    const size_t from = rows.size();
    add_joint_rows(rows, bodies_, j, pair_, set_);
    for (size_t i = from; i < rows.size(); ++i)
      rows[i].lambda = j.borne[i - from], rows[i].lambda_fully = j.borne[6 + i - from];
    owners.push_back({j.watched ? &j.ode_feedback : nullptr, &j, from, rows.size()});
  }

  void add_welds() {
    for (auto& t : scene_.welds) {
      const dJointID joint = state_.weld_joint(scene_, t);
      if (!joint) continue;
      const bool child = body_of(t.child.get()) != nullptr;
      const Pose X_C = X_BL(*t.child), X_P = (t.parent ? X_BL(*t.parent) : Pose{}) * t.X_PC;
      if (!take(joint, child ? X_C : X_P, child ? X_P : X_C, set_.contact_max_vel)) continue;
      const size_t from = rows.size();
      gazebo_like::add_point(rows, pair_);
      gazebo_like::add_alignment(rows, pair_);
      owners.push_back({&t.feedback, nullptr, from, rows.size()});
    }
  }

  void add_contact(const Contact& c) {
    if (!c.joint || !take(c.joint, {}, {}, c.fastest)) return;
    const size_t from = rows.size();
    add_contact_rows(rows, bodies_, pair_, state_.ode_contacts[c.row], c.spin_slip, set_);
    owners.push_back({c.feedback >= 0 ? &state_.feedback[c.feedback] : nullptr, nullptr, from, rows.size()});
  }
};

}  // namespace

PassRows::PassRows(Scene& scene, StepState& state, const Pass& pass) {
  Numbers number;
  for (dBodyID b : pass.bodies)
    if (number.emplace(b, static_cast<int>(ids.size())).second) ids.push_back(b);
  bodies = bodies_of(scene.ode, ids);
  Rows all(scene, state, number, bodies);
  rows.swap(all.rows);
  owners.swap(all.owners);
  joints = all.joints;
}

void PassRows::tell() const {
  for (const RowOwner& o : owners)
    if (o.feedback) ode_sim::tell(*o.feedback, rows, o.from, o.to);
}

void PassRows::move(double dt) const {
  for (size_t i = 0; i < ids.size(); ++i) ode_sim::move(ids[i], bodies[i], dt);
}

}  // namespace ode_sim
