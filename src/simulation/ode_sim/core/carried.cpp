// What hangs on links that position drives move, see cluster.hpp.
#include <map>
#include <set>

#include "phases.hpp"

namespace ode_sim {

namespace {

// Finds what is carried by which link, outwards from what the world holds and from the base links.
class CarryPlan {
 public:
  explicit CarryPlan(Scene& scene) : scene_(scene) {}

  // Returns a model in which two position drives move the same cluster, null if there is none.
  Model* make() {
    if (!forget()) return nullptr;
    find_edges();
    start([](const Cluster& c) { return !c.root; });
    start([](const Cluster& c) { return c.root && c.root->parent_joint && !c.root->parent_joint->parent; });
    for (auto& m : scene_.models)
      for (auto& c : m->clusters)
        if (c.root && !c.root->parent_joint) visit(c), grow();
    for (auto& m : scene_.models)
      for (auto& c : m->clusters) visit(c), grow();
    return looped_;
  }

 private:
  Scene& scene_;
  // For each cluster: its links that something else hangs on, and what hangs there.
  std::map<const Cluster*, std::vector<std::pair<Link*, Link*>>> edges_;
  std::map<const Cluster*, Link*> mover_;
  std::vector<Cluster*> queue_;
  std::set<const Cluster*> seen_;
  size_t next_ = 0;
  Model* looped_ = nullptr;

  // Whether anything floats that position drives move: else nothing is carried.
  bool forget() {
    scene_.carried.clear();
    bool any = false;
    for (auto& m : scene_.models)
      for (auto& c : m->clusters) {
        c.by = c.held = nullptr;
        c.carry_v = c.carry_w = {};
        any |= c.root && c.moving && !c.carriers;
      }
    return any;
  }

  void add(Link* a, Link* b) {
    edges_[&cluster_of(*a)].push_back({a, b});
    edges_[&cluster_of(*b)].push_back({b, a});
  }

  void find_edges() {
    for (auto& m : scene_.models)
      for (auto& j : m->joints)
        if (j->joint && j->parent && j->holds()) add(j->parent, j->child);
    for (auto& t : scene_.welds)
      if (t.parent) add(t.parent.get(), t.child.get());
  }

  // The link whose motion, given by position drives, carries what hangs on `l`; null if none does.
  Link* mover_of(Link* l) {
    const Cluster& c = cluster_of(*l);
    if (!c.root || c.carriers) return nullptr;
    if (!l->moving) return mover_[&c];
    while (l->up->drive != DriveMode::Locked) l = l->up_link;
    return l;
  }

  void visit(Cluster& c) {
    if (seen_.insert(&c).second) queue_.push_back(&c);
  }

  template <class Wanted>
  void start(Wanted wanted) {
    for (auto& m : scene_.models)
      for (auto& c : m->clusters)
        if (wanted(c)) visit(c);
    grow();
  }

  void grow() {
    for (; next_ < queue_.size(); ++next_) {
      const auto found = edges_.find(queue_[next_]);
      if (found == edges_.end()) continue;
      for (auto [by, held] : found->second)
        if (&cluster_of(*held) != queue_[next_]) follow(by, held);
    }
  }

