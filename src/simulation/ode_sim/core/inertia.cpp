// Forces that come from motion: of the joints, and of what position drives carry.
#include <algorithm>
#include <set>

#include "phases.hpp"

namespace ode_sim {

namespace {

Accelerations& of_com(StepState& state, const Cluster& c, bool drives) {
  return drives ? state.of(c).driven : state.of(c).still;
}

// Accelerations of the members from that of the root, the position drives moving at their rates - and, with `drives`, changing them.
void member_accelerations(StepState& state, Cluster& c, bool drives, double dt) {
  for (Link* l : c.members) {
    const Vec3& p = l->X_WL.p;
    Accelerations& own = state.of(*l).own;
    if (l == c.root) {
      const Vec3 r = p - l->X_WL * c.com;
      const auto& [alpha, a] = of_com(state, c, drives);
      own.alpha = alpha;
      own.a = a + cross(alpha, r) + cross(l->w, cross(l->w, r));
      continue;
    }
    Vec3 w, alpha, a, from;
    if (l->up_link) {
      const Accelerations& up = state.of(*l->up_link).own;
      w = l->up_link->w, alpha = up.alpha, a = up.a, from = l->up_link->X_WL.p;
    }
    const Joint& j = *l->up;
    const Pose X_WJ = j.frame_W();
    Vec3 r = X_WJ.p - from;
    a += cross(alpha, r) + cross(w, cross(w, r));
    if (j.drive == DriveMode::Locked) {
      const Vec3 axis = rotate(X_WJ.q, j.axes[0].xyz) * (l == j.child ? 1.0 : -1.0);
      const Vec3 rate = axis * j.rate, change = axis * (drives ? (j.rate - j.previous_rate) / dt : 0.0);
      if (j.slides() != 0) a += (cross(w, rate) * 2 + change) * j.slides();
      if (j.turns() != 0) alpha += cross(w, rate) + change;
    }
    r = p - X_WJ.p;
    own.alpha = alpha;
    own.a = a + cross(alpha, r) + cross(l->w, cross(l->w, r));
  }
}

// Of a link, at a point on it.
struct Moving {
  Vec3 w, alpha, a;
};

Moving near_side(StepState& state, const Link* near, const Vec3& p, bool drives) {
  if (!near) return {};
  const Cluster& n = cluster_of(*near);
  if (near->moving && (drives || near->carrier)) {
    const Vec3 r = p - near->X_WL.p;
    const auto& [alpha, a] = state.of(*near).own;
    return {near->w, alpha, a + cross(alpha, r) + cross(near->w, cross(near->w, r))};
  }
  if (!n.root) return {};
  const Vec3 r = p - n.root->X_WL * n.com;
  const Vec3 w = drives ? n.root->w : body_spin(n.root->body);
  const auto& [alpha, a] = of_com(state, n, drives);
  return {w, alpha, a + cross(alpha, r) + cross(w, cross(w, r))};
}

// Of what hangs on a ball joint, in the middle of the step if it goes on to change as in the last one: at that of the step's beginning,
// the forces of a spin about two axes feed energy to it. A jump is none that goes on.
Vec3 middle_spin(const Joint& j, const Link& far) {
  const Vec3 change = far.w - j.spin_before;
  return norm(change) < 0.1 * norm(far.w) ? far.w + change * 0.5 : far.w;
}

// What the joint's own speed adds on its far side.
void cross_joint(Moving& m, const Joint& j, bool outward, const Pose& X_WP, const Pose& X_WC) {
  const Vec3 first = rotate(X_WP.q, j.axes[0].xyz) * j.axes[0].qd;
  const double sign = outward ? 1 : -1;
  Vec3 turn;
  if (j.turns() != 0 || j.slides() != 0) {
    if (j.slides() != 0) m.a += cross(m.w, first) * (2 * sign * j.slides());
    if (j.turns() != 0) turn = first * sign;
    m.alpha += cross(m.w, turn);
  } else if (j.type == JointType::Universal) {
    const Vec3 second = rotate(X_WC.q, j.axes[1].xyz) * j.axes[1].qd;
    turn = (first + second) * sign;
    const Vec3 w_parent = outward ? m.w : m.w + turn;
    m.alpha += (cross(w_parent, first + second) + cross(first, second)) * sign;
  } else if (j.type == JointType::Ball) {
    turn = middle_spin(j, outward ? *j.child : *j.parent) - m.w;
    m.alpha = {};
  }
  m.w += turn;
}

// Accelerations of the clusters of a tree of ODE joints that come from its motion alone, with all joint accelerations zero.
// `drives`: with the position drives of floating clusters moving, as they are, not standing still.
void accelerations(StepState& state, Model& model, bool drives, double dt) {
  for (auto& c : model.clusters) {
    of_com(state, c, drives) = {};
    if (c.moving && (drives || !c.root || c.carriers)) member_accelerations(state, c, drives, dt);
  }
  for (auto& t : model.tree) {
    const Joint& j = *t.joint;
    Cluster& c = model.clusters[t.cluster];
    const Pose X_WP = j.frame_W(), X_WC = j.child_frame_W();
    const Vec3 p = X_WC.p;
    Moving m = near_side(state, t.outward ? j.parent : j.child, p, drives);
    cross_joint(m, j, t.outward, X_WP, X_WC);
    const Vec3 r = c.root->X_WL * c.com - p;
    of_com(state, c, drives) = {m.alpha, m.a + cross(m.alpha, r) + cross(m.w, cross(m.w, r))};
    if (c.moving && (drives || c.carriers)) member_accelerations(state, c, drives, dt);
  }
}

void inertial_force(Cluster& c, const Accelerations& of_com) {
  const Vec3 f = of_com.a * -c.mass;
  const Quat& q = c.root->X_WL.q;
  const Vec3 t = -rotate(q, c.inertia * rotate(conjugate(q), of_com.alpha));
  dBodyAddForce(c.root->body, f.x, f.y, f.z);
  dBodyAddTorque(c.root->body, t.x, t.y, t.z);
}

// The turning of the cluster's own axes of inertia, which ODE has as at the beginning of the step.
void turn_at_middle_spin(Joint& j, const Link& far, Cluster& c) {
  const Quat& q = c.root->X_WL.q;
  auto gyro = [&](const Vec3& w) { return cross(w, rotate(q, c.inertia * rotate(conjugate(q), w))); };
  const Vec3 now = body_spin(c.root->body), t = gyro(now) - gyro(now + middle_spin(j, far) - far.w);
  dBodyAddTorque(c.root->body, t.x, t.y, t.z);
  j.spin_before = far.w;
}

}  // namespace

// Centrifugal and Coriolis forces. project_joints carries the joint speeds over to where the links are after the step, which
// turns the velocities of the links with them for nothing; this is what it takes.
void apply_inertial_forces(const Scene& scene, StepState& state, Model& model) {
  if (model.tree.empty()) return;
  accelerations(state, model, false, scene.settings.dt);
  for (auto& t : model.tree) {
    Cluster& c = model.clusters[t.cluster];
    if (c.asleep || c.root->kinematic) continue;
    inertial_force(c, state.of(c).still);
    if (t.joint->type == JointType::Ball) turn_at_middle_spin(*t.joint, t.outward ? *t.joint->child : *t.joint->parent, c);
  }
}

// ------------------------------------------------------------------------------------------------ what drives carry

namespace {

// A pass of the direct solver of its own, in which only carried clusters move, and they as what carries them does, whatever pulls.
// Every other body stays as it is.
class CarryPass {
 public:
  explicit CarryPass(Scene& scene) : scene_(scene) {
    std::set<const Model*> touched;
    for (Cluster* c : scene.carried) touched.insert({c->root->model, c->by->model});
    for (auto& t : scene.welds)
      for (Link* l : {t.parent.get(), t.child.get()})
        if (l) touched.insert(l->model);
    for (auto& m : scene.models)
      if (touched.count(m.get())) models_.push_back(m.get());
  }

