#include "ode_access.hpp"

#include <algorithm>
#include <cmath>

namespace ode_sim {

Pose Joint::motion(double q) const {
  switch (type) {
    case JointType::Revolute: return {{}, axis_angle(axes[0].xyz, q)};
    case JointType::Prismatic: return {axes[0].xyz * q, {}};
    default: return {};
  }
}

World::World() {
  initialise_ode();
  world_ = dWorldCreate();
  space_ = dHashSpaceCreate(nullptr);
  dHashSpaceSetLevels(space_, -4, 6);
  contact_group_ = dJointGroupCreate(0);
  dWorldSetAutoDisableFlag(world_, 0);
  dWorldSetContactSurfaceLayer(world_, 0);
}

World::~World() {
  while (!models_.empty()) remove_model(*models_.back());
  dJointGroupDestroy(contact_group_);
  dSpaceDestroy(space_);
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

void World::remove_model(Model& model) {
  hold_true_velocities();
  for (auto& j : model.joints)
    if (j->joint) dJointDestroy(j->joint), j->joint = nullptr;
  for (auto& link : model.links) {
    for (auto& s : link->shapes) {
      shapes_.erase(s->id);
      s->alive = false;
      dGeomDestroy(s->geom);
      if (s->faceted) dGeomDestroy(s->faceted);
      s->mesh = s->faceted_mesh = nullptr;
      if (s->field) dGeomHeightfieldDataDestroy(s->field);
      s->geom = s->faceted = nullptr;
    }
    if (link->body) dBodyDestroy(link->body), link->body = nullptr;
  }
  contacts_.clear();
  for (size_t i = ties_.size(); i-- > 0;)
    if ((ties_[i].parent && ties_[i].parent->model == &model) || ties_[i].child->model == &model) detach(ties_[i].id);
  model.world = nullptr;
  models_.erase(std::find_if(models_.begin(), models_.end(), [&](auto& m) { return m.get() == &model; }));
  renumber();
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
  model.joints.push_back(joint);
  model.dirty = true;
  return joint;
}

std::shared_ptr<Shape> World::add_shape(Link& link, const Pose& X_LC, dGeomID geom, std::shared_ptr<Shape> shape) {
  shape->id = next_shape_++;
  shape->link = &link;
  shape->X_LC = normalized(X_LC);
  shape->geom = geom;
  dGeomSetData(geom, shape.get());
  dSpaceAdd(space_, geom);
  link.shapes.push_back(shape);
  shapes_[shape->id] = shape.get();
  link.model->dirty = true;
  return shape;
}

void World::finish(Model& model) {
  for (auto& link : model.links)
    for (auto& shape : link->shapes) {
      place_shapes(*link);
      if (shape->infinite) continue;
      dReal box[6];
      dGeomGetAABB(shape->geom, box);
      for (int i = 0; i < 8; ++i) {
        const Vec3 corner{box[i & 1], box[2 + (i >> 1 & 1)], box[4 + (i >> 2 & 1)]};
        link->size = std::max(link->size, norm(corner - link->X_WL.p));
      }
    }
  for (auto& j : model.joints) j->sane = sane_beyond(*j);
  for (auto& link : model.links) model.mass += link->mass;
  for (auto& j : model.joints)
    if (j->type == JointType::Revolute)
      for (auto& shape : j->child->shapes)
        if (dGeomGetClass(shape->geom) == dCylinderClass) {
          const Vec3 axis = rotate(j->X_CJ.q, j->axes[0].xyz);
          const Vec3 from_axis = cross(shape->X_LC.p - j->X_CJ.p, axis);
          shape->wheel = std::abs(dot(axis, rotate(shape->X_LC.q, Vec3{0, 0, 1}))) > 0.9999 && norm(from_axis) < 1e-4;
        }
  renumber();
  refresh();
}

void World::renumber() {
  int links = 0, axes = 0;
  for (auto& m : models_) {
    for (auto& l : m->links) l->row = links++;
    for (auto& j : m->joints) {
      j->row = axes;
      axes += j->axis_count;
    }
  }
  link_poses.assign(7 * links, 0);
  joint_positions.assign(axes, 0);
  joint_velocities.assign(axes, 0);
  read_back();
}

Shape* World::find_shape(int id) const {
  auto it = shapes_.find(id);
  return it == shapes_.end() ? nullptr : it->second;
}

// Links beyond a joint: those reached from its child without crossing it. `loop` tells whether they lead back.
std::vector<Link*> World::subtree(Joint& joint, bool* loop) const {
  std::vector<Link*> out{joint.child};
  if (loop) *loop = false;
  for (size_t i = 0; i < out.size(); ++i)
    for (auto& j : joint.model->joints) {
      if (j.get() == &joint) continue;
      Link* other = j->parent == out[i] ? j->child : j->child == out[i] ? j->parent : out[i];
      if (j->child == out[i] && !j->parent && loop) *loop = true;  // held by the world as well
      if (!other || other == out[i]) continue;
      if (other == joint.parent && loop) *loop = true;
      if (std::find(out.begin(), out.end(), other) == out.end()) out.push_back(other);
    }
  return out;
}

// Whether the links beyond a joint could be real bodies of their size: radius of gyration against reach.
bool World::sane_beyond(Joint& joint) const {
  for (Link* l : subtree(joint)) {
    const double gyration = std::sqrt(std::max({l->inertia.xx, l->inertia.yy, l->inertia.zz}) / l->mass);
    if (gyration > 3 * l->size + 0.2 + norm(l->com)) return false;
  }
  return true;
}

// ------------------------------------------------------------------------------------------------ the step

void World::step(int n) {
  initialise_ode();
  for (int i = 0; i < n; ++i) step_once();
}

void World::step_once() {
  refresh();
  for (auto& m : models_)
    if (m->has_servo) {
      weigh(*m);
      for (auto& j : m->joints) j->previous_rate = j->rate;
      set_rates(*m);
    }
  spread_carried();
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
  for (auto& m : models_) project_joints(*m);
  for (auto& m : models_) {
    for (auto& l : m->links) l->force = l->torque = {};
    for (auto& j : m->joints)
      for (auto& a : j->axes) a.applied = a.force, a.force = 0;
  }
  read_back();
  for (auto& m : models_)
    if (m->has_servo)
      for (auto& j : m->joints) read_load(*j);
  dJointGroupEmpty(contact_group_);
  for (auto& c : contacts_) c.joint = nullptr;
  demote();
  ++iterations;
  time_ns += static_cast<int64_t>(std::llround(dt * 1e9));
}

}  // namespace ode_sim
