// Joints that come and go while the world runs.
//
// Those that come hang between links of any models, or between one and the world. They are the joints of a model without links, scene.bonds,
// so that each phase meets them where it meets those of descriptions. The links do not know of them, as of welds: who moves what hangs
// on a joint of a description leaves what such a one holds where it is, and position drives are not for them.
#include <algorithm>
#include <stdexcept>

#include "phases.hpp"
#include "world.hpp"

namespace ode_sim {

namespace {

void touch(Scene& scene, const Joint& joint) {
  for (Link* l : {joint.parent, joint.child})
    if (l) wake(scene, *l->model), l->model->dirty = true;
}

void forget_pairs(Model& model) {
  model.jointed.clear();
  for (const auto& j : model.joints)
    if (j->parent) model.jointed.insert(std::minmax(j->parent->id, j->child->id));
}

void unlink(const Model& model, Joint& joint) {
  for (Link* l : {joint.parent, joint.child})
    if (l) l->joints.erase(std::remove(l->joints.begin(), l->joints.end(), &joint), l->joints.end());
  if (joint.child->parent_joint != &joint) return;
  joint.child->parent_joint = nullptr;
  for (const auto& other : model.joints)
    if (other->holds() && other->child == joint.child && !joint.child->parent_joint) joint.child->parent_joint = other.get();
}

}  // namespace

// Where the child is now the joint is at zero; its frame in the child is X_CJ. The axes are to be set by whoever asks. Who holds what is
// returned may outlive the world.
std::shared_ptr<Joint> World::connect(JointType type, Link* parent, Link& child, const Pose& X_CJ) {
  for (const Link* l : {parent, &child})
    if (l && !owns(l->model)) throw std::invalid_argument("a link to be joined is not in this world");
  if (parent == &child) throw std::invalid_argument("a link cannot be joined to itself");
  if (type == JointType::Fixed || type == JointType::Gearbox)
    throw std::invalid_argument("no joint of this type can be made while the world runs");
  const OdeScope scope;
  refresh();
  if (!scene_.bonds) scene_.bonds = add_model("", false, false, false);
  struct Held {
    std::shared_ptr<Model> model;
    std::shared_ptr<Joint> joint;
  };
  const auto held = std::make_shared<Held>(Held{scene_.bonds, make_joint(*scene_.bonds, type, parent, child, X_CJ)});
  held->joint->watched = true;
  touch(scene_, *held->joint);
  return {held, held->joint.get()};
}

// Its links go on as they move, each by itself, and may touch. Who still holds the joint finds one without axes.
void World::disconnect(Joint& joint) {
  const OdeScope scope;
  Model& model = *joint.model;
  const auto owner = std::find_if(model.joints.begin(), model.joints.end(), [&](const auto& j) { return j.get() == &joint; });
  if (owner == model.joints.end()) return;  // it has let go before
  const std::shared_ptr<Joint> kept = *owner;
  touch(scene_, joint);
  disturb(*joint.child->model);
  drive_off(joint);
  model.joints.erase(owner);
  forget_pairs(model);
  if (&model != scene_.bonds.get()) {
    unlink(model, joint);
    model.gone.push_back(kept);
  }
  joint.joint.reset();
  joint.type = JointType::Fixed;
  joint.axis_count = 0;
  joint.feedback = {};
  for (Axis& axis : joint.axes) axis.relax(), set_motor(axis, 0, 0);
  judge_masses(model);
  model.dirty = true;
  refresh();
}

}  // namespace ode_sim
