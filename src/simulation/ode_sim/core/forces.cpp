// Servo joints, and what acts on the joints of a step.
#include "ode_access.hpp"

#include <algorithm>
#include <cmath>

namespace ode_sim {

namespace {

constexpr double kStopSkin = 1e-12;  // a joint put exactly on its stop is to be found there despite rounding
constexpr double kNearStop = 1e-9;   // within the reach of the skin
constexpr double kBackTurn = 10, kBackSlide = 1;  // rad/s, m/s: from beyond a stop
constexpr double kStiffLaw = 1;      // share of a speed error that a controller makes good in one step; more swings
constexpr double kJump = 30;  // m/s, rad/s: a servo joint commanded to move faster than this is teleported

}  // namespace

// ------------------------------------------------------------------------------------------------ servo joints

void World::set_rates(Model& model) {
  for (auto& j : model.joints) {
    if (j->servo == ServoMode::Off) continue;
    Axis& a = j->axes[0];
    if (const auto leader = j->leader.lock()) {
      const Joint& l = *leader;
      const double q = l.servo == ServoMode::Locked ? l.target : l.axes[0].q + l.axes[0].qd * dt;
      const double wanted = std::min(std::max(j->multiplier * q + j->offset, a.lower), a.upper);
      j->target = std::min(std::max(wanted, -kFarthest), kFarthest);  // joints that follow each other would grow without bound
    }
    double rate = (j->target - a.q) / dt;
    if (j->servo == ServoMode::Locked) {
      if (j->catching_up) {
        const double most = a.velocity > 0 && a.velocity < kUnlimited ? a.velocity : 1.0;
        if (std::abs(rate) <= most) j->catching_up = false;
        rate = std::min(std::max(rate, -most), most);
      }
      j->rate = rate;
    } else {
      feed_forward(*j);
    }
  }
  model.jump = false;
  for (auto& j : model.joints)
    if (j->servo == ServoMode::Locked) model.jump |= std::max(std::abs(j->rate), std::abs(j->previous_rate)) > kJump;
  for (auto& c : model.clusters)
    if (c.moving) {
      spread_twists(c);
      for (Link* l : c.members)
        if (l->carrier) set_body_twist(l->body, l->v, l->w);
    }
}

// A joint in Motor mode whose command changes speed takes what is beyond along without a reaction on what carries it, as
// a locked one does - unless something holds it back.
void World::feed_forward(Joint& j) {
  Axis& a = j.axes[0];
  const double most = a.velocity > 0 && a.velocity < kUnlimited ? a.velocity : 100.0;
  const double wanted = std::min(std::max((j.target - j.previous_target) / dt, -most), most);
  const double change = wanted - j.rate;
  const bool free = std::abs(a.qd - j.rate) < 0.05 * std::abs(j.rate) + 1e-3;
  j.rate = wanted;
  if (!free || std::abs(change) < 1e-12) return;
  const Pose X_WJ = j.frame_W();
  const Vec3 delta = rotate(X_WJ.q, a.xyz) * change;
  std::set<dBodyID> done;
  for (Link* l : subtree(j)) {
    if (l->cluster < 0 || l->carrier) continue;
    const Cluster& c = j.model->clusters[l->cluster];
    if (!c.root || !done.insert(c.root->body).second) continue;
    dBodyID b = c.root->body;
    Vec3 v = vec(dBodyGetLinearVel(b)), w = vec(dBodyGetAngularVel(b));
    if (j.type == JointType::Revolute) {
      w += delta;
      v += cross(delta, vec(dBodyGetPosition(b)) - X_WJ.p);
    } else {
      v += delta;
    }
    set_body_twist(b, v, w);
  }
}

bool World::promote_path(Link* link) {
  bool any = false;
  for (; link; link = link->up_link)
    if (link->up && link->up->servo == ServoMode::Locked && link->up->sane) {
      link->up->servo = ServoMode::Motor;
      link->up->released = 0;
      link->model->dirty = true;
      ++counters.promotions;
      any = true;
    }
  return any;
}

// Where a moving link of a cluster touches something else, the servo joints above it become motors.
bool World::promote() {
  bool any = false;
  for (auto& m : models_)
    if (m->has_servo) {
      std::set<std::pair<int, int>> touching;
      for (auto& c : contacts_) {
        Link *la = c.a->link, *lb = c.b->link;
        if (la->model != m.get() && lb->model != m.get()) continue;
        const std::pair<int, int> pair{c.a->id, c.b->id};
        touching.insert(pair);
        if (m->take_exempt || m->exempt.count(pair)) continue;
        if (c.a->surface.collide_without_contact || c.b->surface.collide_without_contact) continue;
        if (la->model == m.get() && la->moving) any |= promote_path(la);
        if (lb->model == m.get() && lb->moving) any |= promote_path(lb);
      }
      if (m->take_exempt) {
        m->exempt = touching;
        m->take_exempt = false;
      } else {
        for (auto it = m->exempt.begin(); it != m->exempt.end();)
          it = touching.count(*it) ? std::next(it) : m->exempt.erase(it);
      }
      // Contacts keep the motors above them going.
      for (auto& j : m->joints)
        if (j->servo == ServoMode::Motor) ++j->released;
      for (auto& c : contacts_)
        for (Link* l : {c.a->link, c.b->link}) {
          if (l->model != m.get() || m->exempt.count({c.a->id, c.b->id})) continue;
          for (Joint* j = l->parent_joint; j; j = j->parent ? j->parent->parent_joint : nullptr) j->released = 0;
        }
    }
  return any;
}

void World::demote() {
  for (auto& m : models_)
    for (auto& j : m->joints) {
      if (j->servo != ServoMode::Motor || j->released < 20) continue;
      const double off = std::abs(j->target - j->axes[0].q);
      if (off < 1e-4 || j->released > 1000) {
        j->servo = ServoMode::Locked;
        j->catching_up = off >= 1e-4;
        m->dirty = true;
      }
    }
}

// What the motor needs to hold the links beyond against gravity.
void World::motor_load(Joint& j) {
  const Pose X_WJ = j.frame_W();
  const Vec3 axis = rotate(X_WJ.q, j.axes[0].xyz);
  double load = 0, mass = 0, reach = 0;
  for (Link* l : subtree(j)) {
    const Vec3 f = l->gravity ? gravity * l->mass : Vec3{};
    load += j.type == JointType::Revolute ? dot(axis, cross(l->com_W() - X_WJ.p, f)) : dot(axis, f);
    mass += l->mass;
    reach = std::max(reach, norm(l->com_W() - X_WJ.p) + l->size);
  }
  double effort = j.axes[0].effort;
  if (effort <= 0 || effort > kUnlimited) {  // none given: enough to carry itself twice over
    effort = 2 * mass * std::max(norm(gravity), 1.0) * (j.type == JointType::Revolute ? reach : 1.0) + 1.0;
  }
  j.load = std::abs(load) + effort;
}

// ------------------------------------------------------------------------------------------------ forces

void World::apply_axis_force(Joint& j, int axis, double f) {
  if (f == 0) return;
  const dBodyID child = body_of(j.child), parent = body_of(j.parent);
  const Pose X_WJ = axis == 0 ? j.frame_W() : j.child->X_WL * j.X_CJ;
  const Vec3 v = rotate(X_WJ.q, j.axes[axis].xyz) * f;
  if (j.type == JointType::Prismatic) {
    const Vec3 p = (j.child->X_WL * j.X_CJ).p;
    if (child) dBodyAddForceAtPos(child, v.x, v.y, v.z, p.x, p.y, p.z);
    if (parent) dBodyAddForceAtPos(parent, -v.x, -v.y, -v.z, p.x, p.y, p.z);
  } else {
    if (child) dBodyAddTorque(child, v.x, v.y, v.z);
    if (parent) dBodyAddTorque(parent, -v.x, -v.y, -v.z);
  }
}

// A controller's law as the speed that a soft motor row aims at: the row gives what the law gives at the speed that the step arrives
// at. What it gives at the speed before, held through the step, throws a light wheel to and fro. Friction is taken off first.
// A limit of speed takes a force away that would make the joint still faster, as in Gazebo, and what one step gives a light joint is
// over it: it goes as far beyond as one step at the limit pushes it. Legs that walk there walk here.
static double speed_by_law(const Axis& a, double dt, double inverse_inertia) {
  double speed = a.qd + a.law / a.slope;
  if (a.velocity > 0) {
    const double over = (std::abs(speed) - a.velocity) * a.slope;  // the law's force at the limit
    const double push = std::min(std::max(over, 0.0), a.effort >= 0 ? std::min(a.law_bound, a.effort) : a.law_bound);
    const double most = a.velocity + dt * inverse_inertia * push;
    speed = std::min(std::max(speed, -most), most);
  }
  return std::copysign(std::max(std::abs(speed) - a.friction / a.slope, 0.0), speed);
}

// ODE knows angles within a turn: its stops move along with the turns.
void World::set_stops(Joint& j, int i) {
  const Axis& a = j.axes[i];
  double lower = a.lower, upper = a.upper;
  if (!like_gazebo) {  // a joint that begins far beyond a stop, as many do at zero, comes back without throwing the robot
    const double near = (j.type == JointType::Prismatic ? kBackSlide : kBackTurn) * dt / std::max(j.stop_erp, 1e-3);
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
  if (j.type == JointType::Revolute && lower < -kPi && upper > kPi && (std::isfinite(lower) || std::isfinite(upper))) upper = kPi;
  set_limot(j, i, dParamLoStop, std::isfinite(lower) ? lower : -dInfinity);
  set_limot(j, i, dParamHiStop, std::isfinite(upper) ? upper : dInfinity);
  set_limot(j, i, dParamLoStop, std::isfinite(lower) ? lower : -dInfinity);  // ODE refuses a low stop above the old high one
}

// Motor, friction, limits, damping and spring of one axis for this step.
void World::update_axis(Joint& j, int i) {
  Axis& a = j.axes[i];
  double velocity = 0, most = 0, softness = 1e-10, force = a.force;
  double damping = a.damping;
  const double stiffness = a.spring_stiffness;
  const double pull = stiffness > 0 ? -stiffness * (a.q - a.spring_reference) : 0;
  const double stiff = dt * (damping + dt * stiffness) * j.inverse_inertia[i];
  // At a stop ODE turns motors into torques of their greatest size.
  const bool off_stops = a.q - a.lower > kNearStop && a.upper - a.q > kNearStop;
  const bool by_law = !like_gazebo && off_stops && j.servo != ServoMode::Motor && a.motor_force <= 0 &&
                      dt * a.slope * j.inverse_inertia[i] > kStiffLaw && (a.law == 0 || a.admitted(a.law) != 0);
  if (i == 0 && j.servo == ServoMode::Motor) {
    motor_load(j);
    const double fastest = a.velocity > 0 && a.velocity < kUnlimited ? a.velocity : 100.0;
    velocity = std::min(std::max((j.target - a.q) / dt, -fastest), fastest);
    most = j.load;
  } else if (a.motor_force > 0) {
    velocity = a.motor_velocity;
    most = a.motor_force;
  } else if (by_law) {
    velocity = speed_by_law(a, dt, j.inverse_inertia[i]);
    softness = 1 / a.slope;
    most = a.effort >= 0 ? std::min(a.law_bound, a.effort) : a.law_bound;
    force -= a.lawful();
  } else if (a.friction > 0) {
    most = a.friction;
  } else if (damping + stiffness > 0 && (j.implicit_spring_damper || (stiff > 0.05 && !like_gazebo)) && off_stops) {
    // Implicit: a motor row whose softness is the damper, and whose speed is that at which the spring balances it.
    const double d = damping + dt * stiffness;
    velocity = pull / d;
    softness = 1 / d;
    most = dInfinity;
    damping = 0;
  }
  if (softness <= 1e-10 || by_law) {
    if (stiff > 0.05 && !like_gazebo) damping /= 1 + stiff;
    force += pull - damping * a.qd;
  }
  set_limot(j, i, dParamFMax, most);
  a.drive = velocity * j.sign;
  set_limot(j, i, dParamVel, a.drive);
  set_limot(j, i, dParamCFM, softness);
  set_stops(j, i);
  apply_axis_force(j, i, force);
}

void World::apply_forces() {
  dWorldSetGravity(world_, gravity.x, gravity.y, gravity.z);
  dWorldSetERP(world_, erp);
  dWorldSetCFM(world_, std::max(cfm, 1e-10));
  for (auto& m : models_) {
    for (auto& l : m->links) {
      l->applied_force = l->force;
      l->applied_torque = l->torque;
      if (l->cluster < 0) continue;
      Cluster& c = m->clusters[l->cluster];
      if (!c.root) continue;
      dBodyID body = c.root->body;
      if (l->force.x != 0 || l->force.y != 0 || l->force.z != 0) {
        const Vec3 p = l->com_W();
        dBodyAddForceAtPos(body, l->force.x, l->force.y, l->force.z, p.x, p.y, p.z);
      }
      dBodyAddTorque(body, l->torque.x, l->torque.y, l->torque.z);
    }
    for (auto& c : m->clusters)
      if (c.root && !c.uniform_gravity && c.gravity_mass > 0) {
        const Vec3 p = c.root->X_WL * c.gravity_com, f = gravity * c.gravity_mass;
        dBodyAddForceAtPos(c.root->body, f.x, f.y, f.z, p.x, p.y, p.z);
      }
    for (auto& j : m->joints)
      if (j->joint)
        for (int i = 0; i < j->axis_count; ++i) update_axis(*j, i);
    if (!like_gazebo || m->has_servo) apply_inertial_forces(*m);
  }
}

}  // namespace ode_sim
