// The order in which Gazebo Classic's ODE has the constraints of a step, on which what its iterations leave depends.
#include <unordered_map>
#include <utility>

#include "constraint_rows.hpp"

namespace ode_sim {

namespace {

// One end of a joint or contact.
struct End {
  Joint* joint;            // or
  const Contact* contact;  // either of them
  dJointID at;
  dBodyID other;
};

class Walk {
 public:
  Walk(Scene& scene, const StepState& state) {
    for (auto c = state.contacts.rbegin(); c != state.contacts.rend(); ++c)
      if (c->joint) add({nullptr, &*c, c->joint, nullptr});
    for (auto m = scene.models.rbegin(); m != scene.models.rend(); ++m)
      for (auto j = (*m)->joints.rbegin(); j != (*m)->joints.rend(); ++j)
        if ((*j)->joint) add({j->get(), nullptr, (*j)->joint, nullptr});
    for (auto m = scene.models.rbegin(); m != scene.models.rend(); ++m)
      for (auto l = (*m)->links.rbegin(); l != (*m)->links.rend(); ++l)
        if (const dBodyID body = body_of(l->get())) from(body);
  }
  RowOrder order;

 private:
  std::unordered_map<dBodyID, std::vector<End>> ends_;  // newest first
  std::unordered_map<dBodyID, bool> seen_;
  std::unordered_map<dJointID, bool> taken_;

  void add(End end) {
    const dBodyID first = dJointGetBody(end.at, 0), second = dJointGetBody(end.at, 1);
    for (const auto& [body, other] : {std::make_pair(first, second), std::make_pair(second, first)}) {
      end.other = other;
      if (body) ends_[body].push_back(end);
    }
  }

  // The body's joints; then those of what hangs on them, the one found last before the others.
  void from(dBodyID start) {
    std::vector<dBodyID> left;
    if (!std::exchange(seen_[start], true)) left.push_back(start);
    while (!left.empty()) {
      const dBodyID body = left.back();
      left.pop_back();
      for (const End& end : ends_[body]) {
        if (std::exchange(taken_[end.at], true)) continue;
        if (end.joint) order.joints.push_back(end.joint);
        else order.contacts.push_back(end.contact);
        if (end.other && !std::exchange(seen_[end.other], true)) left.push_back(end.other);
      }
    }
  }
};

}  // namespace

RowOrder gazebo_order(Scene& scene, const StepState& state) { return Walk(scene, state).order; }

}  // namespace ode_sim
