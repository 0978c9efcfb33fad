// What a step has led to: joints, link poses, feedback.
#include "ode_access.hpp"

#include <algorithm>
#include <cmath>

namespace ode_sim {

void World::read_joint(Joint& j) {
  const Pose X_WJ = j.frame_W();
  const Pose X_J = inverse(X_WJ) * j.child->X_WL * j.X_CJ;
  const Vec3 vp = j.parent ? j.parent->velocity_at(j.child->X_WL * j.X_CJ.p) : Vec3{}, wp = j.parent ? j.parent->w : Vec3{};
  const Vec3 w = j.child->w - wp;
  auto turn = [&](Axis& a, double angle) {
    a.q = angle + 2 * kPi * std::round((a.q - angle) / (2 * kPi));
  };
  switch (j.type) {
    case JointType::Revolute: {
      Axis& a = j.axes[0];
      a.qd = dot(w, rotate(X_WJ.q, a.xyz));
      turn(a, 2 * std::atan2(dot({X_J.q.x, X_J.q.y, X_J.q.z}, a.xyz), X_J.q.w));
      break;
    }
    case JointType::Prismatic: {
      Axis& a = j.axes[0];
      a.q = dot(X_J.p, a.xyz);
      a.qd = dot(j.child->velocity_at(j.child->X_WL * j.X_CJ.p) - vp, rotate(X_WJ.q, a.xyz));
      break;
    }
    case JointType::Universal: {
      const Vec3 x = j.axes[0].xyz, y = j.axes[1].xyz, z = cross(x, y);
      const Vec3 cx = rotate(X_J.q, x), cy = rotate(X_J.q, y), cz = rotate(X_J.q, z);
      const Vec3 a0 = rotate(X_WJ.q, x), a1 = rotate((j.child->X_WL * j.X_CJ).q, y);
      j.axes[0].qd = dot(w, a0);
      j.axes[1].qd = dot(w, a1);
      turn(j.axes[0], std::atan2(dot(z, cy), dot(y, cy)));
      turn(j.axes[1], std::atan2(dot(x, cz), dot(x, cx)));
      break;
    }
    default: break;
  }
}

void World::read_feedback(Joint& j) {
  if (!j.watched || !j.joint) return;
  const dJointFeedback f = j.ode_feedback;
  j.ode_feedback = kUnsolved;
  const bool child_first = j.sign > 0;
  const Vec3 at = j.frame_W().p;
  const dBodyID first = dJointGetBody(j.joint, 0);
  const Vec3 force = vec(f.f1) + j.carried_force;
  const Vec3 torque = vec(f.t1) + j.carried_torque - cross(at - vec(dBodyGetPosition(first)), force);
  j.carried_force = j.carried_torque = {};
  if (!finite(force) || !finite(torque)) return;  // at rest, or the solver lost its way: that of the step before
  j.feedback.child_force = child_first ? force : -force;
  j.feedback.child_torque = child_first ? torque : -torque;
  j.feedback.parent_force = -j.feedback.child_force;
  j.feedback.parent_torque = -j.feedback.child_torque;
}

void World::momentum(const Load& load, Vec3& linear, Vec3& spin) const {
  linear = spin = {};
  for (const Link* l : load.links) {
    const Vec3 p = l->velocity_at(l->com_W()) * l->mass;
    linear += p;
    spin += rotate(l->X_WL.q, l->inertia * rotate(conjugate(l->X_WL.q), l->w)) + cross(l->com_W() - load.anchor, p);
  }
}

// A servo joint held exactly is no joint for ODE. What it bears follows from what is beyond: the change of its momentum less what
// else acts on it. Before the step ...
void World::weigh(Model& model) {
  for (auto& l : model.links) l->weighed = false;
  for (auto& j : model.joints) {
    Load& load = j->load_beyond;
    load.links.clear();
    if (!j->watched || j->servo != ServoMode::Locked) continue;
    bool loop = false;
    load.links = subtree(*j, &loop);
    if (loop) load.links.clear();
    load.anchor = j->frame_W().p;
    load.force = load.torque = {};
    momentum(load, load.momentum, load.spin);
    for (Link* l : load.links) {
      l->weighed = true;
      const Vec3 f = (l->gravity ? gravity * l->mass : Vec3{}) + l->force;
      load.force += f;
      load.torque += cross(l->com_W() - load.anchor, f) + l->torque;
    }
  }
}

// ... and after it.
void World::read_load(Joint& j) {
  const Load& load = j.load_beyond;
  if (!j.watched || j.servo != ServoMode::Locked) return;
  j.feedback = {};
  if (load.links.empty()) return;
  Vec3 linear, spin, force = load.force, torque = load.torque;
  momentum(load, linear, spin);
  auto beyond = [&](const Link* l) { return std::find(load.links.begin(), load.links.end(), l) != load.links.end(); };
  for (auto& c : contacts_) {
    const bool a = beyond(c.a->link), b = beyond(c.b->link);
    if (c.feedback < 0 || a == b) continue;
    const Vec3 f = vec(feedback_[c.feedback].f1) * ((c.swapped ? -1.0 : 1.0) * (a ? 1.0 : -1.0));
    force += f;
    torque += cross(c.pos - load.anchor, f);
  }
  for (auto& t : ties_) {
    const bool child = beyond(t.child.get()), parent = t.parent && beyond(t.parent.get());
    if (!t.joint || child == parent) continue;
    const bool first = child == (body_of(t.child.get()) != nullptr);  // whether ODE's first body is of the load
    const Vec3 f = vec(first ? t.feedback.f1 : t.feedback.f2), at = vec(dBodyGetPosition(dJointGetBody(t.joint, first ? 0 : 1)));
    force += f;
    torque += vec(first ? t.feedback.t1 : t.feedback.t2) + cross(at - load.anchor, f);
  }
  force = -force;
  torque = -torque;
  if (!j.model->jump) {
    force += (linear - load.momentum) * (1 / dt);
    torque += (spin - load.spin) * (1 / dt);
  }
  if (!finite(force) || !finite(torque)) return;
  j.feedback.child_force = force;
  j.feedback.child_torque = torque;
  j.feedback.parent_force = -j.feedback.child_force;
  j.feedback.parent_torque = -j.feedback.child_torque;
}

// Puts the links of a tree of ODE joints exactly where the joint angles say, moving as the joint speeds say, from what the
// world holds or the first link outwards. Bodies move along straight lines within a step, while their joints would have
// them on arcs. Left to ODE's correcting forces, that costs energy, fights with static friction (turning wheels scrub and
// carry uneven loads) and shows as gaping joints. What floats free keeps its centre of mass and its momentum.
void World::project_joints(Model& model) {
  if (model.tree.empty()) return;
  for (auto& c : model.clusters) c.moved = false;
  for (auto& t : model.tree) {
    read_joint(*t.joint);
    // A hard stop is where it is: nothing overshoots it, and nothing is thrown back by the correction.
    if (t.joint->stop_cfm <= 0 && t.joint->type != JointType::Universal)
      for (Axis& a : t.joint->axes) a.q = std::min(std::max(a.q, a.lower), a.upper);
  }
  for (auto& t : model.tree) {
    Joint& j = *t.joint;
    Cluster& c = model.clusters[t.cluster];
    if (c.asleep || c.root->kinematic) continue;
    Link &child = *j.child, &moved = t.outward ? child : *j.parent;
    Pose X_J = j.motion(j.axes[0].q);
    if (j.type == JointType::Universal)
      X_J.q = axis_angle(j.axes[0].xyz, j.axes[0].q) * axis_angle(j.axes[1].xyz, j.axes[1].q);
    else if (j.type == JointType::Ball)
      X_J.q = conjugate(j.frame_W().q) * child.X_WL.q * j.X_CJ.q;
    const Pose wanted = t.outward ? j.frame_W() * X_J * inverse(j.X_CJ)
                                  : child.X_WL * j.X_CJ * inverse(X_J) * inverse(j.X_PJ);
    c.root->X_WL = normalized(wanted * inverse(moved.X_RL));
    spread_poses(c);

    // Velocities: of the moved link, then of its root.
    const Pose X_WP = j.frame_W(), X_WC = child.X_WL * j.X_CJ;
    const Vec3 first = rotate(X_WP.q, j.axes[0].xyz) * j.axes[0].qd;
    Vec3 turn, slide;
    if (j.type == JointType::Revolute) turn = first;
    else if (j.type == JointType::Prismatic) slide = first;
    else if (j.type == JointType::Universal) turn = first + rotate(X_WC.q, j.axes[1].xyz) * j.axes[1].qd;
    Vec3 w, v;  // of the moved link, at the joint origin
    if (t.outward) {
      w = (j.parent ? j.parent->w : Vec3{}) + turn;
      v = (j.parent ? j.parent->velocity_at(X_WC.p) : Vec3{}) + slide;
    } else {
      w = child.w - turn;
      v = child.velocity_at(X_WC.p) - slide;
    }
    if (j.type == JointType::Ball) w = moved.w;
    // The cluster moves as the moved link does, less what servo joints inside do.
    c.root->w += w - moved.w;
    c.root->v += v + cross(w, moved.X_WL.p - X_WC.p) - moved.v + cross(w - moved.w, c.root->X_WL.p - moved.X_WL.p);
    spread_twists(c, c.carriers);
    c.moved = j.projected = true;
  }
  for (int head : model.tree_heads) {
    double mass = 0;
    Vec3 shift, kick;
    auto add = [&](const Cluster& c) {
      mass += c.mass;
      const Vec3 com = c.root->X_WL * c.com;
      shift += (vec(dBodyGetPosition(c.root->body)) - com) * c.mass;
      kick += (vec(dBodyGetLinearVel(c.root->body)) + c.a * dt - c.root->velocity_at(com)) * c.mass;
    };
    auto move = [&](Cluster& c) {
      c.root->X_WL.p += shift;
      c.root->v += kick;
      c.moved = true;
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
  for (auto& c : model.clusters)
    if (c.moved) {
      const Vec3 com = c.root->X_WL * c.com;
      set_body_pose(c.root->body, {com, c.root->X_WL.q});
      const Vec3 v = c.root->velocity_at(com);
      set_body_twist(c.root->body, v, c.root->w);
    }
}

// The order in which project_joints goes: from what the world holds, else from the first link, outwards, each cluster once.
void World::plan_tree(Model& model) {
  model.tree.clear();
  model.tree_heads.clear();
  std::vector<bool> seen(model.clusters.size(), false);
  std::vector<int> queue;
  size_t next = 0;
  auto grow = [&](int head) {
    for (; next < queue.size(); ++next) {
      std::vector<Joint*> joints;
      for (Link* l : model.clusters[queue[next]].members)
        for (Joint* j : l->joints)
          if (j->joint && j->parent) joints.push_back(j);
      std::sort(joints.begin(), joints.end(), [](Joint* a, Joint* b) { return a->index < b->index; });
      for (Joint* j : joints) {
        const int child = j->child->cluster, parent = j->parent->cluster;
        const bool outward = parent == queue[next];
        const int other = outward ? child : parent;
        if (seen[other]) continue;
        seen[other] = true;
        model.tree.push_back({j, other, head, outward});
        queue.push_back(other);
      }
    }
  };
  auto visit = [&](int cluster) {
    seen[cluster] = true;
    queue.push_back(cluster);
  };
  for (size_t i = 0; i < model.clusters.size(); ++i)
    if (!model.clusters[i].root) visit(static_cast<int>(i));
  for (auto& j : model.joints)
    if (j->joint && !j->parent && !seen[j->child->cluster]) {
      model.tree.push_back({j.get(), j->child->cluster, -1, true});
      visit(j->child->cluster);
    }
  grow(-1);
  for (size_t i = 0; i < model.clusters.size(); ++i) {
    if (seen[i]) continue;
    const size_t before = model.tree.size();
    visit(static_cast<int>(i));
    grow(static_cast<int>(i));
    if (model.tree.size() > before) model.tree_heads.push_back(static_cast<int>(i));
  }
}

void World::integrate_servos() {
  for (auto& m : models_)
    for (auto& j : m->joints) {
      if (j->servo == ServoMode::Off) continue;
      j->previous_target = j->target;
      if (j->servo != ServoMode::Locked) continue;
      Axis& a = j->axes[0];
      a.q = j->catching_up ? a.q + j->rate * dt : j->target;
      a.qd = j->rate;
    }
}

// Link poses and velocities from the bodies; without `servos`, velocities as the bodies have them: those of floating clusters as
// if servo joints stood still.
void World::pull(bool servos) {
  for (auto& m : models_)
    for (auto& c : m->clusters) {
      if (c.root) {
        const Pose X_WB = body_pose(c.root->body);
        Link& root = *c.root;
        root.X_WL = {X_WB.p - rotate(X_WB.q, c.com), X_WB.q};
        root.w = vec(dBodyGetAngularVel(root.body));
        root.v = vec(dBodyGetLinearVel(root.body)) + cross(root.w, root.X_WL.p - X_WB.p);
      }
      if (c.members.size() > 1 || !c.root) {
        spread_poses(c);
        spread_twists(c, servos || !c.root || c.carriers);
      }
    }
  if (servos) spread_carried();
}

// Shapes, joint readings and shared arrays from the links.
void World::publish() {
  for (auto& m : models_) {
    if (!m->finished) continue;
    for (auto& l : m->links) {
      if (l->cluster >= 0) {  // one that was spawned since the last step is in none: it is where it was put
        const Cluster& c = m->clusters[l->cluster];
        if (c.root ? !c.asleep : l->moving) place_shapes(*l);
      }
      double* row = link_poses->data() + 7 * l->row;
      const Pose& X = l->X_WL;
      row[0] = X.p.x; row[1] = X.p.y; row[2] = X.p.z;
      row[3] = X.q.x; row[4] = X.q.y; row[5] = X.q.z; row[6] = X.q.w;
    }
    for (auto& j : m->joints) {
      if (!j->merged() && !j->projected) read_joint(*j);
      j->projected = false;
      for (int i = 0; i < j->axis_count; ++i) {
        (*joint_positions)[j->row + i] = j->axes[i].q;
        (*joint_velocities)[j->row + i] = j->axes[i].qd;
      }
    }
  }
}

void World::read_back() {
  pull();
  publish();
}

}  // namespace ode_sim
