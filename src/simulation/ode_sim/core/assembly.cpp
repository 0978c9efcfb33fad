// Links that are rigidly joined at the moment: one ODE body each, and the ODE joints between them.
#include <algorithm>

#include "phases.hpp"

namespace ode_sim {

namespace {

// What the clusters follow from is forgotten.
void take_apart(Model& model) {
  model.dirty = false;
  model.clusters.clear();
  model.has_drives = false;
  for (auto& l : model.links) {
    l->cluster = -1;
    l->up = nullptr;
    l->up_link = nullptr;
    l->moving = l->carrier = false;
  }
  for (auto& j : model.joints) model.has_drives |= j->drive != DriveMode::Off;
}

void join(const Model& model, Cluster& c, Link* l) {
  l->cluster = static_cast<int>(model.clusters.size());
  c.members.push_back(l);
}

// Everything that merged joints hold to the members.
void grow(const Model& model, Cluster& c) {
  for (size_t i = 0; i < c.members.size(); ++i) {
    Link* at = c.members[i];
    for (Joint* j : at->joints) {
      if (!j->merged()) continue;
      Link* next = j->parent == at ? j->child : j->parent;
      if (!next || next->cluster >= 0) continue;
      next->up = j;
      next->up_link = at;
      next->moving = at->moving || j->drive == DriveMode::Locked;
      c.moving |= next->moving;
      join(model, c, next);
    }
  }
}

// What hangs rigidly from the world.
void gather_anchored(Model& model) {
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
        j->child->moving = j->drive == DriveMode::Locked;
        anchored.moving |= j->child->moving;
        join(model, anchored, j->child);
      }
    grow(model, anchored);
  }
  if (!anchored.members.empty()) model.clusters.push_back(anchored);
}

// Roots: links that no merged joint holds as its child; then, for loops, whatever is left.
void gather_floating(Model& model) {
  auto start = [&](Link* root) {
    Cluster c;
    c.root = root;
    join(model, c, root);
    grow(model, c);
    model.clusters.push_back(c);
  };
  for (auto& l : model.links) {
    if (l->cluster >= 0) continue;
    bool held = false;
    for (Joint* j : l->joints) held |= j->merged() && j->child == l.get();
    if (!held) start(l.get());
  }
  for (auto& l : model.links)
    if (l->cluster < 0) start(l.get());
}

// An ODE joint on a link that position drives move: where the world takes the reaction it hangs on that link's own body.
void find_carriers(const Scene& scene, Model& model) {
  auto carry = [&](Link& l) {
    Cluster& c = model.clusters[l.cluster];
    if (l.moving && (!c.root || model.loop)) l.carrier = c.carriers = true;
  };
  const auto hang = [&](const Model& from) {
    for (auto& j : from.joints)
      if (!j->merged())
        for (Link* l : {j->parent, j->child})
          if (l && l->model == &model) {
            model.clusters[l->cluster].has_joints = true;
            carry(*l);
          }
  };
  hang(model);
  if (scene.bonds) hang(*scene.bonds);
  for (auto& t : scene.welds)
    for (Link* l : {t.parent.get(), t.child.get()})
      if (l && l->model == &model) carry(*l);
}

}  // namespace

dBodyID body_of(const Link* link) {
  if (!link || link->cluster < 0) return nullptr;
  if (link->carrier) return link->body;
  const Cluster& c = cluster_of(*link);
  return c.root ? static_cast<dBodyID>(c.root->body) : nullptr;
}

Pose X_BL(const Link& link) {
  if (link.carrier) return {};
  const Cluster& c = cluster_of(link);
  if (!c.root) return link.X_WL;
  return {link.X_RL.p - c.com, link.X_RL.q};
}

void assemble(Scene& scene, Model& model) {
  take_apart(model);
  gather_anchored(model);
  gather_floating(model);
  find_carriers(scene, model);
  for (auto& l : model.links)
    if (l->body) {
      dBodyDisable(l->body);
      dBodySetDynamic(l->body);
    }
  for (auto& c : model.clusters) {
    compose(c);
    place_cluster(c);
  }
  for (auto& j : model.joints) j->joint.reset();
  for (auto& j : model.joints)
    if (!j->merged()) install(scene, *j);
  plan_tree(model);
  for (auto& l : model.links) {
    const bool fixed = !cluster_of(*l).root && !l->moving;
    for (auto& s : l->shapes) {
      dGeomSetCategoryBits(s->geom, fixed ? 1 : 2);
      dGeomSetCollideBits(s->geom, fixed ? 2 : 3);
    }
    place_shapes(scene, *l);
  }
}

namespace {

void place_members(Cluster& c) {
  for (Link* l : c.members) {
    if (l == c.root) {
      l->X_RL = {};
      continue;
    }
    if (!l->up) continue;  // static model
    const Joint& j = *l->up;
    const Pose X_PC = j.X_PJ * j.motion(j.axes[0].q) * inverse(j.X_CJ);
    if (l == j.child) l->X_RL = normalized(j.parent ? j.parent->X_RL * X_PC : X_PC);
    else l->X_RL = normalized(j.child->X_RL * inverse(X_PC));
  }
}

}  // namespace

void compose(Cluster& c) {
  place_members(c);
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

void place_cluster(Cluster& c) {
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

void spread_poses(Cluster& c) {
  for (Link* l : c.members)
    if (l != c.root) l->X_WL = c.root ? normalized(c.root->X_WL * l->X_RL) : l->X_RL;
}

// Velocities of the members from that of the root and the commanded rates of the position drives (or as if these stood still).
void spread_twists(Cluster& c, bool drives) {
  for (Link* l : c.members) {
    if (l == c.root) continue;
    Vec3 v, w, from;
    if (l->up_link) v = l->up_link->v, w = l->up_link->w, from = l->up_link->X_WL.p;
    v += cross(w, l->X_WL.p - from);
    if (drives && l->up && l->up->drive == DriveMode::Locked && l->up->rate != 0) {
      const Joint& j = *l->up;
      const Pose X_WJ = j.frame_W();
      const Vec3 rate = rotate(X_WJ.q, j.axes[0].xyz) * (l == j.child ? j.rate : -j.rate);
      if (j.turns() != 0) {
        w += rate;
        v += cross(rate, l->X_WL.p - X_WJ.p);
      }
      if (j.slides() != 0) v += rate * j.slides();
    }
    l->v = v;
    l->w = w;
  }
}

}  // namespace ode_sim
