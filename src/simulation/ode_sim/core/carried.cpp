// What hangs on links that servo joints move, and the forces that come from motion.
#include "ode_access.hpp"

#include <algorithm>
#include <cmath>

namespace ode_sim {

// ------------------------------------------------------------------------------------------------ carried clusters

void World::plan_carried() {
  replan_ = false;
  while (Model* model = try_plan_carried()) {
    model->loop = true;
    recluster(*model);
  }
}

// Finds what is carried by which link, outwards from what the world holds and from the base links. Returns a model in which two
// servo joints move the same cluster.
Model* World::try_plan_carried() {
  carried_.clear();
  // For each cluster: its links that something else hangs on, and what hangs there.
  std::map<const Cluster*, std::vector<std::pair<Link*, Link*>>> edges;
  auto add = [&](Link* a, Link* b) {
    edges[&cluster_of(*a)].push_back({a, b});
    edges[&cluster_of(*b)].push_back({b, a});
  };
  bool any = false;
  for (auto& m : models_) {
    for (auto& c : m->clusters) {
      c.by = c.at = nullptr;
      c.carry_v = c.carry_w = {};
      any |= c.root && c.moving && !c.carriers;
    }
  }
  if (!any) return nullptr;
  for (auto& m : models_)
    for (auto& j : m->joints)
      if (j->joint && j->parent) add(j->parent, j->child);
  for (auto& t : ties_)
    if (t.parent) add(t.parent.get(), t.child.get());

  // The link whose motion, given by servo joints, carries what hangs on `l`; null if none does.
  std::map<const Cluster*, Link*> mover;
  auto mover_of = [&](Link* l) -> Link* {
    const Cluster& c = cluster_of(*l);
    if (!c.root || c.carriers) return nullptr;
    if (!l->moving) return mover[&c];
    while (l->up->servo != ServoMode::Locked) l = l->up_link;
    return l;
  };
  std::vector<Cluster*> queue;
  std::set<const Cluster*> seen;
  auto visit = [&](Cluster& c) {
    if (seen.insert(&c).second) queue.push_back(&c);
  };
  size_t next = 0;
  Model* looped = nullptr;
  auto grow = [&] {
    for (; next < queue.size(); ++next) {
      const auto found = edges.find(queue[next]);
      if (found == edges.end()) continue;
      for (auto [by, at] : found->second) {
        Cluster& c = cluster_of(*at);
        if (&c == queue[next]) continue;
        Link* m = mover_of(by);
        if (seen.count(&c)) {
          if (!c.root || m == mover_of(at)) continue;
          for (Model* model : {by->model, at->model})
            if (!model->loop && model->has_servo) looped = model;
          continue;
        }
        visit(c);
        if (!c.root || c.carriers) continue;
        mover[&c] = at->moving ? at : m;
        if (!mover[&c]) continue;
        c.by = by;
        c.at = at;
        carried_.push_back(&c);
      }
    }
  };
  auto start = [&](auto wanted) {
    for (auto& m : models_)
      for (auto& c : m->clusters)
        if (wanted(c)) visit(c);
    grow();
  };
  start([](const Cluster& c) { return !c.root; });
  start([](const Cluster& c) { return c.root && c.root->parent_joint && !c.root->parent_joint->parent; });
  for (auto& m : models_)
    for (auto& c : m->clusters)
      if (c.root && !c.root->parent_joint) visit(c), grow();
  for (auto& m : models_)
    for (auto& c : m->clusters) visit(c), grow();
  return looped;
}

// True velocity of a carried cluster less that of its body, from the true velocities of what carries it.
void World::update_carry(Cluster& c) {
  const Link &root = *c.root, &by = *c.by, &at = *c.at;
  const dBodyID body = body_of(&by);
  const Vec3 p = root.X_WL * c.com;
  c.carry_w = by.w;
  c.carry_v = by.velocity_at(p);
  if (body) {  // else the world holds what carries it
    const Vec3 w = vec(dBodyGetAngularVel(body));
    c.carry_w = by.w - w;
    c.carry_v = by.velocity_at(p) - vec(dBodyGetLinearVel(body)) - cross(w, p - vec(dBodyGetPosition(body)));
  }
  if (!at.moving) return;
  c.carry_w = c.carry_w - (at.w - root.w);
  c.carry_v = c.carry_v - (at.velocity_at(p) - root.velocity_at(p));
}

// For a change of plan: bodies of carried clusters get their true velocities ...
void World::hold_true_velocities() {
  for (Cluster* c : carried_) {
    const dBodyID b = c->root->body;
    set_body_twist(b, vec(dBodyGetLinearVel(b)) + c->carry_v, vec(dBodyGetAngularVel(b)) + c->carry_w);
  }
  replan_ |= !carried_.empty();
  carried_.clear();
}

// ... and give up again what the new plan has them carried with.
void World::rebase_carried() {
  for (Cluster* c : carried_) {
    update_carry(*c);
    const dBodyID b = c->root->body;
    set_body_twist(b, vec(dBodyGetLinearVel(b)) - c->carry_v, vec(dBodyGetAngularVel(b)) - c->carry_w);
  }
}

// True velocities of the links of carried clusters.
void World::spread_carried() {
  for (Cluster* c : carried_) {
    Link& root = *c->root;
    if (c->at->moving) spread_twists(*c);
    update_carry(*c);
    root.w = vec(dBodyGetAngularVel(root.body)) + c->carry_w;
    root.v = vec(dBodyGetLinearVel(root.body)) + c->carry_v - cross(root.w, rotate(root.X_WL.q, c->com));
    spread_twists(*c);
  }
}

void World::keep_relations() {
  for (Cluster* c : carried_) {
    const Link &by = *c->by, &at = *c->at;
    const Quat q = conjugate(by.X_WL.q);
    c->X_by_at = inverse(by.X_WL) * at.X_WL;
    c->w_by_at = rotate(q, at.w - by.w);
    c->v_by_at = rotate(q, at.v - by.velocity_at(at.X_WL.p));
  }
}

// The servo joints have moved: what they carry moves along.
void World::carry_along() {
  for (Cluster* c : carried_) {
    Link& root = *c->root;
    const Link &by = *c->by, &at = *c->at;
    const Pose X_WA = by.X_WL * c->X_by_at;
    root.X_WL = normalized(X_WA * inverse(at.X_RL));
    root.w = by.w + rotate(by.X_WL.q, c->w_by_at);
    root.v = by.velocity_at(X_WA.p) + rotate(by.X_WL.q, c->v_by_at) + cross(root.w, root.X_WL.p - X_WA.p);
    place_cluster(*c);
    spread_twists(*c, false);
  }
}

// ------------------------------------------------------------------------------------------------ inertial forces

// Accelerations of the members from that of the root, the servo joints moving at their rates - and, with `servos`, changing them.
void World::member_accelerations(Cluster& c, bool servos) {
  for (Link* l : c.members) {
    const Vec3& p = l->X_WL.p;
    if (l == c.root) {
      const Vec3 r = p - l->X_WL * c.com;
      const Vec3 &alpha = servos ? c.alpha_all : c.alpha, &a = servos ? c.a_all : c.a;
      l->alpha = alpha;
      l->a = a + cross(alpha, r) + cross(l->w, cross(l->w, r));
      continue;
    }
    Vec3 w, alpha, a, from;
    if (l->up_link) w = l->up_link->w, alpha = l->up_link->alpha, a = l->up_link->a, from = l->up_link->X_WL.p;
    const Joint& j = *l->up;
    const Pose X_WJ = j.frame_W();
    Vec3 r = X_WJ.p - from;
    a += cross(alpha, r) + cross(w, cross(w, r));
    if (j.servo == ServoMode::Locked) {
      const Vec3 axis = rotate(X_WJ.q, j.axes[0].xyz) * (l == j.child ? 1.0 : -1.0);
      const Vec3 rate = axis * j.rate, change = axis * (servos ? (j.rate - j.previous_rate) / dt : 0.0);
      if (j.type == JointType::Revolute) alpha += cross(w, rate) + change;
      else a += cross(w, rate) * 2 + change;
    }
    r = p - X_WJ.p;
    l->alpha = alpha;
    l->a = a + cross(alpha, r) + cross(l->w, cross(l->w, r));
  }
}

// Accelerations of the clusters of a tree of ODE joints that come from its motion alone, with all joint accelerations zero.
// `servos`: with the servo joints of floating clusters moving, as they are, not standing still.
void World::accelerations(Model& model, bool servos) {
  for (auto& c : model.clusters) {
    (servos ? c.alpha_all : c.alpha) = (servos ? c.a_all : c.a) = {};
    if (c.moving && (servos || !c.root || c.carriers)) member_accelerations(c, servos);
  }
  for (auto& t : model.tree) {
    const Joint& j = *t.joint;
    Cluster& c = model.clusters[t.cluster];
    const Link* near = t.outward ? j.parent : j.child;
    const Pose X_WP = j.frame_W(), X_WC = j.child->X_WL * j.X_CJ;
    const Vec3 p = X_WC.p;
    Vec3 w, alpha, a;  // of the near link, at the joint
    if (near) {
      const Cluster& n = model.clusters[near->cluster];
      if (near->moving && (servos || near->carrier)) {
        const Vec3 r = p - near->X_WL.p;
        w = near->w;
        alpha = near->alpha;
        a = near->a + cross(alpha, r) + cross(w, cross(w, r));
      } else if (n.root) {
        const Vec3 r = p - n.root->X_WL * n.com;
        w = servos ? n.root->w : vec(dBodyGetAngularVel(n.root->body));
        alpha = servos ? n.alpha_all : n.alpha;
        a = (servos ? n.a_all : n.a) + cross(alpha, r) + cross(w, cross(w, r));
      }
    }
    const Vec3 first = rotate(X_WP.q, j.axes[0].xyz) * j.axes[0].qd;
    const double sign = t.outward ? 1 : -1;
    Vec3 turn;
    if (j.type == JointType::Revolute) {
      turn = first * sign;
      alpha += cross(w, turn);
    } else if (j.type == JointType::Prismatic) {
      a += cross(w, first) * (2 * sign);
    } else if (j.type == JointType::Universal) {
      const Vec3 second = rotate(X_WC.q, j.axes[1].xyz) * j.axes[1].qd;
      turn = (first + second) * sign;
      const Vec3 w_parent = t.outward ? w : w + turn;
      alpha += (cross(w_parent, first + second) + cross(first, second)) * sign;
    } else if (j.type == JointType::Ball) {
      turn = (t.outward ? j.child->w - w : j.parent->w - w);
      alpha = {};
    }
    w += turn;
    const Vec3 r = c.root->X_WL * c.com - p;
    (servos ? c.alpha_all : c.alpha) = alpha;
    (servos ? c.a_all : c.a) = a + cross(alpha, r) + cross(w, cross(w, r));
    if (c.moving && (servos || c.carriers)) member_accelerations(c, servos);
  }
}

void World::inertial_force(Cluster& c, const Vec3& a, const Vec3& alpha) {
  const Vec3 f = a * -c.mass;
  const Quat& q = c.root->X_WL.q;
  const Vec3 t = -rotate(q, c.inertia * rotate(conjugate(q), alpha));
  dBodyAddForce(c.root->body, f.x, f.y, f.z);
  dBodyAddTorque(c.root->body, t.x, t.y, t.z);
}

// Centrifugal and Coriolis forces. project_joints carries the joint speeds over to where the links are after the step, which
// turns the velocities of the links with them for nothing; this is what it takes.
void World::apply_inertial_forces(Model& model) {
  if (model.tree.empty()) return;
  accelerations(model, false);
  for (auto& t : model.tree) {
    Cluster& c = model.clusters[t.cluster];
    if (!c.asleep && !c.root->kinematic) inertial_force(c, c.a, c.alpha);
  }
}

// What servo joints of floating clusters carry feels that they move, as what hangs on a moving hand does; the cluster itself does
// not feel it (no recoil). A pass of the direct solver of its own, with the clusters moving as they do, whatever pulls.
void World::follow_servos() {
  bool any = false;
  for (auto& m : models_) {
    if (!m->has_servo || m->jump) continue;
    bool moving = false;
    for (auto& j : m->joints) moving |= j->servo == ServoMode::Locked && (j->rate != 0 || j->previous_rate != 0);
    if (moving) accelerations(*m, true);
    for (Cluster* c : carried_)
      if (c->root->model == m.get()) {
        if (!moving) c->a_all = c->a, c->alpha_all = c->alpha;
        any |= moving;
      }
  }
  if (!any || 6 * carried_.size() > kMostExactRows) return;

  // Every body that the pass may touch stays as it is, but for the velocities of the carried ones.
  std::set<const Model*> touched;
  for (Cluster* c : carried_) touched.insert({c->root->model, c->by->model});
  for (auto& t : ties_)
    for (Link* l : {t.parent.get(), t.child.get()})
      if (l) touched.insert(l->model);
  std::vector<Cluster*> all;
  for (auto& m : models_)
    if (touched.count(m.get()))
      for (auto& c : m->clusters)
        if (c.root) all.push_back(&c);
  std::vector<BodyState> start;
  for (Cluster* c : all) start.push_back(state_of(c->root->body));
  for (auto& m : models_)
    if (touched.count(m.get()))
      for (auto& l : m->links)
        if (l->carrier) start.push_back(state_of(l->body));
  std::vector<std::pair<dBodyID, dMass>> held;
  for (Cluster* c : all) {
    const dBodyID b = c->root->body;
    dBodySetForce(b, 0, 0, 0);
    dBodySetTorque(b, 0, 0, 0);
    if (c->by || c->root->kinematic) continue;
    dMass mass;
    dBodyGetMass(b, &mass);
    held.push_back({b, mass});
    dBodySetKinematic(b);
  }
  dWorldSetGravity(world_, 0, 0, 0);
  dWorldSetCFM(world_, 1e-18);  // what the joints give way to huge inertias here would be a recoil in the main pass
  for (Cluster* c : carried_) {
    const dBodyID b = c->root->body;
    dBodySetGyroscopicMode(b, 0);
    dBodyEnable(b);
    const Model& m = *c->root->model;
    if (!m.has_servo || m.jump) continue;
    inertial_force(*c, c->a_all - c->a, c->alpha_all - c->alpha);
    const Quat& q = c->root->X_WL.q;
    auto spin = [&](const Vec3& w) { return cross(w, rotate(q, c->inertia * rotate(conjugate(q), w))); };
    const Vec3 t = spin(vec(dBodyGetAngularVel(b))) - spin(c->root->w);
    dBodyAddTorque(b, t.x, t.y, t.z);
  }
  auto drive = [&](bool hold) {  // motors and brakes keep the speeds that there are
    for (auto& m : models_)
      if (touched.count(m.get()))
        for (auto& j : m->joints)
          if (j->joint)
            for (int i = 0; i < j->axis_count; ++i) set_limot(*j, i, dParamVel, hold ? j->axes[i].qd * j->sign : j->axes[i].drive);
  };
  drive(true);
  std::vector<std::string> said;
  const Listening listening(said);
  run(true, 0);
  drive(false);

  std::vector<std::pair<Vec3, Vec3>> result;
  for (Cluster* c : carried_) {
    const dBodyID b = c->root->body;
    result.push_back({vec(dBodyGetLinearVel(b)), vec(dBodyGetAngularVel(b))});
    dBodySetGyroscopicMode(b, 1);
  }
  for (auto& j : models_)
    for (auto& joint : j->joints)
      if (joint->watched && joint->joint && touched.count(j.get()) && (cluster_of(*joint->child).by || (joint->parent && cluster_of(*joint->parent).by))) {
        joint->carried_force = vec(joint->ode_feedback.f1);
        joint->carried_torque = vec(joint->ode_feedback.t1);
      }
  for (auto& [body, mass] : held) dBodySetMass(body, &mass);
  recall_bodies(start);
  for (auto& s : start) dBodyDisable(s.body);
  dWorldSetGravity(world_, gravity.x, gravity.y, gravity.z);
  dWorldSetCFM(world_, std::max(cfm, 1e-10));
  if (!said.empty()) return;
  for (size_t i = 0; i < carried_.size(); ++i)
    if (finite(result[i].first) && finite(result[i].second)) set_body_twist(carried_[i]->root->body, result[i].first, result[i].second);
  spread_carried();
}

}  // namespace ode_sim
