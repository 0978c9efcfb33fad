// The whole state as bytes, and back.
#include "ode_access.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace ode_sim {

namespace {
struct Writer {
  std::string out;
  template <class T> void operator()(T& value) { out.append(reinterpret_cast<const char*>(&value), sizeof value); }
};
struct Reader {
  const std::string& in;
  size_t at = 0;
  template <class T> void operator()(T& value) {
    if (at + sizeof value > in.size()) throw std::invalid_argument("the snapshot is of a world with other models");
    std::memcpy(reinterpret_cast<char*>(&value), in.data() + at, sizeof value);
    at += sizeof value;
  }
};

template <class F> void visit(F& f, Joint& j) {
  f(j.X_PJ); f(j.stop_erp); f(j.stop_cfm); f(j.servo); f(j.target); f(j.previous_target); f(j.rate); f(j.released);
  f(j.catching_up); f(j.multiplier); f(j.offset); f(j.watched); f(j.feedback);
  for (auto& a : j.axes) f(a);
}
template <class F> void visit(F& f, Link& l) {
  f(l.mass); f(l.com); f(l.inertia); f(l.gravity); f(l.kinematic); f(l.linear_decay); f(l.angular_decay);
  f(l.X_WL); f(l.v); f(l.w); f(l.force); f(l.torque); f(l.applied_force); f(l.applied_torque);
  for (auto& s : l.shapes) f(s->surface);
}
}  // namespace

std::string World::save() {
  refresh();
  Writer f;
  f(dt); f(gravity); f(erp); f(cfm); f(sor); f(contact_max_vel); f(surface_layer); f(iters); f(max_contacts);
  f(seed); f(iterations); f(time_ns);
  size_t count = ties_.size();
  f(next_tie_), f(count);
  for (auto& t : ties_) {
    int parent = t.parent ? t.parent->id : -1;
    f(t.id), f(parent), f(t.child->id), f(t.X_PC);
  }
  for (auto& m : models_) {
    f(m->id);
    f(m->take_exempt);
    size_t n = m->exempt.size();
    f(n);
    for (auto p : m->exempt) f(p.first), f(p.second);
    for (auto& j : m->joints) {
      visit(f, *j);
      int leader = j->leader ? j->leader->id : -1;
      f(leader);
    }
    for (auto& l : m->links) {
      visit(f, *l);
      if (!l->body) continue;
      // Straight from the body: setting a quaternion normalises it, which would cost the last bit.
      for (int i = 0; i < 3; ++i) f(dBodyGetPosition(l->body)[i]);
      for (int i = 0; i < 4; ++i) f(dBodyGetQuaternion(l->body)[i]);
      for (int i = 0; i < 12; ++i) f(dBodyGetRotation(l->body)[i]);
      for (int i = 0; i < 3; ++i) f(dBodyGetLinearVel(l->body)[i]), f(dBodyGetAngularVel(l->body)[i]);
    }
    for (auto& c : m->clusters) f(c.asleep), f(c.idle_steps), f(c.idle_time);
  }
  return f.out;
}

void World::restore(const std::string& data) {
  refresh();
  hold_true_velocities();
  Reader f{data};
  f(dt); f(gravity); f(erp); f(cfm); f(sor); f(contact_max_vel); f(surface_layer); f(iters); f(max_contacts);
  f(seed); f(iterations); f(time_ns);
  size_t count;
  f(next_tie_), f(count);
  ties_.assign(count, {});
  for (auto& t : ties_) {
    int parent, child;
    f(t.id), f(parent), f(child), f(t.X_PC);
    t.parent = find_link(parent);
    t.child = find_link(child);
    if (!t.child) throw std::invalid_argument("the snapshot is of a world with other models");
  }
  struct Raw {
    Link* link;
    dReal p[3], q[4], R[12], v[6];
  };
  std::vector<Raw> bodies;
  for (auto& m : models_) {
    int id;
    f(id);
    if (id != m->id) throw std::invalid_argument("the snapshot is of a world with other models");
    f(m->take_exempt);
    size_t n;
    f(n);
    m->exempt.clear();
    for (size_t i = 0; i < n; ++i) {
      std::pair<int, int> p;
      f(p.first), f(p.second);
      m->exempt.insert(p);
    }
    for (auto& j : m->joints) {
      visit(f, *j);
      int leader;
      f(leader);
      j->leader = nullptr;
      for (auto& o : m->joints)
        if (o->id == leader) j->leader = o.get();
    }
    for (auto& l : m->links) {
      visit(f, *l);
      if (!l->body) continue;
      Raw r;
      r.link = l.get();
      for (auto& x : r.p) f(x);
      for (auto& x : r.q) f(x);
      for (auto& x : r.R) f(x);
      for (auto& x : r.v) f(x);
      bodies.push_back(r);
    }
    m->loop = false;
    recluster(*m);
    for (auto& c : m->clusters) f(c.asleep), f(c.idle_steps), f(c.idle_time);
  }
  contacts_.clear();
  plan_carried();
  for (const Raw& r : bodies) {
    const dBodyID body = r.link->body;
    std::memcpy(const_cast<dReal*>(dBodyGetPosition(body)), r.p, sizeof r.p);
    std::memcpy(const_cast<dReal*>(dBodyGetQuaternion(body)), r.q, sizeof r.q);
    std::memcpy(const_cast<dReal*>(dBodyGetRotation(body)), r.R, sizeof r.R);
    dBodySetLinearVel(body, r.v[0], r.v[2], r.v[4]);
    dBodySetAngularVel(body, r.v[1], r.v[3], r.v[5]);
  }
  for (auto& m : models_)
    for (auto& j : m->joints) j->projected = true;  // not to be read from the poses, which would cost the last bit
  read_back();
  for (auto& m : models_)
    for (auto& l : m->links) place_shapes(*l);
}

}  // namespace ode_sim
