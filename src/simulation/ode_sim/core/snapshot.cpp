// The whole state as bytes, and back.
//
// What is read becomes a Plan, which checks it all, before anything is taken over. What is refused has changed nothing.
#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "phases.hpp"

namespace ode_sim {

namespace {

constexpr uint64_t kVersion = 0x396d69735f65646full;  // "ode_sim9"; counts up when what is written changes

uint64_t digest(const char* data, size_t size) {  // FNV-1a
  uint64_t h = 0xcbf29ce484222325ull;
  for (size_t i = 0; i < size; ++i) h = (h ^ static_cast<unsigned char>(data[i])) * 0x100000001b3ull;
  return h;
}

[[noreturn]] void refuse(const char* why) {
  throw std::invalid_argument(std::string("the snapshot cannot be restored: ") + why);
}

constexpr const char* kOtherModels = "it is of a world with other models";

// A number is written as it is; a flag as one byte.
struct Writer {
  static constexpr bool reads = false;
  std::string out;
  template <class T>
  void number(T& v) {
    out.append(reinterpret_cast<const char*>(&v), sizeof v);
  }
  void flag(bool& v) { out.push_back(v ? 1 : 0); }
  void same(int v, const char*) { number(v); }
};

struct Reader {
  static constexpr bool reads = true;
  const std::string& in;
  const bool commit;  // else values are looked at and left alone
  size_t at = 0, end = 0;
  template <class T>
  T next() {
    T v;
    if (end - at < sizeof v) refuse("it is incomplete");
    std::memcpy(&v, in.data() + at, sizeof v);
    at += sizeof v;
    return v;
  }
  template <class T>
  void number(T& v) {
    const T read = next<T>();
    if constexpr (std::is_floating_point_v<T>)
      if (std::isnan(read)) refuse("it holds a number that is none");
    if (commit) v = read;
  }
  void flag(bool& v) {
    const auto read = next<unsigned char>();
    if (read > 1) refuse("it is damaged");
    if (commit) v = read;
  }
  void same(int v, const char* why) {
    if (next<int>() != v) refuse(why);
  }
};

template <class F>
void visit(F& f, Vec3& v) {
  f.number(v.x), f.number(v.y), f.number(v.z);
}
template <class F>
void visit(F& f, Pose& X) {
  visit(f, X.p);
  f.number(X.q.x), f.number(X.q.y), f.number(X.q.z), f.number(X.q.w);
}
template <class F>
void visit(F& f, Sym3& m) {
  f.number(m.xx), f.number(m.yy), f.number(m.zz), f.number(m.xy), f.number(m.xz), f.number(m.yz);
}
template <class F>
void visit(F& f, Surface& s) {
  for (double* v : {&s.mu, &s.mu2, &s.slip1, &s.slip2, &s.kp, &s.kd, &s.max_vel, &s.min_depth, &s.restitution,
                    &s.bounce_threshold, &s.torsional_mu, &s.torsional_slip, &s.patch_radius, &s.surface_radius})
    f.number(*v);
  f.flag(s.use_patch_radius);
  visit(f, s.fdir1);
  f.number(s.collide_bitmask);
  f.flag(s.collide_without_contact);
}
template <class F>
void visit(F& f, Axis& a) {
  visit(f, a.xyz);
  for (double* v :
       {&a.lower, &a.upper, &a.effort, &a.velocity, &a.damping, &a.friction, &a.spring_reference, &a.spring_stiffness, &a.q,
        &a.qd, &a.force, &a.applied, &a.motor_velocity, &a.motor_force, &a.law, &a.slope, &a.law_bound})
    f.number(*v);
  f.flag(a.commanded);
}
template <class F>
void visit(F& f, Feedback& b) {
  for (Vec3* v : {&b.child_force, &b.child_torque, &b.parent_force, &b.parent_torque}) visit(f, *v);
}
template <class F>
void visit(F& f, DriveMode& mode) {
  int value = static_cast<int>(mode);
  if constexpr (F::reads) {
    value = f.template next<int>();
    if (value < 0 || value > 2) refuse("it is damaged");
    if (f.commit) mode = static_cast<DriveMode>(value);
  } else {
    f.number(value);
  }
}
template <class F>
void visit(F& f, Joint& j) {
  f.same(j.id, kOtherModels);
  f.same(j.axis_count, kOtherModels);
  visit(f, j.X_PJ);
  f.number(j.q_RJ.x), f.number(j.q_RJ.y), f.number(j.q_RJ.z), f.number(j.q_RJ.w);
  visit(f, j.drive);
  for (double* v : {&j.thread_pitch, &j.gear_ratio, &j.stop_erp, &j.stop_cfm, &j.target, &j.previous_target, &j.rate,
                    &j.multiplier, &j.offset})
    f.number(*v);
  f.number(j.released);
  f.flag(j.catching_up);
  f.flag(j.watched);
  visit(f, j.feedback);
  visit(f, j.spin_before);
  for (auto& a : j.axes) visit(f, a);
  for (double& v : j.borne) f.number(v);
}
template <class F>
void visit(F& f, Link& l) {
  f.same(l.id, kOtherModels);
  f.same(static_cast<int>(l.shapes.size()), kOtherModels);
  f.number(l.mass);
  visit(f, l.com);
  visit(f, l.inertia);
  f.flag(l.gravity), f.flag(l.kinematic);
  f.number(l.linear_decay), f.number(l.angular_decay);
  visit(f, l.X_WL);
  for (Vec3* v : {&l.v, &l.w, &l.force, &l.torque, &l.applied_force, &l.applied_torque}) visit(f, *v);
  for (auto& s : l.shapes) {
    f.same(s->id, kOtherModels);
    visit(f, s->surface);
  }
  // Straight from the body: setting a quaternion normalises it, which would cost the last bit.
  if (!l.body) return;
  auto all = [&](const dReal* values, int n) {
    for (int i = 0; i < n; ++i) f.number(const_cast<dReal*>(values)[i]);
  };
  all(dBodyGetPosition(l.body), 3);
  all(dBodyGetQuaternion(l.body), 4);
  all(dBodyGetRotation(l.body), 12);
  all(dBodyGetLinearVel(l.body), 3);
  all(dBodyGetAngularVel(l.body), 3);
}

// Those that a snapshot tells of: that of joints which came while the world ran is none of them while there are no such joints.
std::vector<Model*> told(const Scene& scene) {
  std::vector<Model*> models;
  for (auto& m : scene.models)
    if (m != scene.bonds || !m->joints.empty()) models.push_back(m.get());
  return models;
}

// All that a snapshot holds, in its order, but for what depends on the plan of clusters: see restore.
template <class F>
void walk(F& f, Scene& scene) {
  Settings& set = scene.settings;
  for (double* v : {&set.dt, &set.gravity.x, &set.gravity.y, &set.gravity.z, &set.erp, &set.cfm, &set.sor, &set.contact_max_vel,
                    &set.surface_layer})
    f.number(*v);
  f.flag(set.like_gazebo);
  f.number(set.iters), f.number(set.max_contacts), f.number(set.seed), f.number(scene.iterations), f.number(scene.time_ns);
  const std::vector<Model*> models = told(scene);
  f.same(static_cast<int>(models.size()), kOtherModels);
  for (Model* m : models) {
    f.same(m->id, kOtherModels);
    f.same(static_cast<int>(m->joints.size()), kOtherModels);
    f.same(static_cast<int>(m->links.size()), kOtherModels);
    f.flag(m->take_exempt);
    f.number(m->emerging);
    f.flag(m->loop);
    for (auto& j : m->joints) visit(f, *j);
    for (auto& l : m->links) visit(f, *l);
  }
}

// What refers from one thing to another, or belongs to a cluster; whole lists of it are replaced.
struct Relations {
  struct SavedWeld {
    int parent, child;
    Pose X_PC;
    dJointFeedback feedback;  // of the last step in which it was solved for; what is at rest still bears it
  };
  struct Rest {
    bool asleep = false;
    int steps = 0;
    double time = 0;
    Vec3 carry_v, carry_w;
  };
  std::vector<SavedWeld> welds;
  std::vector<Borne> borne;
  std::vector<std::vector<std::pair<int, int>>> exempt;  // of each model
  std::map<int, int> leaders;                            // joint -> joint
  std::map<int, Rest> rest;                              // of the cluster with this root link
};

template <class F, class List>
void visit_size(F& f, List& list, size_t least_bytes) {
  uint64_t n = list.size();
  if constexpr (F::reads) {
    n = f.template next<uint64_t>();
    if (n > (f.end - f.at) / least_bytes) refuse("it is incomplete");
    list.resize(n);
  } else {
    f.number(n);
  }
}

template <class F>
void visit(F& f, Relations& r) {
  visit_size(f, r.borne, sizeof(int));
  for (auto& b : r.borne) f.number(b.a), f.number(b.b), visit(f, b.pos), f.number(b.normal);
  visit_size(f, r.welds, sizeof(int));
  for (auto& t : r.welds) {
    f.number(t.parent), f.number(t.child);
    visit(f, t.X_PC);
    for (dReal* v : {t.feedback.f1, t.feedback.t1, t.feedback.f2, t.feedback.t2})
      for (int i = 0; i < 3; ++i) f.number(v[i]);
  }
  visit_size(f, r.exempt, sizeof(uint64_t));
  for (auto& pairs : r.exempt) {
    visit_size(f, pairs, sizeof(int));
    for (auto& p : pairs) f.number(p.first), f.number(p.second);
  }
  std::vector<std::pair<int, int>> leaders(r.leaders.begin(), r.leaders.end());
  visit_size(f, leaders, sizeof(int));
  for (auto& l : leaders) f.number(l.first), f.number(l.second);
  std::vector<std::pair<int, Relations::Rest>> rest(r.rest.begin(), r.rest.end());
  visit_size(f, rest, sizeof(int));
  for (auto& [root, c] : rest) {
    f.number(root), f.flag(c.asleep), f.number(c.steps), f.number(c.time);
    visit(f, c.carry_v), visit(f, c.carry_w);
  }
  if constexpr (F::reads) {
    r.leaders = {leaders.begin(), leaders.end()};
    r.rest = {rest.begin(), rest.end()};
  }
}

Relations relations_of(const Scene& scene) {
  Relations r;
  r.borne = scene.borne;
  for (auto& t : scene.welds) r.welds.push_back({t.parent ? t.parent->id : -1, t.child->id, t.X_PC, t.feedback});
  for (const Model* m : told(scene)) {
    r.exempt.emplace_back(m->exempt.begin(), m->exempt.end());
    for (auto& j : m->joints)
      if (const auto leader = j->leader.lock()) r.leaders[j->id] = leader->id;
    for (auto& c : m->clusters)
      if (c.root) r.rest[c.root->id] = {c.asleep, c.idle_steps, c.idle_time, c.carry_v, c.carry_w};
  }
  return r;
}

// Where what is written of the state ends, if the frame around it is whole.
size_t checked_frame(const std::string& data) {
  uint64_t version = 0, sum = 0;
  if (data.size() < sizeof version + sizeof sum) refuse("it is incomplete");
  std::memcpy(&version, data.data(), sizeof version);
  if (version != kVersion) refuse("another version of the simulator wrote it");
  const size_t end = data.size() - sizeof sum;
  std::memcpy(&sum, data.data() + end, sizeof sum);
  if (sum != digest(data.data(), end)) refuse("it is damaged");
  return end;
}

// A snapshot that was read, and fits this world: taking it over refuses nothing.
class Plan {
 public:
  Plan(Scene& scene, const std::string& data, const std::vector<int>& weld_ids)
      : scene_(scene), data_(data), end_(checked_frame(data)) {
    Reader look{data, false, sizeof kVersion, end_};
    walk(look, scene);
    Reader look_on{data, true, look.at, end_};
    visit(look_on, relations_);
    if (look_on.at != end_) refuse("it is too long");
    if (relations_.welds.size() != weld_ids.size()) refuse("it does not name its attachments");
    const std::vector<Model*> models = told(scene);
    if (relations_.exempt.size() != models.size()) refuse(kOtherModels);
    for (Model* m : models) {
      for (auto& l : m->links) links_[l->id] = l;
      for (auto& j : m->joints) joints_[j->id] = j;
    }
    for (size_t i = 0; i < relations_.welds.size(); ++i) {
      const auto& t = relations_.welds[i];
      if (!links_.count(t.child) || (t.parent != -1 && !links_.count(t.parent))) refuse(kOtherModels);
      welds_.push_back({weld_ids[i], t.parent == -1 ? nullptr : links_[t.parent], links_[t.child], t.X_PC, t.feedback});
    }
    for (auto& [follower, leader] : relations_.leaders)
      if (!joints_.count(follower) || !joints_.count(leader)) refuse(kOtherModels);
  }

