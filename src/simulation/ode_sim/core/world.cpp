#include "ode_access.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace ode_sim {

Pose Joint::motion(double q) const {
  switch (type) {
    case JointType::Revolute: return {{}, axis_angle(axes[0].xyz, q)};
    case JointType::Prismatic: return {axes[0].xyz * q, {}};
    default: return {};
  }
}

World::World()
    : link_poses(std::make_shared<std::vector<double>>()),
      joint_positions(std::make_shared<std::vector<double>>()),
      joint_velocities(std::make_shared<std::vector<double>>()) {
  initialise_ode();
  world_ = dWorldCreate();
  contact_group_ = dJointGroupCreate(0);
  dWorldSetAutoDisableFlag(world_, 0);
  dWorldSetContactSurfaceLayer(world_, 0);
}

World::~World() {
  initialise_ode();  // whichever thread it ends in
  for (auto& m : models_) m->finished = false;  // nobody asks for the rest each time that one goes
  while (!models_.empty()) remove_model(*models_.back());
  dJointGroupDestroy(contact_group_);
  dWorldDestroy(world_);
}

// ------------------------------------------------------------------------------------------------ building

std::shared_ptr<Model> World::add_model(const std::string& name, bool is_static, bool self_collide, bool may_sleep) {
  initialise_ode();
  auto model = std::make_shared<Model>();
  model->id = next_model_++;
  model->name = name;
  model->world = this;
  model->is_static = is_static;
  model->self_collide = self_collide;
  model->may_sleep = may_sleep;
  models_.push_back(model);
  return model;
}

void Shape::release() {
  if (geom) dGeomDestroy(geom);
  if (faceted) dGeomDestroy(faceted);
  if (field) dGeomHeightfieldDataDestroy(field);
  geom = faceted = nullptr;
  field = nullptr;
  mesh = faceted_mesh = nullptr;
}

// Also one that was never finished: nothing of it stays behind.
void World::remove_model(Model& model) {
  if (!owns(&model)) throw std::invalid_argument("this model is not in the world");
  initialise_ode();
  hold_true_velocities();
  for (size_t i = ties_.size(); i-- > 0;)
    if ((ties_[i].parent && ties_[i].parent->model == &model) || ties_[i].child->model == &model) detach(ties_[i].id);
  for (auto& m : models_)
    for (auto& j : m->joints)
      if (const auto leader = j->leader.lock(); leader && leader->model == &model) j->leader.reset();  // it holds its position
  const auto gone = [&](const Contact& c) { return c.a->link->model == &model || c.b->link->model == &model; };
  contacts_.erase(std::remove_if(contacts_.begin(), contacts_.end(), gone), contacts_.end());
  pairs_.clear();
  forget_loads(model);
  for (auto& j : model.joints)
    if (j->joint) dJointDestroy(j->joint), j->joint = nullptr;
  for (auto& link : model.links) {
    for (auto& s : link->shapes) {
      shapes_.erase(s->id);
      broad_phase_.remove(s.get());
      s->release();
    }
    if (link->body) dBodyDestroy(link->body), link->body = nullptr;
  }
  model.world = nullptr;
  const bool was_finished = model.finished;
  models_.erase(std::find_if(models_.begin(), models_.end(), [&](auto& m) { return m.get() == &model; }));
  if (was_finished) renumber();
}

std::shared_ptr<Link> World::add_link(Model& model, const Pose& X_WL, double mass, const Vec3& com, const Sym3& inertia) {
  auto link = std::make_shared<Link>();
  link->id = next_link_++;
  link->model = &model;
  link->X_WL = normalized(X_WL);
  link->mass = mass;
  link->com = com;
  link->inertia = inertia;
  if (!model.is_static) {
    link->body = dBodyCreate(world_);
    dBodySetFiniteRotationMode(link->body, 1);
    dBodyDisable(link->body);
  }
  model.links.push_back(link);
  model.dirty = true;
  return link;
}

std::shared_ptr<Joint> World::add_joint(Model& model, JointType type, Link* parent, Link& child, const Pose& X_CJ) {
  auto joint = std::make_shared<Joint>();
  joint->id = next_joint_++;
  joint->model = &model;
  joint->type = type;
  joint->parent = parent;
  joint->child = &child;
  joint->X_CJ = normalized(X_CJ);
  joint->X_PJ = normalized(parent ? inverse(parent->X_WL) * child.X_WL * X_CJ : child.X_WL * X_CJ);
  joint->axis_count = type == JointType::Universal ? 2 : type == JointType::Fixed || type == JointType::Ball ? 0 : 1;
  if (!child.parent_joint) child.parent_joint = joint.get();
  if (parent) model.jointed.insert(std::minmax(parent->id, child.id));
  joint->index = static_cast<int>(model.joints.size());
  model.joints.push_back(joint);
  child.joints.push_back(joint.get());
  if (parent && parent != &child) parent->joints.push_back(joint.get());
  model.dirty = true;
  return joint;
}

std::shared_ptr<Shape> World::add_shape(Link& link, const Pose& X_LC, dGeomID geom, std::shared_ptr<Shape> shape) {
  shape->id = next_shape_++;
  shape->link = &link;
  shape->X_LC = normalized(X_LC);
  shape->geom = geom;
  dGeomSetData(geom, shape.get());
  link.shapes.push_back(shape);
  shapes_[shape->id] = shape.get();
  broad_phase_.add(shape.get());
  link.model->dirty = true;
  return shape;
}

