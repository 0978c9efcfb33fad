// Trees of ODE joints put exactly where their angles say.
//
// Bodies move along straight lines within a step, while their joints would have them on arcs. Left to ODE's correcting forces, that
// costs energy, fights with static friction (turning wheels scrub and carry uneven loads) and shows as gaping joints.
#include <algorithm>

#include "phases.hpp"

namespace ode_sim {

namespace {

void read_tree(StepState& state, Model& model) {
  for (auto& c : model.clusters) state.of(c).moved = false;
  for (auto& t : model.tree) {
    read_joint(*t.joint);
    // A hard stop is where it is: nothing overshoots it, and nothing is thrown back by the correction.
    if (t.joint->stop_cfm <= 0 && t.joint->type != JointType::Universal)
      for (Axis& a : t.joint->axes) a.q = std::min(std::max(a.q, a.lower), a.upper);
  }
}

// The cluster where the joint's position says, from the other side of the joint.
void place_branch(const Branch& t, Cluster& c) {
  const Joint& j = *t.joint;
  const Link &child = *j.child, &moved = t.outward ? child : *j.parent;
  Pose X_J = j.motion();
  if (j.type == JointType::Ball) X_J.q = conjugate(j.frame_W().q) * child.X_WL.q * j.X_CJ.q;
  const Pose wanted = t.outward ? j.frame_W() * X_J * inverse(j.X_CJ) : child.X_WL * j.X_CJ * inverse(X_J) * inverse(j.X_PJ);
  c.root->X_WL = normalized(wanted * inverse(moved.X_RL));
  spread_poses(c);
}

// Its velocities from the speeds of the joint: of the moved link, then of its root.
void move_branch(const Branch& t, Cluster& c) {
  const Joint& j = *t.joint;
  const Link &child = *j.child, &moved = t.outward ? child : *j.parent;
  const Pose X_WP = j.frame_W(), X_WC = j.child_frame_W();
  const Vec3 first = rotate(X_WP.q, j.axes[0].xyz) * j.axes[0].qd;
  Vec3 turn, slide;
  if (j.turns() != 0) turn = first;
  if (j.slides() != 0) slide = first * j.slides();
  if (j.type == JointType::Universal) turn = first + rotate(X_WC.q, j.axes[1].xyz) * j.axes[1].qd;
  Vec3 w, v;  // of the moved link, at the joint origin
  if (t.outward) {
    w = (j.parent ? j.parent->w : Vec3{}) + turn;
    v = (j.parent ? j.parent->velocity_at(X_WC.p) : Vec3{}) + slide;
  } else {
    w = child.w - turn;
    v = child.velocity_at(X_WC.p) - slide;
  }
  if (j.type == JointType::Ball) w = moved.w;
  // The cluster moves as the moved link does, less what position drives inside do.
  c.root->w += w - moved.w;
  c.root->v += v + cross(w, moved.X_WL.p - X_WC.p) - moved.v + cross(w - moved.w, c.root->X_WL.p - moved.X_WL.p);
  spread_twists(c, c.carriers);
}

// What floats free keeps its centre of mass and its momentum.
void keep_momentum(StepState& state, Model& model, int head, double dt) {
  double mass = 0;
  Vec3 shift, kick;
  auto add = [&](const Cluster& c) {
    mass += c.mass;
    const Vec3 com = c.root->X_WL * c.com;
    shift += (vec(dBodyGetPosition(c.root->body)) - com) * c.mass;
    kick += (body_velocity(c.root->body) + state.of(c).still.a * dt - c.root->velocity_at(com)) * c.mass;
  };
  auto move = [&](Cluster& c) {
    c.root->X_WL.p += shift;
    c.root->v += kick;
    state.of(c).moved = true;
  };
  add(model.clusters[head]);
  for (auto& t : model.tree)
    if (t.head == head) add(model.clusters[t.cluster]);
  shift = shift * (1 / mass);
  kick = kick * (1 / mass);
  move(model.clusters[head]);
  for (auto& t : model.tree)
    if (t.head == head) move(model.clusters[t.cluster]);
}

}  // namespace

void project_joints(const Scene& scene, StepState& state, Model& model) {
  if (model.tree.empty()) return;
  read_tree(state, model);
  for (auto& t : model.tree) {
    Cluster& c = model.clusters[t.cluster];
    if (c.asleep || c.root->kinematic) continue;
    place_branch(t, c);
    move_branch(t, c);
    state.of(c).moved = state.of(*t.joint).projected = true;
  }
  for (int head : model.tree_heads) keep_momentum(state, model, head, scene.settings.dt);
  for (auto& c : model.clusters)
    if (state.of(c).moved) {
      const Vec3 com = c.root->X_WL * c.com;
      set_body_pose(c.root->body, {com, c.root->X_WL.q});
      const Vec3 v = c.root->velocity_at(com);
      set_body_twist(c.root->body, v, c.root->w);
    }
}

namespace {

// Each cluster once, outwards along ODE joints.
class TreePlan {
 public:
  explicit TreePlan(Model& model) : model_(model), seen_(model.clusters.size(), false) {}

  void make() {
    for (size_t i = 0; i < model_.clusters.size(); ++i)
      if (!model_.clusters[i].root) visit(static_cast<int>(i));
    for (auto& j : model_.joints)
      if (j->joint && !j->parent && j->holds() && !seen_[j->child->cluster]) {
        model_.tree.push_back({j.get(), j->child->cluster, -1, true});
        visit(j->child->cluster);
      }
    grow(-1);
    for (size_t i = 0; i < model_.clusters.size(); ++i) {
      if (seen_[i]) continue;
      const size_t before = model_.tree.size();
      visit(static_cast<int>(i));
      grow(static_cast<int>(i));
      if (model_.tree.size() > before) model_.tree_heads.push_back(static_cast<int>(i));
    }
  }

 private:
  Model& model_;
  std::vector<bool> seen_;
  std::vector<int> queue_;
  size_t next_ = 0;

  void visit(int cluster) {
    seen_[cluster] = true;
    queue_.push_back(cluster);
  }

  std::vector<Joint*> joints_of(int cluster) const {
    std::vector<Joint*> joints;
    for (Link* l : model_.clusters[cluster].members)
      for (Joint* j : l->joints)
        if (j->joint && j->parent) joints.push_back(j);
    std::sort(joints.begin(), joints.end(), [](Joint* a, Joint* b) { return a->index < b->index; });
    return joints;
  }

  void grow(int head) {
    for (; next_ < queue_.size(); ++next_)
      for (Joint* j : joints_of(queue_[next_])) {
        const int child = j->child->cluster, parent = j->parent->cluster;
        const bool outward = parent == queue_[next_];
        const int other = outward ? child : parent;
        if (seen_[other]) continue;
        model_.tree.push_back({j, other, head, outward});
        visit(other);
      }
  }
};

}  // namespace

// The order in which project_joints goes: from what the world holds, else from the first link, outwards.
void plan_tree(Model& model) {
  model.tree.clear();
  model.tree_heads.clear();
  if (!model.links.empty()) TreePlan(model).make();
}

}  // namespace ode_sim