  void carry_out() {
    read_numbers();
    scene_.welds = std::move(welds_);
    scene_.borne = std::move(relations_.borne);
    for (auto& [id, joint] : joints_) {
      const auto leader = relations_.leaders.find(id);
      joint->leader = leader == relations_.leaders.end() ? std::weak_ptr<Joint>() : joints_[leader->second];
    }
    // Putting clusters together places their bodies; where these truly were comes from the snapshot once more, afterwards.
    const std::vector<Model*> models = told(scene_);
    for (size_t i = 0; i < models.size(); ++i) {
      Model& m = *models[i];
      m.exempt = {relations_.exempt[i].begin(), relations_.exempt[i].end()};
      judge_masses(m);
      if (&m != scene_.bonds.get()) assemble(scene_, m);
    }
    if (scene_.bonds) assemble(scene_, *scene_.bonds);
    plan_carried(scene_);
    put_to_rest();
    read_numbers();
    // Links are not read from the bodies, nor joints from the links: either would cost the last bit.
    for (auto& m : scene_.models)
      for (auto& l : m->links) place_shapes(scene_, *l);
    publish(scene_, [](const Joint&) { return true; });
  }

 private:
  Scene& scene_;
  const std::string& data_;
  const size_t end_;
  Relations relations_;
  std::map<int, std::shared_ptr<Link>> links_;
  std::map<int, std::shared_ptr<Joint>> joints_;
  std::vector<Weld> welds_;

  void read_numbers() {
    Reader take{data_, true, sizeof kVersion, end_};
    walk(take, scene_);
  }

  void put_to_rest() {
    for (auto& m : scene_.models)
      for (auto& c : m->clusters) {
        const auto rest = c.root ? relations_.rest.find(c.root->id) : relations_.rest.end();
        if (rest == relations_.rest.end()) continue;
        c.asleep = rest->second.asleep;
        c.idle_steps = rest->second.steps;
        c.idle_time = rest->second.time;
        c.carry_v = rest->second.carry_v;
        c.carry_w = rest->second.carry_w;
      }
  }
};

}  // namespace

std::string save(Scene& scene) {
  refresh(scene);
  Relations r = relations_of(scene);
  Writer f;
  uint64_t version = kVersion;
  f.number(version);
  walk(f, scene);
  visit(f, r);
  uint64_t sum = digest(f.out.data(), f.out.size());
  f.number(sum);
  return f.out;
}

// `weld_ids`: the numbers of the welds in the snapshot.
void restore(Scene& scene, const std::string& data, const std::vector<int>& weld_ids) {
  Plan(scene, data, weld_ids).carry_out();
}

}  // namespace ode_sim
