// What is asked for between two steps: poses, velocities, servo targets, ties.
#include "ode_access.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace ode_sim {

// ------------------------------------------------------------------------------------------------ commands

void World::wake(Model& model) {
  for (auto& c : model.clusters) {
    c.asleep = false;
    c.idle_steps = 0;
    c.idle_time = 0;
  }
}

// However far its parts may have flown apart, a model can be put back.
void World::set_model_pose(Model& model, const Pose& old, const Pose& wanted) {
  const Pose X = wanted * inverse(old);
  std::vector<Pose> poses;
  for (auto& l : model.links) poses.push_back(checked(X * l->X_WL, "a link of the model, so placed,", kOutOfReach));
  std::vector<Pose> bolts;
  for (auto& j : model.joints) bolts.push_back(j->parent ? j->X_PJ : checked(X * j->X_PJ, "a joint of the model, so placed,", kOutOfReach));
  for (size_t i = 0; i < poses.size(); ++i) {
    Link& l = *model.links[i];
    l.X_WL = poses[i];
    if (model.is_static) l.X_RL = l.X_WL;
  }
  for (size_t i = 0; i < bolts.size(); ++i)
    if (!model.joints[i]->parent) model.joints[i]->X_PJ = bolts[i];
  model.dirty = true;
  refresh();
  read_back();
}

void World::set_link_pose(Link& link, const Pose& X_WL) {
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
  read_back();
}

void World::set_link_twist(Link& link, const Vec3& v, const Vec3& w) {
  refresh();
  Cluster& c = link.model->clusters[link.cluster];
  if (!c.root) return;
  wake(*link.model);
  c.root->v = v + cross(w, c.root->X_WL.p - link.X_WL.p);
  c.root->w = w;
  place_cluster(c);
  if (c.by) {
    const dBodyID b = c.root->body;
    set_body_twist(b, vec(dBodyGetLinearVel(b)) - c.carry_v, vec(dBodyGetAngularVel(b)) - c.carry_w);
  }
  spread_twists(c);
}

// All of it moves faster by a rigid motion: `v` at the point `at`, turning by `w`. Joints go on as they went.
void World::add_model_twist(Model& model, const Vec3& v, const Vec3& w, const Vec3& at) {
  refresh();
  wake(model);
  for (auto& c : model.clusters) {
    if (!c.root) continue;
    c.root->v += v + cross(w, c.root->X_WL.p - at);
    c.root->w += w;
    place_cluster(c);
    if (c.by) {
      const dBodyID b = c.root->body;
      set_body_twist(b, vec(dBodyGetLinearVel(b)) - c.carry_v, vec(dBodyGetAngularVel(b)) - c.carry_w);
    }
    spread_twists(c);
  }
}

void World::zero_velocities(Model& model) {
  refresh();
  forget_loads(model);
  for (auto& j : model.joints) std::fill(std::begin(j->borne), std::end(j->borne), 0.0);
  for (auto& l : model.links) l->v = l->w = l->force = l->torque = {};
  for (auto& j : model.joints) {
    j->rate = j->previous_rate = 0;
    for (auto& a : j->axes) a.relax();
  }
  wake(model);
  for (auto& c : model.clusters) place_cluster(c);
  read_back();
}

bool World::set_joint_position(Joint& j, int axis, double q) {
  if (j.axis_count == 0) return false;
  bool loop = false;
  refresh();
  const auto beyond = subtree(j, &loop);
  if (loop) return false;
  Axis& a = j.axes[axis];
  q = std::min(std::max(q, a.lower), a.upper);
  const Pose X_WJ = j.frame_W();
  Pose X_J;
  if (j.type == JointType::Universal) {
    const double q0 = axis == 0 ? q : j.axes[0].q, q1 = axis == 1 ? q : j.axes[1].q;
    X_J.q = axis_angle(j.axes[0].xyz, q0) * axis_angle(j.axes[1].xyz, q1);
  } else {
    X_J = j.motion(q);
  }
  const Pose X_WC = X_WJ * X_J * inverse(j.X_CJ);
  const Pose X = X_WC * inverse(j.child->X_WL);
  for (Link* l : beyond) checked_place(X * l->X_WL.p, "a link beyond the joint, so placed,");
  for (Link* l : beyond) {
    l->X_WL = normalized(X * l->X_WL);
    l->v = l->w = {};
  }
  a.q = q;
  a.qd = 0;
  j.target = j.previous_target = q;
  j.rate = 0;
  wake(*j.model);
  j.model->dirty = true;
  refresh();
  read_back();
  return true;
}

