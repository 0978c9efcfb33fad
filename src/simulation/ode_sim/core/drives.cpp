// Position drives: their rates, and what becomes of them where their links touch something.
#include <algorithm>
#include <cmath>
#include <set>

#include "phases.hpp"

namespace ode_sim {

namespace {

constexpr double kFollows = 0.2;  // part of the way to its leader that a follower makes in a step while it pushes
constexpr double kJump = 30;      // m/s, rad/s: a position drive commanded to move faster than this is teleported

// The fastest that a drive may go, m/s or rad/s.
double speed_limit(const Axis& a, double otherwise) {
  return a.velocity > 0 && a.velocity < kUnlimited ? a.velocity : otherwise;
}

void follow_leader(Joint& j, double dt) {
  const auto leader = j.leader.lock();
  if (!leader) return;
  const Joint& l = *leader;
  const Axis& a = j.axes[0];
  // Two fingers hold one thing: what one gives way the other is pushed, and a follower that made it good within a step would drive
  // both to and fro.
  const bool pushes = j.drive == DriveMode::Motor && l.drive != DriveMode::Locked;
  const double q = l.drive == DriveMode::Locked ? l.target : l.axes[0].q + (pushes ? 0 : l.axes[0].qd * dt);
  double wanted = std::min(std::max(j.multiplier * q + j.offset, a.lower), a.upper);
  if (pushes) wanted = a.q + kFollows * (wanted - a.q);
  j.target = std::min(std::max(wanted, -kFarthest), kFarthest);  // joints that follow each other would grow without bound
}

// A joint in Motor mode whose command changes speed takes what is beyond along without a reaction on what carries it, as
// a locked one does - unless something holds it back.
void feed_forward(Joint& j, double dt) {
  Axis& a = j.axes[0];
  const double most = speed_limit(a, 100.0);
  const double wanted = std::min(std::max((j.target - j.previous_target) / dt, -most), most);
  const double change = wanted - j.rate;
  const bool free = std::abs(a.qd - j.rate) < 0.05 * std::abs(j.rate) + 1e-3;
  j.rate = wanted;
  if (!free || std::abs(change) < 1e-12) return;
  const Pose X_WJ = j.frame_W();
  const Vec3 delta = rotate(X_WJ.q, a.xyz) * change;
  std::set<dBodyID> done;
  for (Link* l : links_beyond(j)) {
    if (l->cluster < 0 || l->carrier) continue;
    const Cluster& c = j.model->clusters[l->cluster];
    if (!c.root || !done.insert(c.root->body).second) continue;
    dBodyID b = c.root->body;
    Vec3 v = body_velocity(b), w = body_spin(b);
    if (j.turns() != 0) {
      w += delta;
      v += cross(delta, vec(dBodyGetPosition(b)) - X_WJ.p);
    }
    if (j.slides() != 0) v += delta * j.slides();
    set_body_twist(b, v, w);
  }
}

}  // namespace

void set_rates(Scene& scene, StepState& state, Model& model) {
  const double dt = scene.settings.dt;
  for (auto& j : model.joints) {
    if (j->drive == DriveMode::Off) continue;
    Axis& a = j->axes[0];
    follow_leader(*j, dt);
    double rate = (j->target - a.q) / dt;
    if (j->drive == DriveMode::Locked) {
      if (j->catching_up) {
        const double most = speed_limit(a, 1.0);
        if (std::abs(rate) <= most) j->catching_up = false;
        rate = std::min(std::max(rate, -most), most);
      }
      j->rate = rate;
    } else {
      feed_forward(*j, dt);
    }
  }
  bool& jump = state.of(model).jump;
  jump = false;
  for (auto& j : model.joints)
    if (j->drive == DriveMode::Locked) jump |= std::max(std::abs(j->rate), std::abs(j->previous_rate)) > kJump;
  for (auto& c : model.clusters)
    if (c.moving) {
      spread_twists(c);
      for (Link* l : c.members)
        if (l->carrier) set_body_twist(l->body, l->v, l->w);
    }
}

namespace {

// The position drives between the link and what its cluster hangs from become motors.
bool promote_path(Scene& scene, Link* link) {
  bool any = false;
  for (; link; link = link->up_link)
    if (link->up && link->up->drive == DriveMode::Locked && link->up->sane) {
      link->up->drive = DriveMode::Motor;
      link->up->released = 0;
      link->model->dirty = true;
      ++scene.counters.promotions;
      any = true;
    }
  return any;
}

// Pairs that touched already when the drives were engaged are none of their business until they come apart.
void update_exempt(Model& m, const std::set<std::pair<int, int>>& touching) {
  if (m.take_exempt) {
    m.exempt = touching;
    m.take_exempt = false;
    return;
  }
  for (auto it = m.exempt.begin(); it != m.exempt.end();) it = touching.count(*it) ? std::next(it) : m.exempt.erase(it);
}

bool promote_model(Scene& scene, const StepState& state, Model& m) {
  bool any = false;
  std::set<std::pair<int, int>> touching;
  for (auto& c : state.contacts) {
    Link *la = c.a->link, *lb = c.b->link;
    if (la->model != &m && lb->model != &m) continue;
    const std::pair<int, int> pair{c.a->id, c.b->id};
    touching.insert(pair);
    if (m.take_exempt || m.exempt.count(pair)) continue;
    if (c.a->surface.collide_without_contact || c.b->surface.collide_without_contact) continue;
    if (la->model == &m && la->moving) any |= promote_path(scene, la);
    if (lb->model == &m && lb->moving) any |= promote_path(scene, lb);
  }
  update_exempt(m, touching);
  // Contacts keep the motors above them going.
  for (auto& j : m.joints)
    if (j->drive == DriveMode::Motor) ++j->released;
  for (auto& c : state.contacts)
    for (Link* l : {c.a->link, c.b->link}) {
      if (l->model != &m || m.exempt.count({c.a->id, c.b->id})) continue;
      for (Joint* j = l->parent_joint; j; j = j->parent ? j->parent->parent_joint : nullptr) j->released = 0;
    }
  return any;
}

}  // namespace

// Where a moving link of a cluster touches something else, the position drives above it become motors.
bool promote(Scene& scene, StepState& state) {
  bool any = false;
  for (auto& m : scene.models)
    if (m->has_drives) any |= promote_model(scene, state, *m);
  return any;
}

void demote(Scene& scene) {
  for (auto& m : scene.models)
    for (auto& j : m->joints) {
      if (j->drive != DriveMode::Motor || j->released < 20) continue;
      const double off = std::abs(j->target - j->axes[0].q);
      if (off < 1e-4 || j->released > 1000) {
        j->drive = DriveMode::Locked;
        j->catching_up = off >= 1e-4;
        m->dirty = true;
      }
    }
}

// What it needs to hold the links beyond against gravity, and its effort on top.
double motor_load(const Scene& scene, Joint& j) {
  const Vec3& gravity = scene.settings.gravity;
  const Pose X_WJ = j.frame_W();
  const Vec3 axis = rotate(X_WJ.q, j.axes[0].xyz);
  double load = 0, mass = 0, reach = 0;
  for (Link* l : links_beyond(j)) {
    const Vec3 f = l->gravity ? gravity * l->mass : Vec3{};
    if (j.turns() != 0) load += dot(axis, cross(l->com_W() - X_WJ.p, f));
    if (j.slides() != 0) load += dot(axis, f) * j.slides();
    mass += l->mass;
    reach = std::max(reach, norm(l->com_W() - X_WJ.p) + l->size);
  }
  double effort = j.axes[0].effort;
  if (effort <= 0 || effort > kUnlimited) {  // none given: enough to carry itself twice over
    effort = 2 * mass * std::max(norm(gravity), 1.0) * (j.turns() != 0 ? reach : 1.0) + 1.0;
  }
  return std::abs(load) + effort;
}

void integrate_drives(const Scene& scene) {
  for (auto& m : scene.models)
    for (auto& j : m->joints) {
      if (j->drive == DriveMode::Off) continue;
      j->previous_target = j->target;
      if (j->drive != DriveMode::Locked) continue;
      Axis& a = j->axes[0];
      a.q = j->catching_up ? a.q + j->rate * scene.settings.dt : j->target;
      a.qd = j->rate;
    }
}

}  // namespace ode_sim