  void run(StepState& state) {
    hold_others();
    dWorldSetGravity(scene_.ode, 0, 0, 0);
    softness_ = dWorldGetCFM(scene_.ode);
    dWorldSetCFM(scene_.ode, 1e-18);  // what the joints give way to huge inertias here would be a recoil in the main pass
    for (Cluster* c : scene_.carried) push(*c, state);
    drive(state, true);
    std::vector<std::string> said;
    {
      const OdeScope scope(said);
      solver_pass(scene_, true, 0);
    }
    drive(state, false);
    std::vector<std::pair<Vec3, Vec3>> result;
    for (Cluster* c : scene_.carried) {
      const dBodyID b = c->root->body;
      result.push_back({body_velocity(b), body_spin(b)});
      dBodySetGyroscopicMode(b, 1);
    }
    read_feedback(state);
    release_others();
    if (!said.empty()) return;
    for (size_t i = 0; i < scene_.carried.size(); ++i)
      if (finite(result[i].first) && finite(result[i].second))
        set_body_twist(scene_.carried[i]->root->body, result[i].first, result[i].second);
    spread_carried(scene_);
  }

 private:
  Scene& scene_;
  std::vector<Model*> models_;  // that it may touch
  std::vector<BodyState> start_;
  std::vector<std::pair<dBodyID, dMass>> held_;
  double softness_ = 0;  // of joints, outside of this

