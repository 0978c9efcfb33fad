// Links that are rigidly joined at the moment: one ODE body each, and the ODE joints between them.
#include "ode_access.hpp"

#include <algorithm>
#include <cmath>

namespace ode_sim {

dBodyID World::body_of(const Link* link) const {
  if (!link || link->cluster < 0) return nullptr;
  if (link->carrier) return link->body;
  const Cluster& c = link->model->clusters[link->cluster];
  return c.root ? c.root->body : nullptr;
}

// Pose of the link in its body's frame; in the world when it has none.
Pose World::X_BL(const Link& link) const {
  if (link.carrier) return {};
  const Cluster& c = link.model->clusters[link.cluster];
  if (!c.root) return link.X_WL;
  return {link.X_RL.p - c.com, link.X_RL.q};
}

void World::refresh() {
  bool any = replan_;
  for (auto& m : models_) any |= m->dirty;
  if (!any) return;
  hold_true_velocities();
  for (auto& m : models_)
    if (m->dirty) {
      m->loop = false;
      recluster(*m);
    }
  plan_carried();
  rebase_carried();
}

void World::recluster(Model& model) {
  model.dirty = false;
  model.clusters.clear();
  model.has_servo = false;
  for (auto& l : model.links) {
    l->cluster = -1;
    l->up = nullptr;
    l->up_link = nullptr;
    l->moving = l->carrier = false;
  }
  for (auto& j : model.joints) model.has_servo |= j->servo != ServoMode::Off;

  auto join = [&](Cluster& c, Link* l) {
    l->cluster = static_cast<int>(model.clusters.size());
    c.members.push_back(l);
  };
  auto grow = [&](Cluster& c) {
    for (size_t i = 0; i < c.members.size(); ++i) {
      Link* at = c.members[i];
      for (Joint* j : at->joints) {
        if (!j->merged()) continue;
        Link* next = j->parent == at ? j->child : j->parent;
        if (!next || next->cluster >= 0) continue;
        next->up = j;
        next->up_link = at;
        next->moving = at->moving || j->servo == ServoMode::Locked;
        c.moving |= next->moving;
        join(c, next);
      }
    }
  };

  // What hangs rigidly from the world.
  Cluster anchored;
  if (model.is_static) {
    for (auto& l : model.links) {
      l->cluster = 0;
      l->X_RL = l->X_WL;
      anchored.members.push_back(l.get());
    }
  } else {
    for (auto& j : model.joints)
      if (!j->parent && j->merged() && j->child->cluster < 0 && !j->child->up) {
        j->child->up = j.get();
        j->child->moving = j->servo == ServoMode::Locked;
        anchored.moving |= j->child->moving;
        join(anchored, j->child);
      }
    grow(anchored);
  }
  if (!anchored.members.empty()) model.clusters.push_back(anchored);

  auto start = [&](Link* root) {
    Cluster c;
    c.root = root;
    join(c, root);
    grow(c);
    model.clusters.push_back(c);
  };
  // Roots: links that no merged joint holds as its child; then, for loops, whatever is left.
  for (auto& l : model.links) {
    if (l->cluster >= 0) continue;
    bool held = false;
    for (Joint* j : l->joints) held |= j->merged() && j->child == l.get();
    if (!held) start(l.get());
  }
  for (auto& l : model.links)
    if (l->cluster < 0) start(l.get());

  // An ODE joint on a link that servo joints move: where the world takes the reaction it hangs on that link's own body.
  auto carry = [&](Link& l) {
    Cluster& c = model.clusters[l.cluster];
    if (l.moving && (!c.root || model.loop)) l.carrier = c.carriers = true;
  };
  for (auto& j : model.joints)
    if (!j->merged())
      for (Link* l : {j->parent, j->child})
        if (l) {
          model.clusters[l->cluster].has_joints = true;
          carry(*l);
        }
  for (auto& t : ties_)
    for (Link* l : {t.parent.get(), t.child.get()})
      if (l && l->model == &model) carry(*l);

  for (auto& l : model.links)
    if (l->body) {
      dBodyDisable(l->body);
      dBodySetDynamic(l->body);
    }
  for (auto& c : model.clusters) {
    compose(c);
    place_cluster(c);
  }
  for (auto& j : model.joints)
    if (j->joint) dJointDestroy(j->joint), j->joint = nullptr;
  for (auto& j : model.joints)
    if (!j->merged()) install(*j);
  plan_tree(model);

  for (auto& l : model.links) {
    const bool fixed = !model.clusters[l->cluster].root && !l->moving;
    for (auto& s : l->shapes) {
      dGeomSetCategoryBits(s->geom, fixed ? 1 : 2);
      dGeomSetCollideBits(s->geom, fixed ? 2 : 3);
    }
    place_shapes(*l);
  }
}

// Poses of the members in the root frame from the joint positions, and the composite mass.
void World::compose(Cluster& c) {
  for (Link* l : c.members) {
    if (l == c.root) {
      l->X_RL = {};
      continue;
    }
    if (!l->up) continue;  // static model
    const Joint& j = *l->up;
    const Pose X_PC = j.X_PJ * j.motion(j.axes[0].q) * inverse(j.X_CJ);
    if (l == j.child)
      l->X_RL = normalized(j.parent ? j.parent->X_RL * X_PC : X_PC);
    else
      l->X_RL = normalized(j.child->X_RL * inverse(X_PC));
  }
  if (!c.root) return;
  c.mass = c.gravity_mass = 0;
  c.com = c.gravity_com = {};
  for (Link* l : c.members) {
    c.mass += l->mass;
    c.com += (l->X_RL * l->com) * l->mass;
    if (l->gravity) {
      c.gravity_mass += l->mass;
      c.gravity_com += (l->X_RL * l->com) * l->mass;
    }
  }
  c.com = c.com * (1 / c.mass);
  if (c.gravity_mass > 0) c.gravity_com = c.gravity_com * (1 / c.gravity_mass);
  c.uniform_gravity = c.gravity_mass == c.mass;
  c.inertia = {};
  for (Link* l : c.members) {
    c.inertia += rotate(l->X_RL.q, l->inertia);
    c.inertia += point_inertia(l->mass, l->X_RL * l->com - c.com);
  }
}

// Puts the cluster's body where its root link is, moving as the root link moves, with the composite mass.
void World::place_cluster(Cluster& c) {
  if (c.root) {
    Link& root = *c.root;
    dBodyID body = root.body;
    dMass m;
    const Sym3& I = c.inertia;
    dMassSetParameters(&m, c.mass, 0, 0, 0, I.xx, I.yy, I.zz, I.xy, I.xz, I.yz);
    dBodySetMass(body, &m);
    if (root.kinematic) dBodySetKinematic(body);
    const Vec3 arm = rotate(root.X_WL.q, c.com);
    set_body_pose(body, {root.X_WL.p + arm, root.X_WL.q});
    set_body_twist(body, root.v + cross(root.w, arm), root.w);
    dBodySetGravityMode(body, c.uniform_gravity && c.gravity_mass > 0);
    dBodySetLinearDamping(body, root.linear_decay);
    dBodySetAngularDamping(body, root.angular_decay);
  }
  spread_poses(c);
  for (Link* l : c.members)
    if (l->carrier) {
      dBodySetKinematic(l->body);
      set_body_pose(l->body, l->X_WL);
    }
}

void World::spread_poses(Cluster& c) {
  for (Link* l : c.members)
    if (l != c.root) l->X_WL = c.root ? normalized(c.root->X_WL * l->X_RL) : l->X_RL;
}

// Velocities of the members from that of the root and the commanded rates of the servo joints (or as if these stood still).
void World::spread_twists(Cluster& c, bool servos) {
  for (Link* l : c.members) {
    if (l == c.root) continue;
    Vec3 v, w, from;
    if (l->up_link) v = l->up_link->v, w = l->up_link->w, from = l->up_link->X_WL.p;
    v += cross(w, l->X_WL.p - from);
    if (servos && l->up && l->up->servo == ServoMode::Locked && l->up->rate != 0) {
      const Joint& j = *l->up;
      const Pose X_WJ = j.frame_W();
      const Vec3 rate = rotate(X_WJ.q, j.axes[0].xyz) * (l == j.child ? j.rate : -j.rate);
      if (j.type == JointType::Revolute) {
        w += rate;
        v += cross(rate, l->X_WL.p - X_WJ.p);
      } else {
        v += rate;
      }
    }
    l->v = v;
    l->w = w;
  }
}

void World::place_shapes(Link& link) {
  if (link.model->is_static) broad_phase_.static_moved();
  for (auto& s : link.shapes) {
    if (s->infinite) continue;  // stays where it was made
    const Pose X = link.X_WL * s->X_LC;
    const bool out_of_reach = !within(X.p, kOutOfReach);
    if (s->out_of_reach != out_of_reach) {
      s->out_of_reach = out_of_reach;
      out_of_reach ? dGeomDisable(s->geom) : dGeomEnable(s->geom);
    }
    if (out_of_reach) continue;
    const Quat q = s->field ? X.q * Quat{std::sqrt(0.5), 0, 0, std::sqrt(0.5)} : X.q;  // ODE's height fields have y up
    const dQuaternion r = {q.w, q.x, q.y, q.z};
    dGeomSetPosition(s->geom, X.p.x, X.p.y, X.p.z);
    dGeomSetQuaternion(s->geom, r);
  }
}

// Makes the ODE joint. Its anchor and zero are taken with the bodies put, for a moment, exactly as the joint at zero has
// them; then they go back to where they are, so that the joint feels every deviation.
void World::install(Joint& j) {
  dBodyID child = body_of(j.child), parent = body_of(j.parent);
  if (child == parent || (!child && !parent)) return;
  j.sign = child ? 1 : -1;
  dBodyID first = child ? child : parent, second = child ? parent : nullptr;
  const Pose X_CB_J = X_BL(*j.child) * j.X_CJ;  // joint frame in the child's body, or in the world
  const Pose X_PB_J = j.parent ? X_BL(*j.parent) * j.X_PJ : j.X_PJ;
  const Pose X_1J = child ? X_CB_J : X_PB_J, X_2J = child ? X_PB_J : X_CB_J;

  if (!j.joint) {
    switch (j.type) {
      case JointType::Revolute: j.joint = dJointCreateHinge(world_, nullptr); break;
      case JointType::Prismatic: j.joint = dJointCreateSlider(world_, nullptr); break;
      case JointType::Universal: j.joint = dJointCreateUniversal(world_, nullptr); break;
      case JointType::Ball: j.joint = dJointCreateBall(world_, nullptr); break;
      case JointType::Fixed: j.joint = dJointCreateFixed(world_, nullptr); break;
    }
    dJointAttach(j.joint, first, second);
    if (j.watched) {
      j.ode_feedback = kUnsolved;
      dJointSetFeedback(j.joint, &j.ode_feedback);
    }
  }

  const Posed posed(first, second, X_1J, X_2J);
  const Pose& X_WJ = X_2J;
  const Vec3 at = X_WJ.p, a0 = rotate(X_WJ.q, j.axes[0].xyz), a1 = rotate(X_WJ.q, j.axes[1].xyz);
  switch (j.type) {
    case JointType::Revolute:
      dJointSetHingeAnchor(j.joint, at.x, at.y, at.z);
      dJointSetHingeAxis(j.joint, a0.x, a0.y, a0.z);
      break;
    case JointType::Prismatic: dJointSetSliderAxis(j.joint, a0.x, a0.y, a0.z); break;
    case JointType::Universal: {
      const Vec3 f = child ? a1 : a0, s = child ? a0 : a1;
      dJointSetUniversalAnchor(j.joint, at.x, at.y, at.z);
      dJointSetUniversalAxis1(j.joint, f.x, f.y, f.z);
      dJointSetUniversalAxis2(j.joint, s.x, s.y, s.z);
      break;
    }
    case JointType::Ball: dJointSetBallAnchor(j.joint, at.x, at.y, at.z); break;
    case JointType::Fixed: dJointSetFixed(j.joint); break;
  }
  for (int i = 0; i < j.axis_count; ++i) {
    j.inverse_inertia[i] = axis_inverse_inertia(j, i);
    set_limot(j, i, dParamStopERP, j.stop_erp);
    set_limot(j, i, dParamStopCFM, std::max(j.stop_cfm, 1e-10));
    set_limot(j, i, dParamBounce, 0);
  }
}

double World::axis_inverse_inertia(const Joint& j, int axis) const {
  double sum = 0;
  for (Link* l : {j.child, j.parent}) {
    if (!l || l->carrier) continue;
    const Cluster& c = l->model->clusters[l->cluster];
    if (!c.root || c.root->kinematic) continue;
    if (j.type == JointType::Prismatic) {
      sum += 1 / c.mass;
    } else {
      const Quat q = l == j.child ? l->X_RL.q * j.X_CJ.q : l->X_RL.q * j.X_PJ.q;
      sum += inverse_along(c.inertia, rotate(q, j.axes[axis].xyz));
    }
  }
  return sum;
}

}  // namespace ode_sim