void World::set_servo(Joint& j, double target) {
  if (j.type != JointType::Revolute && j.type != JointType::Prismatic) return;
  const Axis& a = j.axes[0];
  j.target = limited(std::min(std::max(target, a.lower), a.upper), kFarthest, "a position command");
  if (j.servo != ServoMode::Off) return;
  j.servo = ServoMode::Locked;
  j.previous_target = a.q;
  j.released = 0;
  j.model->dirty = true;
  j.model->take_exempt = true;
}

void World::servo_off(Joint& j) {
  if (j.servo == ServoMode::Off) return;
  j.servo = ServoMode::Off;
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
  if (!leader) return servo_off(j);
  if (!owns(leader->model)) throw std::invalid_argument("the joint to follow is not in this world");
  j.leader = leader;
  j.multiplier = limited(multiplier, kFarthest, "the multiplier of a mimic joint");
  j.offset = limited(offset, kFarthest, "the offset of a mimic joint");
  set_servo(j, j.multiplier * leader->axes[0].q + j.offset);
}

// ------------------------------------------------------------------------------------------------ ties

// Holds the child where it is now relative to the parent (to the world if null). Returns the tie's number.
int World::attach(std::shared_ptr<Link> parent, std::shared_ptr<Link> child) {
  for (const Link* l : {parent.get(), child.get()})
    if (l && !owns(l->model)) throw std::invalid_argument("a link to be attached is not in this world");
  if (parent == child) throw std::invalid_argument("a link cannot be attached to itself");
  refresh();
  const Pose X_PC = parent ? inverse(parent->X_WL) * child->X_WL : child->X_WL;
  ties_.push_back({next_tie_++, std::move(parent), std::move(child), X_PC});
  for (auto& l : {ties_.back().parent, ties_.back().child})
    if (l) wake(*l->model), l->model->dirty = true;
  return ties_.back().id;
}

void World::detach(int id) {
  for (size_t i = 0; i < ties_.size(); ++i) {
    if (ties_[i].id != id) continue;
    for (auto& l : {ties_[i].parent, ties_[i].child})
      if (l) wake(*l->model), l->model->dirty = true;
    ties_.erase(ties_.begin() + i);
    return;
  }
}

void World::detach_all() {
  while (!ties_.empty()) detach(ties_.back().id);
}

Tie* World::find_tie(int id) {
  for (auto& t : ties_)
    if (t.id == id) return &t;
  return nullptr;
}

std::vector<int> World::ties() const {
  std::vector<int> out;
  for (auto& t : ties_) out.push_back(t.id);
  return out;
}

// Links that are tied do not collide, nor does what is rigidly joined to them.
bool World::tied(const Link& a, const Link& b) const {
  const auto same = [](const std::shared_ptr<Link>& l, const Link& m) { return l && l->model == m.model && l->cluster == m.cluster; };
  for (auto& t : ties_)
    if ((same(t.parent, a) && same(t.child, b)) || (same(t.parent, b) && same(t.child, a))) return true;
  return false;
}

// Made anew for each step: which bodies carry the links changes when servo joints lock and unlock.
void World::make_tie_joints() {
  for (auto& t : ties_) {
    t.joint = nullptr;
    const dBodyID child = body_of(t.child.get()), parent = body_of(t.parent.get());
    if (child == parent || (!child && !parent)) continue;
    t.joint = dJointCreateFixed(world_, contact_group_);
    dJointSetFeedback(t.joint, &t.feedback);
    dJointAttach(t.joint, child ? child : parent, child ? parent : nullptr);
    const Pose X_CB = X_BL(*t.child), X_PB = (t.parent ? X_BL(*t.parent) : Pose{}) * t.X_PC;
    const Posed posed(child ? child : parent, child ? parent : nullptr, child ? X_CB : X_PB, child ? X_PB : X_CB);
    dJointSetFixed(t.joint);
  }
}

}  // namespace ode_sim
