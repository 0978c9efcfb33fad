// What is asked for between two steps: poses, velocities, targets of position drives, welds.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <stdexcept>

#include "phases.hpp"
#include "world.hpp"

namespace ode_sim {

// ------------------------------------------------------------------------------------------------ commands

namespace {

// A link of a finished static model, with all that shows where it is.
void put(Scene& scene, Link& l, const Pose& X_WL) {
  l.X_WL = l.X_RL = X_WL;
  place_shapes(scene, l);
  const double row[] = {X_WL.p.x, X_WL.p.y, X_WL.p.z, X_WL.q.x, X_WL.q.y, X_WL.q.z, X_WL.q.w};
  std::copy(std::begin(row), std::end(row), scene.link_poses->begin() + 7 * l.row);
}

bool same_place(const Pose& X, const Pose& Y) {
  constexpr double kSame = 1e-9;  // m, rad: less is rounding
  const Quat d = conjugate(X.q) * Y.q;
  return norm(X.p - Y.p) < kSame && norm(Vec3{d.x, d.y, d.z}) < kSame;
}

// All links of a finished static model. What they have touched wakes, and what they touch.
void put_all(Scene& scene, Model& model, const std::vector<Pose>& X_WL) {
  std::vector<Pose> there;
  for (const Pose& X : X_WL) there.push_back(normalized(X));
  const bool moves = !std::equal(there.begin(), there.end(), model.links.begin(),
                                 [](const Pose& X, const auto& l) { return same_place(X, l->X_WL); });
  if (moves) disturb(scene, model);
  for (size_t i = 0; i < there.size(); ++i) put(scene, *model.links[i], there[i]);
  if (moves) disturb(scene, model);
}

}  // namespace

// However far its parts may have flown apart, a model can be put back.
void World::set_model_pose(Model& model, const Pose& old, const Pose& wanted) {
  const OdeScope scope;
  const Pose X = wanted * inverse(old);
  std::vector<Pose> poses;
  for (auto& l : model.links) poses.push_back(checked(X * l->X_WL, "a link of the model, so placed,", kOutOfReach));
  std::vector<Pose> bolts;
  for (auto& j : model.joints)
    bolts.push_back(j->parent ? j->X_PJ : checked(X * j->X_PJ, "a joint of the model, so placed,", kOutOfReach));
  if (model.is_static && model.finished) {  // moved by somebody in every step, maybe: nothing else in the world has changed
    refresh();
    put_all(scene_, model, poses);
    return;
  }
  for (size_t i = 0; i < poses.size(); ++i) {
    Link& l = *model.links[i];
    l.X_WL = poses[i];
    if (model.is_static) l.X_RL = l.X_WL;
  }
  for (size_t i = 0; i < bolts.size(); ++i)
    if (!model.joints[i]->parent) model.joints[i]->X_PJ = bolts[i];
  for (auto& j : model.joints)
    if (!j->holds() && !j->reference) j->q_RJ = normalized(X.q * j->q_RJ);
  model.dirty = true;
  refresh();
  read_back(scene_);
}

void World::set_link_pose(Link& link, const Pose& X_WL) {
  const OdeScope scope;
  Model& model = *link.model;
  refresh();
  Cluster& c = model.clusters[link.cluster];
  if (!c.root && !model.is_static) return;  // bolted to the world
  const Pose X = normalized(X_WL) * inverse(link.X_WL);
  if (c.root) {
    for (Link* l : c.members) checked_place(X * l->X_WL.p, "a link joined to it, so placed,");
    c.root->X_WL = normalized(X * c.root->X_WL);
  } else {
    link.X_WL = normalized(X_WL);
  }
  model.dirty = true;
  refresh();
  read_back(scene_);
}

namespace {

constexpr double kFastestLed = 30;  // m/s: faster ones were put elsewhere

// rad/s, of what turns from one to the other in so many seconds.
Vec3 spin_between(const Quat& from, const Quat& to, double seconds) {
  Quat turn = to * conjugate(from);
  if (turn.w < 0) turn = {-turn.x, -turn.y, -turn.z, -turn.w};
  const Vec3 axis{turn.x, turn.y, turn.z};
  const double sine = norm(axis);
  return sine > 0 ? axis * (2 * std::atan2(sine, turn.w) / (sine * seconds)) : Vec3{};
}

}  // namespace

void take_led_velocities(Scene& scene) {
  for (auto& m : scene.models) {
    if (!(m->led_seconds > 0)) continue;
    for (auto& l : m->links) {
      l->v = (l->X_WL.p - l->X_was.p) * (1 / m->led_seconds);
      l->w = spin_between(l->X_was.q, l->X_WL.q, m->led_seconds);
      if (norm(l->v) > kFastestLed) l->v = l->w = {};
    }
  }
}

void forget_led(Scene& scene) {
  for (auto& m : scene.models) {
    if (!(m->led_seconds > 0)) continue;
    m->led_seconds = 0;
    for (auto& l : m->links) l->led = false;
  }
}

void World::lead_links(Model& model, const std::vector<Pose>& X_WL, double seconds) {
  const OdeScope scope;
  if (!model.is_static || !model.finished) throw std::invalid_argument("only the links of a static model in the world are led");
  if (X_WL.size() != model.links.size())
    throw std::invalid_argument(std::to_string(X_WL.size()) + " poses for " + std::to_string(model.links.size()) + " links");
  for (const Pose& X : X_WL) checked(X, "a link of the model, so placed,", kOutOfReach);
  refresh();
  for (size_t i = 0; i < X_WL.size(); ++i) {
    Link& l = *model.links[i];
    l.led = seconds > 0;
    l.X_was = l.X_WL;
  }
  put_all(scene_, model, X_WL);
  model.led_seconds = std::max(seconds, 0.0);
}

namespace {

// The cluster's body moves as its root link was just told to.
void take_twist(Cluster& c) {
  place_cluster(c);
  if (c.by) {
    const dBodyID b = c.root->body;
    set_body_twist(b, body_velocity(b) - c.carry_v, body_spin(b) - c.carry_w);
  }
  spread_twists(c);
}

}  // namespace

void World::set_link_twist(Link& link, const Vec3& v, const Vec3& w) {
  const OdeScope scope;
  refresh();
  Cluster& c = link.model->clusters[link.cluster];
  if (!c.root) return;
  wake(scene_, *link.model);
  c.root->v = v + cross(w, c.root->X_WL.p - link.X_WL.p);
  c.root->w = w;
  take_twist(c);
}

// All of it moves faster by a rigid motion: `v` at the point `at`, turning by `w`. Joints go on as they went.
void World::add_model_twist(Model& model, const Vec3& v, const Vec3& w, const Vec3& at) {
  const OdeScope scope;
  refresh();
  wake(scene_, model);
  for (auto& c : model.clusters) {
    if (!c.root) continue;
    c.root->v += v + cross(w, c.root->X_WL.p - at);
    c.root->w += w;
    take_twist(c);
  }
}

void World::zero_velocities(Model& model) {
  const OdeScope scope;
  refresh();
  forget_loads(scene_, model);
  for (auto& j : model.joints) std::fill(std::begin(j->borne), std::end(j->borne), 0.0);
  for (auto& l : model.links) l->v = l->w = l->force = l->torque = {};
  for (auto& j : model.joints) {
    j->rate = j->previous_rate = 0;
    for (auto& a : j->axes) a.relax();
  }
  wake(scene_, model);
  for (auto& c : model.clusters) place_cluster(c);
  read_back(scene_);
}

bool World::set_joint_position(Joint& j, int axis, double q) {
  const OdeScope scope;
  if (j.axis_count == 0 || !j.holds()) return false;
  if (j.type == JointType::Screw && axis == 1) return set_joint_position(j, 0, q / j.slides());
  bool loop = false;
  refresh();
  const auto& beyond = links_beyond(j, &loop);
  if (loop) return false;
  Axis& a = j.axes[axis];
  q = std::min(std::max(q, a.lower), a.upper);
  const Pose X_WJ = j.frame_W();
  const double before = std::exchange(a.q, q);
  const Pose X_WC = X_WJ * j.motion() * inverse(j.X_CJ);
  const Pose X = X_WC * inverse(j.child->X_WL);
  a.q = before;  // until it is known that nothing is refused
  for (Link* l : beyond) checked_place(X * l->X_WL.p, "a link beyond the joint, so placed,");
  for (Link* l : beyond) {
    l->X_WL = normalized(X * l->X_WL);
    l->v = l->w = {};
    l->model->dirty = true;
  }
  a.q = q;
  a.qd = 0;
  j.target = j.previous_target = q;
  j.rate = 0;
  wake(scene_, *j.child->model);
  refresh();
  read_back(scene_);
  return true;
}

void World::set_drive(Joint& j, double target) {
  if (j.turns() == 0 && j.slides() == 0) return;
  if (j.model == scene_.bonds.get())
    throw std::invalid_argument("a joint that came while the world ran follows no position command");
  const Axis& a = j.axes[0];
  j.target = limited(std::min(std::max(target, a.lower), a.upper), kFarthest, "a position command");
  if (j.drive != DriveMode::Off) return;
  j.drive = DriveMode::Locked;
  j.previous_target = a.q;
  j.released = 0;
  j.model->dirty = true;
  j.model->take_exempt = true;
}

void World::drive_off(Joint& j) {
  if (j.drive == DriveMode::Off) return;
  j.drive = DriveMode::Off;
  j.rate = 0;
  j.leader.reset();
  j.model->dirty = true;
}

void World::set_inertial(Link& link, double mass, const Vec3& com, const Sym3& inertia) {
  link.mass = mass;
  link.com = com;
  link.inertia = inertia;
  link.model->dirty = true;
  judge_masses(*link.model);
}

// Position-commanded to `multiplier` times the position of the leader, plus `offset`. Without a leader it is let go.
void World::follow(Joint& j, const std::shared_ptr<Joint>& leader, double multiplier, double offset) {
  if (!leader) return drive_off(j);
  if (!owns(leader->model)) throw std::invalid_argument("the joint to follow is not in this world");
  j.leader = leader;
  j.multiplier = limited(multiplier, kFarthest, "the multiplier of a mimic joint");
  j.offset = limited(offset, kFarthest, "the offset of a mimic joint");
  set_drive(j, j.multiplier * leader->axes[0].q + j.offset);
}

// ------------------------------------------------------------------------------------------------ welds

// Holds the child where it is now relative to the parent (to the world if null). Returns the number of the weld.
int World::weld(std::shared_ptr<Link> parent, std::shared_ptr<Link> child) {
  for (const Link* l : {parent.get(), child.get()})
    if (l && !owns(l->model)) throw std::invalid_argument("a link to be attached is not in this world");
  if (parent == child) throw std::invalid_argument("a link cannot be attached to itself");
  refresh();
  const Pose X_PC = parent ? inverse(parent->X_WL) * child->X_WL : child->X_WL;
  scene_.welds.push_back({next_weld_++, std::move(parent), std::move(child), X_PC});
  for (auto& l : {scene_.welds.back().parent, scene_.welds.back().child})
    if (l) wake(scene_, *l->model), l->model->dirty = true;
  return scene_.welds.back().id;
}

void World::unweld(int id) {
  for (size_t i = 0; i < scene_.welds.size(); ++i) {
    if (scene_.welds[i].id != id) continue;
    for (auto& l : {scene_.welds[i].parent, scene_.welds[i].child})
      if (l) wake(scene_, *l->model), l->model->dirty = true;
    scene_.welds.erase(scene_.welds.begin() + i);
    return;
  }
}

void World::unweld_strained() {
  constexpr double kInPlace = 1e-3;  // m, and rad
  for (size_t i = scene_.welds.size(); i-- > 0;) {
    const Weld& t = scene_.welds[i];
    const Pose held = t.parent ? t.parent->X_WL * t.X_PC : t.X_PC, off = inverse(held) * t.child->X_WL;
    if (norm(off.p) > kInPlace || norm({off.q.x, off.q.y, off.q.z}) > kInPlace / 2) unweld(t.id);
  }
}

Weld* World::find_weld(int id) {
  for (auto& t : scene_.welds)
    if (t.id == id) return &t;
  return nullptr;
}

std::vector<int> World::welds() const {
  std::vector<int> out;
  for (auto& t : scene_.welds) out.push_back(t.id);
  return out;
}

}  // namespace ode_sim
