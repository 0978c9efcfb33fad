// Collisions of shapes, and contact joints with the rules of Gazebo Classic.
#include "ode_access.hpp"

#include <algorithm>
#include <cmath>

namespace ode_sim {

namespace {

constexpr double kFlat = 0.005;    // rad: a wheel that is tilted by less stands on its whole tread
constexpr double kOneEdge = 1e-5;  // m along the axis, within which contacts are those of one edge

// ODE loses a cylinder that has come deeper into a box than the box is thick, as what falls on a floor of a centimetre does within
// two steps. It is still on the side on which its middle is. Contacts of cylinder `g` and `box` through the box's thinnest side,
// normals towards the cylinder. :returns: how many, at most 8
int contacts_through(dGeomID g, dGeomID box, dContactGeom* found) {
  dVector3 sides;
  dGeomBoxGetLengths(box, sides);
  const int k = static_cast<int>(std::min_element(sides, sides + 3) - sides);
  dReal radius, length;
  dGeomCylinderGetParams(g, &radius, &length);
  const dReal *R = dGeomGetRotation(box), *Q = dGeomGetRotation(g);
  const Vec3 middle = vec(dGeomGetPosition(g)), to_middle = middle - vec(dGeomGetPosition(box));
  Vec3 n{R[k], R[4 + k], R[8 + k]};
  if (dot(n, to_middle) < 0) n = -n;
  if (dot(n, to_middle) < 0.5 * sides[k]) return 0;
  const Vec3 axis{Q[2], Q[6], Q[10]};
  const Vec3 down = axis * dot(n, axis) - n;
  dVector3 p, q;
  const dReal along[3] = {axis.x, axis.y, axis.z};
  dPlaneSpace(along, p, q);
  std::vector<Vec3> rim;
  if (norm(down) > 0.01) rim = {down * (1 / norm(down))};
  else rim = {vec(p), -vec(p), vec(q), -vec(q)};
  int count = 0;
  for (const Vec3& out : rim)
    for (double end : {-0.5, 0.5}) {
      const Vec3 at = middle + out * radius + axis * (end * length), off = at - vec(dGeomGetPosition(box));
      const double depth = 0.5 * sides[k] - dot(n, off);
      bool beside = depth <= 0;
      for (int i = 0; i < 3; ++i)
        if (i != k) beside = beside || std::abs(dot(off, Vec3{R[i], R[4 + i], R[8 + i]})) > 0.5 * sides[i];
      if (beside) continue;
      dContactGeom& c = found[count++];
      c.pos[0] = at.x, c.pos[1] = at.y, c.pos[2] = at.z;
      c.normal[0] = n.x, c.normal[1] = n.y, c.normal[2] = n.z;
      c.depth = depth;
    }
  return count;
}

// What ODE's collider misses.
int missed_contacts(dGeomID ga, dGeomID gb, dContactGeom* found) {
  if (dGeomGetClass(ga) == dCylinderClass && dGeomGetClass(gb) == dBoxClass) return contacts_through(ga, gb, found);
  if (dGeomGetClass(gb) != dCylinderClass || dGeomGetClass(ga) != dBoxClass) return 0;
  const int n = contacts_through(gb, ga, found);
  for (int i = 0; i < n; ++i)
    for (dReal& x : found[i].normal) x = -x;
  return n;
}

}  // namespace

// ------------------------------------------------------------------------------------------------ collisions

bool World::allowed(const Shape& a, const Shape& b) const {
  const Link &la = *a.link, &lb = *b.link;
  if (&la == &lb) return false;
  if (!(a.surface.collide_bitmask & b.surface.collide_bitmask)) return false;
  const Cluster &ca = la.model->clusters[la.cluster], &cb = lb.model->clusters[lb.cluster];
  const bool still_a = !ca.root ? !la.moving : ca.asleep, still_b = !cb.root ? !lb.moving : cb.asleep;
  if (still_a && still_b) return false;
  if (la.model == lb.model) {
    if (!la.self_collide && !lb.self_collide) return false;
    if (la.cluster == lb.cluster && !la.moving && !lb.moving) return false;
    if (la.model->jointed.count(std::minmax(la.id, lb.id))) return false;
  }
  return !tied(la, lb);
}

void World::collide() {
  contacts_.clear();
  pairs_.clear();
  broad_phase_.find(pairs_);
  for (auto& [a, b] : pairs_)
    if (a->id > b->id) std::swap(a, b);
  pairs_.erase(std::remove_if(pairs_.begin(), pairs_.end(), [&](const auto& p) { return !allowed(*p.first, *p.second); }), pairs_.end());
  // The sweep tells pairs in an order that depends on its history.
  std::sort(pairs_.begin(), pairs_.end(),
            [](auto& p, auto& q) { return std::make_pair(p.first->id, p.second->id) < std::make_pair(q.first->id, q.second->id); });
  dContactGeom found[250];
  for (auto& [a, b] : pairs_) {
    dGeomID ga = a->geom, gb = b->geom;
    // ODE has no collider for two cylinders, or a cylinder and a capsule: one of them goes in as a faceted mesh.
    const int ta = dGeomGetClass(ga), tb = dGeomGetClass(gb);
    Shape* stand_in = nullptr;
    if (ta == dCylinderClass && (tb == dCylinderClass || tb == dCapsuleClass)) stand_in = a;
    else if (tb == dCylinderClass && ta == dCapsuleClass) stand_in = b;
    if (stand_in && stand_in->faceted) {
      dGeomSetPosition(stand_in->faceted, dGeomGetPosition(stand_in->geom)[0], dGeomGetPosition(stand_in->geom)[1],
                       dGeomGetPosition(stand_in->geom)[2]);
      dGeomSetRotation(stand_in->faceted, dGeomGetRotation(stand_in->geom));
      (stand_in == a ? ga : gb) = stand_in->faceted;
    }
    int n = 0;
    try {
      n = std::min(dCollide(ga, gb, 250, found, sizeof found[0]), 250);
      if (n == 0 && !like_gazebo) n = missed_contacts(ga, gb, found);
    } catch (const OdeFailure& failure) {
      report(std::string(failure.what()) + "; they do not touch in this step",
             a->link->model == b->link->model ? a->link->model->name : a->link->model->name + " and " + b->link->model->name);
    }
    const int most = std::min({max_contacts, a->max_contacts, b->max_contacts});
    if (n > most) {
      std::stable_sort(found, found + n, [](auto& p, auto& q) { return p.depth > q.depth; });
      n = std::max(most, 0);
    }
    const size_t first = contacts_.size();
    for (int i = 0; i < n; ++i) {
      Contact c;
      c.a = a;
      c.b = b;
      c.pos = vec(found[i].pos);
      c.normal = vec(found[i].normal);
      c.depth = found[i].depth;
      const double length = norm(c.normal);
      if (!finite(c.pos) || !std::isfinite(c.depth) || !(length > 0.5)) continue;
      c.normal = c.normal * (1 / length);
      contacts_.push_back(c);
    }
    for (const Shape* wheel : {a, b})
      if (wheel->wheel && !like_gazebo) merge_tread(*wheel, first);
    const int kept = static_cast<int>(contacts_.size() - first);
    for (size_t i = first; i < contacts_.size(); ++i) contacts_[i].count = kept;
  }
  counters.contacts = contacts_.size();
}

// How deep a point lies in a shape with flat sides, m; far outside of any other shape.
static double depth_in(dGeomID g, const Vec3& p) {
  switch (dGeomGetClass(g)) {
    case dPlaneClass: return dGeomPlanePointDepth(g, p.x, p.y, p.z);
    case dBoxClass: return dGeomBoxPointDepth(g, p.x, p.y, p.z);
    default: return -kInf;
  }
}

// A description that says 3.14 or 1.57 tilts its wheels by a milliradian: no tyre stands on one edge for that.
void World::lay_flat(const Shape& wheel, const Vec3& axis, Contact& c) const {
  const double off = dot(axis, wheel.link->X_WL * (wheel.X_LC * wheel.tread) - c.pos), tilt = std::abs(dot(axis, c.normal));
  const Shape& other = c.a == &wheel ? *c.b : *c.a;
  const Vec3 middle = c.pos + axis * off;
  if (tilt >= kFlat || depth_in(other.geom, middle) < -2 * tilt * std::abs(off) - kOneEdge) return;
  c.pos = middle;
  c.depth = std::max(c.depth - tilt * std::abs(off), 0.0);
  c.merged = std::max(c.merged, 2);  // both edges
}

// A wheel touches with the middle of its tread. ODE gives a contact at either edge; a robot that turns would then pivot on
// one of them (two rings under dry friction leave it open on which), and its effective track be off by the tread's width.
void World::merge_tread(const Shape& wheel, size_t first) {
  const Vec3 axis = rotate(wheel.link->X_WL.q * wheel.X_LC.q, wheel.axle);
  size_t kept = first;
  for (size_t i = first; i < contacts_.size(); ++i) {
    Contact c = contacts_[i];
    if (std::abs(dot(c.normal, axis)) < 0.1) {
      double low = dot(axis, c.pos), high = low;
      for (size_t k = contacts_.size() - 1; k > i; --k) {
        const Contact& other = contacts_[k];
        if (dot(other.normal, c.normal) < 0.999) continue;
        const double at = dot(axis, other.pos);
        low = std::min(low, at);
        high = std::max(high, at);
        if (other.depth > c.depth) c.depth = other.depth, c.pos = other.pos;
        c.merged += other.merged;
        contacts_.erase(contacts_.begin() + k);
      }
      c.pos += axis * ((low + high) / 2 - dot(axis, c.pos));
      if (wheel.mesh) c.merged = std::min(c.merged, 2);
      if (high - low < kOneEdge) lay_flat(wheel, axis, c);
    }
    contacts_[kept++] = c;
  }
  contacts_.resize(kept);
}

// ------------------------------------------------------------------------------------------------ contacts

void World::make_contact_joints() {
  feedback_.clear();
  gazebo_contacts_.clear();
  auto wanted = [](const Contact& c) { return c.a->watched || c.b->watched || c.a->link->weighed || c.b->link->weighed; };
  for (auto& m : models_) m->contact_count = 0, m->touches_others = false;
  for (auto& c : contacts_) {
    Model &a = *c.a->link->model, &b = *c.b->link->model;
    a.contact_count += c.merged;
    b.contact_count += c.merged;
    if (&a != &b && !a.is_static && !b.is_static) a.touches_others = b.touches_others = true;
  }
  feedback_.resize(contacts_.size());
  size_t next = 0;
  // The body that a contact acts on. None where a kinematic one would not feel it: it connects nothing with anything.
  auto pushed = [&](const Link& l) -> dBodyID {
    const Cluster& c = cluster_of(l);
    return c.root && !c.root->kinematic ? c.root->body : nullptr;
  };
  for (auto& c : contacts_) {
    if (c.a->surface.collide_without_contact || c.b->surface.collide_without_contact) continue;
    dBodyID ba = pushed(*c.a->link), bb = pushed(*c.b->link);
    if (ba == bb) continue;
    c.swapped = !ba;  // ODE's contact motion is only well defined with a first body
    if (c.swapped) std::swap(ba, bb);
    dContact d{};
    const Vec3 n = c.swapped ? -c.normal : c.normal;
    d.geom.pos[0] = c.pos.x; d.geom.pos[1] = c.pos.y; d.geom.pos[2] = c.pos.z;
    d.geom.normal[0] = n.x; d.geom.normal[1] = n.y; d.geom.normal[2] = n.z;
    set_stiffness(c, d);
    const Vec3 t1 = set_friction(c, n, d);
    d.fdir1[0] = t1.x; d.fdir1[1] = t1.y; d.fdir1[2] = t1.z;
    set_surface_speed(c, n, t1, ba, bb, d);
    c.joint = dJointCreateContact(world_, contact_group_, &d);
    dJointAttach(c.joint, ba, bb);
    if (like_gazebo) {
      c.row = static_cast<int>(gazebo_contacts_.size());
      gazebo_contacts_.push_back(d);
    }
    c.told = wanted(c);
    c.feedback = static_cast<int>(next);
    dJointSetFeedback(c.joint, &feedback_[next++]);
  }
}

// How hard the contact is, and how fast overlap is undone.
void World::set_stiffness(Contact& c, dContact& d) const {
  // Resting contacts must persist, or friction is lost every other step: this much overlap (m) is left alone.
  constexpr double slack = 2e-5, deep = 0.01;
  const Surface &sa = c.a->surface, &sb = c.b->surface;
  const double kp = sa.kp > 0 && sb.kp > 0 ? 1 / (1 / sa.kp + 1 / sb.kp) : 0;
  const double soft = dt * kp + sa.kd + sb.kd;
  const double soft_erp = soft > 0 ? dt * kp / soft : erp;
  d.surface.mode = dContactMu2 | dContactSoftERP | dContactSoftCFM | dContactApprox1 | dContactFDir1 | dContactBounce |
                   dContactSlip1 | dContactSlip2;
  d.surface.soft_erp = soft_erp;
  d.surface.bounce = std::min(sa.restitution, sb.restitution);
  d.surface.bounce_vel = std::min(sa.bounce_threshold, sb.bounce_threshold);
  double fastest = contact_max_vel;
  for (double v : {sa.max_vel, sb.max_vel})
    if (v >= 0) fastest = std::min(fastest, v);
  c.fastest = fastest;
  const double allowed = std::min(sa.min_depth, sb.min_depth);
  if (like_gazebo) {
    d.surface.soft_cfm = soft > 0 ? 1 / soft : 1e-9;
    d.geom.depth = std::max(c.depth - allowed, 0.0);
    return;
  }
  double inverse_mass = 0;
  for (const Link* l : {c.a->link, c.b->link})
    if (!l->model->is_static) inverse_mass += 1 / l->model->mass;
  // A merged contact is as hard as those that it stands for.
  d.surface.soft_cfm = std::max(soft > 0 ? 1 / soft : 1e-9, contact_softness * dt * inverse_mass) / c.merged;

  // Depth beyond the tolerated one, cut so that it is corrected no faster than allowed, and no faster than gravity brings back
  // what is pushed out: it would fly. What was put deep into the floor comes out just that fast. What the model's own weight
  // presses in at this stiffness is no error to correct: cut as well, it would carry less than the weight, which then sinks
  // and sinks.
  double depth = std::max(c.depth - std::max(allowed, slack), 0.0);
  const double g = norm(gravity), comes_back = std::sqrt(2 * g * depth);
  if (g > 0) fastest = std::min(fastest, std::max(comes_back, 0.01));
  const bool one_is_fixed = c.a->link->model->is_static != c.b->link->model->is_static;
  if (depth > deep && one_is_fixed && (c.a->link->model->is_static ? dot(c.normal, gravity) : -dot(c.normal, gravity)) > 0.7 * g)
    fastest = std::max(fastest, 0.9 * std::sqrt(2 * g * (depth - deep)));
  const double pressed_in = kp > 0 && inverse_mass > 0 ? g / (inverse_mass * kp) : 0;
  if (soft_erp > 0) depth = std::min(depth, fastest * dt / soft_erp + pressed_in);
  d.geom.depth = depth;
}

// Surface speed that the bodies do not have: links moved by servo joints, and kinematic ones.
void World::set_surface_speed(const Contact& c, const Vec3& n, const Vec3& t1, dBodyID first, dBodyID second, dContact& d) {
  const Link *l1 = c.a->link, *l2 = c.b->link;
  if (c.swapped) std::swap(l1, l2);
  auto driven = [&](const Link* l) {
    const Cluster& k = cluster_of(*l);
    return l->moving || (k.root && k.root->kinematic) || (k.by && !cluster_of(*k.by).root->model->jump);
  };
  const bool driven1 = driven(l1), driven2 = driven(l2);
  if (!driven1 && !driven2) return;
  auto slide = [&](const Link* l, dBodyID body) {
    Vec3 u = l->velocity_at(c.pos);
    if (body) u = u - (vec(dBodyGetLinearVel(body)) + cross(vec(dBodyGetAngularVel(body)), c.pos - vec(dBodyGetPosition(body))));
    return u;
  };
  const Vec3 u = (driven1 ? slide(l1, first) : Vec3{}) - (driven2 ? slide(l2, second) : Vec3{});
  d.surface.mode |= dContactMotion1 | dContactMotion2 | dContactMotionN;
  d.surface.motion1 = -dot(t1, u);
  d.surface.motion2 = -dot(cross(n, t1), u);
  d.surface.motionN = -dot(n, u);
}

std::vector<ContactRecord> World::contact_records() {
  std::vector<ContactRecord> out;
  out.reserve(contacts_.size());
  for (auto& c : contacts_) {
    ContactRecord r{};
    r.collision1 = c.a->id;
    r.collision2 = c.b->id;
    r.position[0] = c.pos.x; r.position[1] = c.pos.y; r.position[2] = c.pos.z;
    r.normal[0] = c.normal.x; r.normal[1] = c.normal.y; r.normal[2] = c.normal.z;
    r.depth = c.depth;
    if (c.told && c.feedback >= 0 && c.feedback < static_cast<int>(feedback_.size())) {
      // ODE gives what acts on its first body about that body's CoM; here: on the first link, about its CoM.
      const dJointFeedback& f = feedback_[c.feedback];
      Vec3 force = c.swapped ? -vec(f.f1) : vec(f.f1);
      Vec3 torque = cross(c.pos - c.a->link->com_W(), force);
      if (!finite(force) || !finite(torque)) force = torque = {};  // the solver lost its way: nothing is known
      r.force[0] = force.x; r.force[1] = force.y; r.force[2] = force.z;
      r.torque[0] = torque.x; r.torque[1] = torque.y; r.torque[2] = torque.z;
    }
    out.push_back(r);
  }
  return out;
}

}  // namespace ode_sim
