#include "model.hpp"

#include <algorithm>
#include <cmath>

namespace ode_sim {

const std::vector<Link*>& links_beyond(Joint& joint, bool* loop) {
  const int visit = ++joint.child->model->visits;
  std::vector<Link*>& out = joint.beyond;
  out.assign(1, joint.child);
  joint.child->visit = visit;
  if (loop) *loop = false;
  for (size_t i = 0; i < out.size(); ++i)
    for (Joint* j : out[i]->joints) {
      if (j == &joint) continue;
      if (!j->parent && loop) *loop = true;  // held by the world as well
      Link* other = j->parent == out[i] ? j->child : j->parent;
      if (!other) continue;
      if (other == joint.parent && loop) *loop = true;
      if (other->visit == visit) continue;
      other->visit = visit;
      out.push_back(other);
    }
  return out;
}

void judge_masses(Model& model) {
  model.mass = 0;
  for (auto& l : model.links) model.mass += l->mass;
  std::vector<Link*> odd;
  for (auto& l : model.links) {
    const double gyration = std::sqrt(std::max({l->inertia.xx, l->inertia.yy, l->inertia.zz}) / l->mass);
    if (gyration > 3 * l->size + 0.2 + norm(l->com)) odd.push_back(l.get());
  }
  bool tree = true;
  for (auto& j : model.joints) {
    j->sane = true;
    tree &= !j->holds() || j->child->parent_joint == j.get();
  }
  if (odd.empty()) return;
  if (tree) {
    for (Link* l : odd)
      for (Joint* j = l->parent_joint; j && j->sane; j = j->parent ? j->parent->parent_joint : nullptr) j->sane = false;
    return;
  }
  const std::set<const Link*> all(odd.begin(), odd.end());
  for (auto& j : model.joints)
    for (Link* l : links_beyond(*j))
      if (all.count(l)) j->sane = false;
}

}  // namespace ode_sim
