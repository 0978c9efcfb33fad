// What sleeps wakes when something that may hold, push or pull it changes.
//
// Sleepers ask nobody whether what they rest on is still there: that would cost time in every step. Whoever changes something tells it,
// before and after, and what touches it at that moment wakes, with all that rests on that. A shape of a sleeper stands where it stood when
// it fell asleep, so that it touches exactly what it touched then.
#include <algorithm>
#include <tuple>

#include "phases.hpp"

namespace ode_sim {

namespace {

auto physics_of(const Settings& s) {
  return std::tie(s.dt, s.gravity.x, s.gravity.y, s.gravity.z, s.erp, s.cfm, s.sor, s.contact_max_vel, s.surface_layer, s.iters,
                  s.max_contacts, s.like_gazebo, s.contact_softness, s.friction_softness, s.direct_rows, s.heap_rows);
}

std::vector<Cluster*> sleepers(const Scene& scene) {
  std::vector<Cluster*> out;
  for (auto& m : scene.models)
    if (m->may_sleep)
      for (auto& c : m->clusters)
        if (c.asleep) out.push_back(&c);
  return out;
}

void add_shapes(const Link& link, std::vector<const Shape*>& out) {
  for (auto& s : link.shapes) out.push_back(s.get());
}

// Sleepers that touch something, or one another in a row that begins there.
class Search {
 public:
  explicit Search(Scene& scene) : scene_(scene), left_(sleepers(scene)) {}

  bool any() const { return !left_.empty(); }
  void begin_with(const Model& model) {
    for (auto& l : model.links) add_shapes(*l, shapes_);
  }
  void begin_with(const Cluster& c) {
    for (const Link* l : c.members) add_shapes(*l, shapes_);
    take_bound(c);
  }
  std::vector<Cluster*> run() {
    for (size_t i = 0; i < shapes_.size() && !left_.empty(); ++i)
      take([&](const Cluster& c) { return touches(*shapes_[i], c); });
    return std::move(found_);
  }

 private:
  Scene& scene_;
  std::vector<Cluster*> left_, found_;
  std::vector<const Shape*> shapes_;

  bool touches(const Shape& shape, const Cluster& c) const {
    for (const Link* l : c.members)
      for (auto& s : l->shapes)
        if (s.get() != &shape && touching(scene_, shape, *s)) return true;
    return false;
  }

  template <class Wanted>
  void take(Wanted wanted) {
    std::vector<Cluster*> now;
    left_.erase(std::remove_if(left_.begin(), left_.end(), [&](Cluster* c) { return wanted(*c) && (now.push_back(c), true); }),
                left_.end());
    for (Cluster* c : now) {
      found_.push_back(c);
      begin_with(*c);
    }
  }

  // By welds, or by joints that came while the world ran.
  void take_bound(const Cluster& c) {
    const auto look = [&](const Link* parent, const Link& child) {
      if (!parent) return;
      const Cluster &a = cluster_of(*parent), &b = cluster_of(child);
      if (&a != &c && &b != &c) return;
      const Cluster* other = &a == &c ? &b : &a;
      take([&](const Cluster& d) { return &d == other; });
    };
    for (auto& t : scene_.welds) look(t.parent.get(), *t.child);
    if (scene_.bonds)
      for (auto& j : scene_.bonds->joints) look(j->parent, *j->child);
  }
};

void rouse(Cluster& c) {
  c.asleep = false;
  c.idle_steps = 0;
  c.idle_time = 0;
}

}  // namespace

void disturb(Scene& scene, const Model& model) {
  Search search(scene);
  if (!search.any()) return;
  search.begin_with(model);
  rouse_all(search.run());
}

// Sleepers that touch them, or are welded to them, with all that rests on these.
std::vector<Cluster*> resting_on(Scene& scene, const std::vector<Cluster*>& others) {
  if (others.empty()) return {};
  Search search(scene);
  for (const Cluster* c : others) search.begin_with(*c);
  return search.run();
}

void wake(Scene& scene, Model& model) {
  std::vector<Cluster*> sleeping;
  for (auto& c : model.clusters) {
    if (c.asleep) sleeping.push_back(&c);
    rouse(c);
  }
  rouse_all(resting_on(scene, sleeping));
}

void rouse_all(const std::vector<Cluster*>& clusters) {
  for (Cluster* c : clusters) rouse(*c);
}

void look_for_changes(Scene& scene) {
  if (physics_of(scene.settings) != physics_of(scene.settled)) rouse_all(sleepers(scene));
  scene.settled = scene.settings;
  for (auto& m : scene.models)
    if (m->changed || m->dirty) {
      wake(scene, *m);
      disturb(scene, *m);
      m->changed = false;
    }
}

}  // namespace ode_sim