void World::finish(Model& model) {
  for (auto& link : model.links) {
    place_shapes(*link);
    for (auto& shape : link->shapes) {
      if (shape->infinite) continue;
      dReal box[6];
      dGeomGetAABB(shape->geom, box);
      for (int i = 0; i < 8; ++i) {
        const Vec3 corner{box[i & 1], box[2 + (i >> 1 & 1)], box[4 + (i >> 2 & 1)]};
        link->size = std::max(link->size, norm(corner - link->X_WL.p));
      }
    }
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
  for (auto& m : models_) {
    if (!m->finished) continue;
    for (auto& l : m->links) l->row = links++;
    for (auto& j : m->joints) {
      j->projected = m.get() != fresh;
      j->row = axes;
      axes += j->axis_count;
    }
  }
  link_poses = std::make_shared<std::vector<double>>(7 * links, 0.0);
  joint_positions = std::make_shared<std::vector<double>>(axes, 0.0);
  joint_velocities = std::make_shared<std::vector<double>>(axes, 0.0);
  read_back();
}

Shape* World::find_shape(int id) const {
  auto it = shapes_.find(id);
  return it == shapes_.end() ? nullptr : it->second;
}

// Links beyond a joint: those reached from its child without crossing it. `loop` tells whether they lead back.
std::vector<Link*> World::subtree(Joint& joint, bool* loop) {
  const int visit = ++visit_;
  std::vector<Link*> out{joint.child};
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

// The mass of all, and whether the links beyond each joint could be real bodies of their size: radius of gyration against reach.
void World::judge_masses(Model& model) {
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
    tree &= j->child->parent_joint == j.get();
  }
  if (odd.empty()) return;
  if (tree) {
    for (Link* l : odd)
      for (Joint* j = l->parent_joint; j && j->sane; j = j->parent ? j->parent->parent_joint : nullptr) j->sane = false;
    return;
  }
  const std::set<const Link*> all(odd.begin(), odd.end());
  for (auto& j : model.joints)
    for (Link* l : subtree(*j))
      if (all.count(l)) j->sane = false;
}

// ------------------------------------------------------------------------------------------------ the step

void World::step(int n) {
  initialise_ode();
  for (int i = 0; i < n; ++i) {
    try {
      step_once();
    } catch (const OdeFailure& failure) {
      report(std::string(failure.what()) + "; the step was given up", "");
      abandon_step();
    }
    ++iterations;
    time_ns += static_cast<int64_t>(std::llround(dt * 1e9));
  }
}

// What a step that broke off has left in ODE goes; everything is put together anew for the next one.
void World::abandon_step() {
  dJointGroupEmpty(contact_group_);
  contacts_.clear();
  borne_.clear();
  for (auto& t : ties_) t.joint = nullptr;
  guard_nan();
  carried_.clear();
  replan_ = true;
  for (auto& m : models_) {
    m->dirty = true;
    for (auto& l : m->links) {
      l->force = l->torque = {};
      if (l->body) dBodySetForce(l->body, 0, 0, 0), dBodySetTorque(l->body, 0, 0, 0), dBodyDisable(l->body);
    }
    for (auto& j : m->joints)
      for (auto& a : j->axes) a.stepped();
  }
}

void World::step_once() {
  before_.clear();
  nodes_.clear();
  refresh();
  for (auto& m : models_)
    if (m->has_servo) {
      weigh(*m);
      for (auto& j : m->joints) j->previous_rate = j->rate;
      set_rates(*m);
    }
  spread_carried();
  for (auto& m : models_)  // what is pushed wakes up, before its contacts are looked for
    if (m->may_sleep && std::any_of(m->links.begin(), m->links.end(), [](const auto& l) {
          return dot(l->force, l->force) > 0 || dot(l->torque, l->torque) > 0;
        }))
      wake(*m);
  collide();
  if (promote()) {
    refresh();
    for (auto& m : models_)
      if (m->has_servo) set_rates(*m);
    spread_carried();
  }
  apply_forces();
  make_tie_joints();
  follow_servos();
  make_contact_joints();
  solve();
  remember_loads();
  guard_nan();
  pull(false);
  keep_relations();
  integrate_servos();
  bool moved = false;
  for (auto& m : models_) {
    for (auto& j : m->joints) read_feedback(*j);
    for (auto& c : m->clusters) {
      if (!c.moving) continue;
      // The configuration changed: the root link stays where the step took it, the composite mass follows.
      bool still = true;
      for (Link* l : c.members) still &= !l->up || l->up->servo != ServoMode::Locked || l->up->rate == 0;
      if (still) continue;
      moved |= c.root != nullptr;
      compose(c);
      place_cluster(c);
      if (c.has_joints)
        for (auto& j : m->joints)
          if (j->joint && ((j->parent && &m->clusters[j->parent->cluster] == &c) || &m->clusters[j->child->cluster] == &c)) install(*j);
    }
  }
  if (moved) carry_along();
  for (auto& m : models_)
    if (!like_gazebo || m->has_servo) project_joints(*m);
  for (auto& m : models_) {
    for (auto& l : m->links) l->force = l->torque = {};
    for (auto& j : m->joints)
      for (auto& a : j->axes) a.stepped();
  }
  read_back();
  for (auto& m : models_)
    if (m->has_servo)
      for (auto& j : m->joints) read_load(*j);
  dJointGroupEmpty(contact_group_);
  for (auto& c : contacts_) c.joint = nullptr;
  demote();
}

}  // namespace ode_sim
