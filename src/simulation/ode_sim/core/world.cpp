#include "world.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "geometry.hpp"
#include "phases.hpp"

namespace ode_sim {

World::World() {
  const OdeScope scope;
  scene_.ode.reset(dWorldCreate());
  scene_.step_joints.reset(dJointGroupCreate(0));
  dWorldSetAutoDisableFlag(scene_.ode, 0);
  dWorldSetContactSurfaceLayer(scene_.ode, 0);
}

World::~World() {
  const OdeScope scope;                               // whichever thread it ends in
  for (auto& m : scene_.models) m->finished = false;  // nobody asks for the rest each time that one goes
  if (scene_.bonds) remove_model(*std::exchange(scene_.bonds, nullptr));
  while (!scene_.models.empty()) remove_model(*scene_.models.back());
  scene_.step_joints.reset();
  scene_.ode.reset();
}

// ------------------------------------------------------------------------------------------------ building

std::shared_ptr<Model> World::add_model(const std::string& name, bool is_static, bool self_collide, bool may_sleep) {
  auto model = std::make_shared<Model>();
  model->id = next_model_++;
  model->name = name;
  model->world = this;
  model->is_static = is_static;
  model->self_collide = self_collide;
  model->may_sleep = may_sleep;
  scene_.models.push_back(model);
  return model;
}

void World::forget_contacts(const Model& model) {
  const auto gone = [&](const Contact& c) { return c.a->link->model == &model || c.b->link->model == &model; };
  auto& contacts = state_.contacts;
  contacts.erase(std::remove_if(contacts.begin(), contacts.end(), gone), contacts.end());
  state_.pairs.clear();
  forget_loads(scene_, model);
}

void World::remove_model(Model& model) {
  if (!owns(&model)) throw std::invalid_argument("this model is not in the world");
  const OdeScope scope;
  if (model.finished) disturb(model);
  hold_true_velocities(scene_);
  for (size_t i = scene_.welds.size(); i-- > 0;) {
    const Weld& t = scene_.welds[i];
    if ((t.parent && t.parent->model == &model) || t.child->model == &model) unweld(t.id);
  }
  if (const auto bonds = scene_.bonds; bonds && bonds.get() != &model)
    for (size_t i = bonds->joints.size(); i-- > 0;) {
      Joint& j = *bonds->joints[i];
      if ((j.parent && j.parent->model == &model) || j.child->model == &model) disconnect(j);
    }
  for (auto& m : scene_.models)
    for (auto& j : m->joints)
      if (const auto leader = j->leader.lock(); leader && leader->model == &model) j->leader.reset();  // it holds its position
  forget_contacts(model);
  scene_.separations.forget();
  scene_.mesh_pieces.forget();
  for (auto& j : model.joints) j->joint.reset();
  for (auto& link : model.links) {
    for (auto& s : link->shapes) {
      scene_.shapes.erase(s->id);
      scene_.broad_phase.remove(s.get());
      s->release();
    }
    link->body.reset();
  }
  model.world = nullptr;
  const bool was_finished = model.finished;
  auto& models = scene_.models;
  models.erase(std::find_if(models.begin(), models.end(), [&](auto& m) { return m.get() == &model; }));
  if (was_finished) renumber();
}

std::shared_ptr<Link> World::add_link(Model& model, const Pose& X_WL, double mass, const Vec3& com, const Sym3& inertia) {
  const OdeScope scope;
  auto link = std::make_shared<Link>();
  link->id = next_link_++;
  link->model = &model;
  link->X_WL = normalized(X_WL);
  link->mass = mass;
  link->com = com;
  link->inertia = inertia;
  if (!model.is_static) {
    link->body.reset(dBodyCreate(scene_.ode));
    dBodySetFiniteRotationMode(link->body, 1);
    dBodyDisable(link->body);
  }
  model.links.push_back(link);
  model.dirty = true;
  return link;
}

static int axes_of(JointType type) {
  switch (type) {
    case JointType::Fixed:
    case JointType::Ball: return 0;
    case JointType::Revolute:
    case JointType::Prismatic: return 1;
    default: return 2;
  }
}

// Of the model; the links do not know of it yet.
std::shared_ptr<Joint> World::make_joint(Model& model, JointType type, Link* parent, Link& child, const Pose& X_CJ) {
  auto joint = std::make_shared<Joint>();
  joint->id = next_joint_++;
  joint->model = &model;
  joint->type = type;
  joint->parent = parent;
  joint->child = &child;
  joint->X_CJ = normalized(X_CJ);
  joint->X_PJ = normalized(parent ? inverse(parent->X_WL) * child.X_WL * X_CJ : child.X_WL * X_CJ);
  joint->axis_count = axes_of(type);
  joint->q_RJ = (child.X_WL * joint->X_CJ).q;
  if (parent) model.jointed.insert(std::minmax(parent->id, child.id));
  joint->index = static_cast<int>(model.joints.size());
  model.joints.push_back(joint);
  model.dirty = true;
  return joint;
}

std::shared_ptr<Joint> World::add_joint(Model& model, JointType type, Link* parent, Link& child, const Pose& X_CJ) {
  auto joint = make_joint(model, type, parent, child, X_CJ);
  if (!joint->holds()) return joint;
  if (!child.parent_joint) child.parent_joint = joint.get();
  child.joints.push_back(joint.get());
  if (parent && parent != &child) parent->joints.push_back(joint.get());
  return joint;
}

std::shared_ptr<Shape> World::add_shape(Link& link, const Pose& X_LC, OwnedGeom geom, std::shared_ptr<Shape> shape) {
  shape->id = next_shape_++;
  shape->link = &link;
  shape->surface.model = link.model;
  shape->X_LC = normalized(X_LC);
  shape->geom = std::move(geom);
  dGeomSetData(shape->geom, shape.get());
  link.shapes.push_back(shape);
  scene_.shapes[shape->id] = shape.get();
  scene_.broad_phase.add(shape.get());
  link.model->dirty = true;
  return shape;
}

static void measure(Link& link) {
  for (auto& shape : link.shapes) {
    if (shape->infinite) continue;
    dReal box[6];
    bounds(*shape, box);
    for (int i = 0; i < 8; ++i) {
      const Vec3 corner{box[i & 1], box[2 + (i >> 1 & 1)], box[4 + (i >> 2 & 1)]};
      link.size = std::max(link.size, norm(corner - link.X_WL.p));
    }
  }
}

void World::finish(Model& model) {
  const OdeScope scope;
  for (auto& link : model.links) {
    place_shapes(scene_, *link);
    measure(*link);
  }
  judge_masses(model);
  for (auto& j : model.joints)
    if (j->type == JointType::Revolute)
      for (auto& shape : j->child->shapes) shape->look_for_tread(rotate(j->X_CJ.q, j->axes[0].xyz), j->X_CJ.p);
  model.finished = true;
  renumber(&model);
  refresh();
}

// Places in the shared arrays. Who comes or goes does not touch the others: their joints are not read again from the poses,
// which would cost the last bit.
void World::renumber(const Model* fresh) {
  int links = 0, axes = 0;
  for (auto& m : scene_.models) {
    if (!m->finished) continue;
    for (auto& l : m->links) l->row = links++;
    for (auto& j : m->joints) {
      j->row = axes;
      axes += j->axis_count;
    }
  }
  scene_.link_poses = std::make_shared<std::vector<double>>(7 * links, 0.0);
  scene_.joint_positions = std::make_shared<std::vector<double>>(axes, 0.0);
  scene_.joint_velocities = std::make_shared<std::vector<double>>(axes, 0.0);
  pull(scene_);
  publish(scene_, [&](const Joint& j) { return j.model != fresh; });
}

// ------------------------------------------------------------------------------------------------ the step

void World::step(int n) {
  const OdeScope scope;
  for (int i = 0; i < n; ++i) {
    const int64_t then = scene_.next_time_ns();
    if (observer) observer->before(then);
    try {
      step_once(scene_, state_);
    } catch (const OdeFailure& failure) {
      scene_.messages.report(std::string(failure.what()) + "; the step was given up", "");
      abandon_step(scene_, state_);
    }
    ++scene_.iterations;
    scene_.time_ns = then;
    if (observer) observer->after(then);
  }
}

std::vector<ContactRecord> World::contacts() const { return contact_records(state_); }

void World::refresh() {
  const OdeScope scope;
  ode_sim::refresh(scene_);
}

void World::disturb(const Model& model) {
  const OdeScope scope;
  ode_sim::disturb(scene_, model);
}

std::string World::save() {
  const OdeScope scope;
  return ode_sim::save(scene_);
}

void World::restore(const std::string& data, const std::vector<int>& weld_ids) {
  const OdeScope scope;
  ode_sim::restore(scene_, data, weld_ids);
  for (auto& m : scene_.models) m->changed = false;  // it was, before what is restored
  scene_.settled = scene_.settings;
  state_.contacts.clear();
  for (int id : weld_ids) next_weld_ = std::max(next_weld_, id + 1);
}

}  // namespace ode_sim