  void follow(Link* by, Link* held) {
    Cluster& c = cluster_of(*held);
    Link* m = mover_of(by);
    if (seen_.count(&c)) {
      if (!c.root || m == mover_of(held)) return;
      for (Model* model : {by->model, held->model})
        if (!model->loop && model->has_drives) looped_ = model;
      return;
    }
    visit(c);
    if (!c.root || c.carriers) return;
    mover_[&c] = held->moving ? held : m;
    if (!mover_[&c]) return;
    c.by = by;
    c.held = held;
    scene_.carried.push_back(&c);
  }
};

// True velocity of a carried cluster less that of its body, from the true velocities of what carries it.
void update_carry(Cluster& c) {
  const Link &root = *c.root, &by = *c.by, &held = *c.held;
  const dBodyID body = body_of(&by);
  const Vec3 p = root.X_WL * c.com;
  c.carry_w = by.w;
  c.carry_v = by.velocity_at(p);
  if (body) {  // else the world holds what carries it
    const Vec3 w = body_spin(body);
    c.carry_w = by.w - w;
    c.carry_v = by.velocity_at(p) - body_velocity(body) - cross(w, p - vec(dBodyGetPosition(body)));
  }
  if (!held.moving) return;
  c.carry_w = c.carry_w - (held.w - root.w);
  c.carry_v = c.carry_v - (held.velocity_at(p) - root.velocity_at(p));
}

}  // namespace

void plan_carried(Scene& scene) {
  scene.replan = false;
  while (Model* model = CarryPlan(scene).make()) {
    model->loop = true;
    assemble(scene, *model);
  }
}

void refresh(Scene& scene) {
  look_for_changes(scene);
  std::vector<Model*> fresh;
  for (auto& m : scene.models)
    if (m->dirty) fresh.push_back(m.get());
  reassemble(scene);
  for (Model* m : fresh) disturb(scene, *m);  // where it is now
}

void reassemble(Scene& scene) {
  bool any = scene.replan;
  for (auto& m : scene.models) any |= m->dirty;
  if (!any) return;
  hold_true_velocities(scene);
  for (auto& m : scene.models)
    if (m->dirty) {
      m->loop = false;
      assemble(scene, *m);
    }
  if (scene.bonds) assemble(scene, *scene.bonds);  // last: its joints hang on the bodies of the others
  plan_carried(scene);
  // The bodies of what the new plan has carried give up again what they are carried with.
  for (Cluster* c : scene.carried) {
    update_carry(*c);
    const dBodyID b = c->root->body;
    set_body_twist(b, body_velocity(b) - c->carry_v, body_spin(b) - c->carry_w);
  }
}

// For a change of plan: bodies of carried clusters get their true velocities.
void hold_true_velocities(Scene& scene) {
  for (Cluster* c : scene.carried) {
    const dBodyID b = c->root->body;
    set_body_twist(b, body_velocity(b) + c->carry_v, body_spin(b) + c->carry_w);
  }
  scene.replan |= !scene.carried.empty();
  for (Cluster* c : scene.carried) c->by = c->held = nullptr;
  scene.carried.clear();
}

// True velocities of the links of carried clusters.
void spread_carried(Scene& scene) {
  for (Cluster* c : scene.carried) {
    Link& root = *c->root;
    if (c->held->moving) spread_twists(*c);
    update_carry(*c);
    root.w = body_spin(root.body) + c->carry_w;
    root.v = body_velocity(root.body) + c->carry_v - cross(root.w, rotate(root.X_WL.q, c->com));
    spread_twists(*c);
  }
}

void keep_relations(Scene& scene) {
  for (Cluster* c : scene.carried) {
    const Link &by = *c->by, &held = *c->held;
    const Quat q = conjugate(by.X_WL.q);
    c->X_by_held = inverse(by.X_WL) * held.X_WL;
    c->w_by_held = rotate(q, held.w - by.w);
    c->v_by_held = rotate(q, held.v - by.velocity_at(held.X_WL.p));
  }
}

// The position drives have moved: what they carry moves along.
void carry_along(Scene& scene) {
  for (Cluster* c : scene.carried) {
    Link& root = *c->root;
    const Link &by = *c->by, &held = *c->held;
    const Pose X_WH = by.X_WL * c->X_by_held;
    root.X_WL = normalized(X_WH * inverse(held.X_RL));
    root.w = by.w + rotate(by.X_WL.q, c->w_by_held);
    root.v = by.velocity_at(X_WH.p) + rotate(by.X_WL.q, c->v_by_held) + cross(root.w, root.X_WL.p - X_WH.p);
    place_cluster(*c);
    spread_twists(*c, false);
  }
}

}  // namespace ode_sim