  void hold_others() {
    for (Model* m : models_)
      for (auto& c : m->clusters)
        if (c.root) start_.push_back(state_of(c.root->body));
    for (Model* m : models_)
      for (auto& l : m->links)
        if (l->carrier) start_.push_back(state_of(l->body));
    for (Model* m : models_)
      for (auto& c : m->clusters) {
        if (!c.root) continue;
        const dBodyID b = c.root->body;
        dBodySetForce(b, 0, 0, 0);
        dBodySetTorque(b, 0, 0, 0);
        if (c.by || c.root->kinematic) continue;
        dMass mass;
        dBodyGetMass(b, &mass);
        held_.push_back({b, mass});
        dBodySetKinematic(b);
      }
  }

  void release_others() {
    for (auto& [body, mass] : held_) dBodySetMass(body, &mass);
    recall(start_);
    for (auto& s : start_) dBodyDisable(s.body);
    const Settings& set = scene_.settings;
    dWorldSetGravity(scene_.ode, set.gravity.x, set.gravity.y, set.gravity.z);
    dWorldSetCFM(scene_.ode, softness_);
  }

  // What the change of motion of the drives makes it feel.
  void push(Cluster& c, const StepState& state) {
    const dBodyID b = c.root->body;
    dBodySetGyroscopicMode(b, 0);
    dBodyEnable(b);
    const Model& m = *c.root->model;
    if (!m.has_drives || state.of(m).jump) return;
    const Accelerations &driven = state.of(c).driven, &still = state.of(c).still;
    inertial_force(c, {driven.alpha - still.alpha, driven.a - still.a});
    const Quat& q = c.root->X_WL.q;
    auto spin = [&](const Vec3& w) { return cross(w, rotate(q, c.inertia * rotate(conjugate(q), w))); };
    const Vec3 t = spin(body_spin(b)) - spin(c.root->w);
    dBodyAddTorque(b, t.x, t.y, t.z);
  }

  // Motors and brakes keep the speeds that there are, and get back those that they are to have.
  void drive(StepState& state, bool hold) {
    for (Model* m : models_)
      for (auto& j : m->joints)
        if (j->joint)
          for (int i = 0; i < j->driven_axes(); ++i)
            set_limot(*j, i, dParamVel, hold ? j->axes[i].qd * j->sign : state.of(*j).speed[i]);
  }

  void read_feedback(StepState& state) {
    for (Model* m : models_)
      for (auto& j : m->joints)
        if (j->watched && j->joint && (cluster_of(*j->child).by || (j->parent && cluster_of(*j->parent).by))) {
          state.of(*j).carried_force = vec(j->ode_feedback.f1);
          state.of(*j).carried_torque = vec(j->ode_feedback.t1);
        }
  }
};

}  // namespace

// What position drives of floating clusters carry feels that they move, as what hangs on a moving hand does; the cluster itself does
// not feel it (no recoil).
void follow_drives(Scene& scene, StepState& state) {
  if (scene.carried.empty()) return;
  bool any = false;
  for (auto& m : scene.models) {
    if (!m->has_drives || state.of(*m).jump) continue;
    bool moving = false;
    for (auto& j : m->joints) moving |= j->drive == DriveMode::Locked && (j->rate != 0 || j->previous_rate != 0);
    if (moving) accelerations(state, *m, true, scene.settings.dt);
    for (Cluster* c : scene.carried)
      if (c->root->model == m.get()) {
        if (!moving) state.of(*c).driven = state.of(*c).still;
        any |= moving;
      }
  }
  if (any && 6 * scene.carried.size() <= kMostExactRows) CarryPass(scene).run(state);
}

}  // namespace ode_sim
