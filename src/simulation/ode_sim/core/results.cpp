// What a step has led to: link poses, shapes, joints, shared arrays.
#include <cmath>

#include "phases.hpp"

namespace ode_sim {

// Link poses and velocities from the bodies; without `drives`, velocities as the bodies have them: those of floating clusters as
// if position drives stood still.
void pull(Scene& scene, bool drives) {
  for (auto& m : scene.models)
    for (auto& c : m->clusters) {
      if (c.root) {
        const Pose X_WB = body_pose(c.root->body);
        Link& root = *c.root;
        root.X_WL = {X_WB.p - rotate(X_WB.q, c.com), X_WB.q};
        root.w = body_spin(root.body);
        root.v = body_velocity(root.body) + cross(root.w, root.X_WL.p - X_WB.p);
      }
      if (c.members.size() > 1 || !c.root) {
        spread_poses(c);
        spread_twists(c, drives || !c.root || c.carriers);
      }
    }
  if (drives) spread_carried(scene);
}

void place_shapes(Scene& scene, Link& link) {
  if (link.model->is_static) scene.broad_phase.static_moved();
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

namespace {

void publish_link(Scene& scene, const Model& m, Link& l) {
  if (l.cluster >= 0) {  // one that was spawned since the last step is in none: it is where it was put
    const Cluster& c = m.clusters[l.cluster];
    if (c.root ? !c.asleep : l.moving) place_shapes(scene, l);
  }
  double* row = scene.link_poses->data() + 7 * l.row;
  const Pose& X = l.X_WL;
  row[0] = X.p.x;
  row[1] = X.p.y;
  row[2] = X.p.z;
  row[3] = X.q.x;
  row[4] = X.q.y;
  row[5] = X.q.z;
  row[6] = X.q.w;
}

}  // namespace

void publish(Scene& scene, const std::function<bool(const Joint&)>& known) {
  for (auto& m : scene.models) {
    if (!m->finished) continue;
    for (auto& l : m->links) publish_link(scene, *m, *l);
    for (auto& j : m->joints) {
      if (!j->merged() && !known(*j)) read_joint(*j);
      for (int i = 0; i < j->axis_count; ++i) {
        (*scene.joint_positions)[j->row + i] = j->axes[i].q;
        (*scene.joint_velocities)[j->row + i] = j->axes[i].qd;
      }
    }
  }
  if (!scene.bonds) return;
  for (auto& j : scene.bonds->joints)  // not in the arrays
    if (!known(*j)) read_joint(*j);
}

void read_back(Scene& scene) {
  pull(scene);
  publish(scene, [](const Joint&) { return false; });
}

}  // namespace ode_sim
