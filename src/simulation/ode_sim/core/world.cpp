#include "world.hpp"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <numeric>
#include <stdexcept>

namespace ode_sim {

namespace {

// Thrown out of ODE where it would otherwise abort the process.
struct OdeFailure {};

// ODE's random generator and its message handlers are global; a step holds this lock around what uses them.
std::mutex ode_mutex;
thread_local std::vector<std::string>* current_messages = nullptr;

void collect(const char* text, va_list args) {
  char line[256];
  std::vsnprintf(line, sizeof line, text, args);
  if (current_messages) current_messages->push_back(line);
}

// While it lives, what ODE says goes to `said`, and where it would abort it throws.
class Listening {
 public:
  explicit Listening(std::vector<std::string>& said) {
    current_messages = &said;
    dSetMessageHandler([](int, const char* t, va_list a) { collect(t, a); });
    dSetErrorHandler([](int, const char* t, va_list a) { collect(t, a); throw OdeFailure(); });
    dSetDebugHandler([](int, const char* t, va_list a) { collect(t, a); throw OdeFailure(); });
  }
  ~Listening() { current_messages = nullptr; }
};

Vec3 vec(const dReal* a) { return {a[0], a[1], a[2]}; }
Quat quat(const dReal* a) { return {a[1], a[2], a[3], a[0]}; }

void set_body_pose(dBodyID body, const Pose& X) {
  dBodySetPosition(body, X.p.x, X.p.y, X.p.z);
  const dQuaternion q = {X.q.w, X.q.x, X.q.y, X.q.z};
  dBodySetQuaternion(body, q);
}
void set_body_twist(dBodyID body, const Vec3& v, const Vec3& w) {
  dBodySetLinearVel(body, v.x, v.y, v.z);
  dBodySetAngularVel(body, w.x, w.y, w.z);
}
Pose body_pose(dBodyID body) { return {vec(dBodyGetPosition(body)), quat(dBodyGetQuaternion(body))}; }

uint64_t mix(uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

void set_limot(const Joint& j, int axis, int parameter, double value) {
  switch (j.type) {
    case JointType::Revolute: dJointSetHingeParam(j.joint, parameter, value); break;
    case JointType::Prismatic: dJointSetSliderParam(j.joint, parameter, value); break;
    case JointType::Universal:
      // ODE's first axis is that of its first body: the child's, unless only the parent has a body.
      if ((axis == 0) == (j.sign > 0)) parameter += dParamGroup2;
      dJointSetUniversalParam(j.joint, parameter, value);
      break;
    default: break;
  }
}

// Puts two bodies, for a moment, where a joint is to have its zero; then back, to the last bit.
class Posed {
 public:
  // X_1J, X_2J: the joint frame in the first body, and in the second (in the world if there is none).
  Posed(dBodyID first, dBodyID second, const Pose& X_1J, const Pose& X_2J) : bodies_{first, second} {
    for (int i = 0; i < 2; ++i) {
      if (!bodies_[i]) continue;
      std::memcpy(p_[i], dBodyGetPosition(bodies_[i]), 3 * sizeof(dReal));
      std::memcpy(q_[i], dBodyGetQuaternion(bodies_[i]), sizeof q_[i]);
      std::memcpy(R_[i], dBodyGetRotation(bodies_[i]), sizeof R_[i]);
    }
    if (second) set_body_pose(second, {});  // second body, if any, at the origin
    set_body_pose(first, X_2J * inverse(X_1J));
  }
  ~Posed() {
    for (int i = 0; i < 2; ++i) {
      if (!bodies_[i]) continue;
      dBodySetPosition(bodies_[i], p_[i][0], p_[i][1], p_[i][2]);
      dBodySetQuaternion(bodies_[i], q_[i]);
      // Setting a quaternion normalises it, which costs the last bit.
      std::memcpy(const_cast<dReal*>(dBodyGetQuaternion(bodies_[i])), q_[i], sizeof q_[i]);
      std::memcpy(const_cast<dReal*>(dBodyGetRotation(bodies_[i])), R_[i], sizeof R_[i]);
    }
  }

 private:
  dBodyID bodies_[2];
  dReal p_[2][3];
  dQuaternion q_[2];
  dMatrix3 R_[2];
};

constexpr double kFarthest = 1e8;     // m from the origin; beyond twice this the cells of ODE's collision space have no number
constexpr double kStopSkin = 1e-12;  // a joint put exactly on its stop is to be found there despite rounding
constexpr double kNearStop = 1e-9;   // within the reach of the skin
constexpr double kFastest = 1e6;  // m/s, rad/s: a force that would give more in one step is a mistake
constexpr double kJump = 30;  // m/s, rad/s: a servo joint commanded to move faster than this is teleported
constexpr double kPi = 3.14159265358979323846;

}  // namespace

void initialise_ode() {
  static std::once_flag once;
  std::call_once(once, [] { dInitODE2(0); });
  thread_local bool ready = false;
  if (!ready) {
    dAllocateODEDataForThread(dAllocateMaskAll);
    ready = true;
  }
}

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

// ------------------------------------------------------------------------------------------------ clusters

dBodyID World::body_of(const Link* link) const {
  if (!link || link->cluster < 0) return nullptr;
  if (link->carrier) return link->body;
  const Cluster& c = link->model->clusters[link->cluster];
  return c.root ? c.root->body : nullptr;
}

// Pose of the link in its body's frame; in the world when it has none.
Pose World::X_BL(const Link& link) const {
  if (link.carrier) return {};
  const Cluster& c = link.model->clusters[link.cluster];
  if (!c.root) return link.X_WL;
  return {link.X_RL.p - c.com, link.X_RL.q};
}

void World::refresh() {
  bool any = replan_;
  for (auto& m : models_) any |= m->dirty;
  if (!any) return;
  hold_true_velocities();
  for (auto& m : models_)
    if (m->dirty) {
      m->loop = false;
      recluster(*m);
    }
  plan_carried();
  rebase_carried();
}

void World::recluster(Model& model) {
  model.dirty = false;
  model.clusters.clear();
  model.has_servo = false;
  for (auto& l : model.links) {
    l->cluster = -1;
    l->up = nullptr;
    l->up_link = nullptr;
    l->moving = l->carrier = false;
  }
  for (auto& j : model.joints) model.has_servo |= j->servo != ServoMode::Off;

  auto grow = [&](Cluster& c) {
    const int index = static_cast<int>(model.clusters.size());
    for (size_t i = 0; i <= c.members.size(); ++i) {
      if (i == c.members.size()) break;
      Link* at = c.members[i];
      at->cluster = index;
      for (auto& j : model.joints) {
        if (!j->merged()) continue;
        Link* next = j->parent == at ? j->child : j->child == at ? j->parent : nullptr;
        if (!next || next->cluster >= 0 || std::find(c.members.begin(), c.members.end(), next) != c.members.end()) continue;
        next->up = j.get();
        next->up_link = at;
        next->moving = at->moving || j->servo == ServoMode::Locked;
        c.moving |= next->moving;
        c.members.push_back(next);
      }
    }
  };

  // What hangs rigidly from the world.
  Cluster anchored;
  if (model.is_static) {
    for (auto& l : model.links) {
      l->cluster = 0;
      l->X_RL = l->X_WL;
      anchored.members.push_back(l.get());
    }
  } else {
    for (auto& j : model.joints)
      if (!j->parent && j->merged() && j->child->cluster < 0 && !j->child->up) {
        j->child->up = j.get();
        j->child->moving = j->servo == ServoMode::Locked;
        anchored.moving |= j->child->moving;
        anchored.members.push_back(j->child);
      }
    grow(anchored);
  }
  if (!anchored.members.empty()) model.clusters.push_back(anchored);

  auto start = [&](Link* root) {
    Cluster c;
    c.root = root;
    c.members.push_back(root);
    grow(c);
    model.clusters.push_back(c);
  };
  // Roots: links that no merged joint holds as its child; then, for loops, whatever is left.
  for (auto& l : model.links) {
    if (l->cluster >= 0) continue;
    bool held = false;
    for (auto& j : model.joints) held |= j->merged() && j->child == l.get();
    if (!held) start(l.get());
  }
  for (auto& l : model.links)
    if (l->cluster < 0) start(l.get());

  // An ODE joint on a link that servo joints move: where the world takes the reaction it hangs on that link's own body.
  auto carry = [&](Link& l) {
    Cluster& c = model.clusters[l.cluster];
    if (l.moving && (!c.root || model.loop)) l.carrier = c.carriers = true;
  };
  for (auto& j : model.joints)
    if (!j->merged())
      for (Link* l : {j->parent, j->child})
        if (l) {
          model.clusters[l->cluster].has_joints = true;
          carry(*l);
        }
  for (auto& t : ties_)
    for (Link* l : {t.parent, t.child})
      if (l && l->model == &model) carry(*l);

  for (auto& l : model.links)
    if (l->body) {
      dBodyDisable(l->body);
      dBodySetDynamic(l->body);
    }
  for (auto& c : model.clusters) {
    compose(c);
    place_cluster(c);
  }
  for (auto& j : model.joints)
    if (j->joint) dJointDestroy(j->joint), j->joint = nullptr;
  for (auto& j : model.joints)
    if (!j->merged()) install(*j);
  plan_tree(model);

  for (auto& l : model.links) {
    const bool fixed = !model.clusters[l->cluster].root && !l->moving;
    for (auto& s : l->shapes) {
      dGeomSetCategoryBits(s->geom, fixed ? 1 : 2);
      dGeomSetCollideBits(s->geom, fixed ? 2 : 3);
    }
    place_shapes(*l);
  }
}

// Poses of the members in the root frame from the joint positions, and the composite mass.
void World::compose(Cluster& c) {
  for (Link* l : c.members) {
    if (l == c.root) {
      l->X_RL = {};
      continue;
    }
    if (!l->up) continue;  // static model
    const Joint& j = *l->up;
    const Pose X_PC = j.X_PJ * j.motion(j.axes[0].q) * inverse(j.X_CJ);
    if (l == j.child)
      l->X_RL = normalized(j.parent ? j.parent->X_RL * X_PC : X_PC);
    else
      l->X_RL = normalized(j.child->X_RL * inverse(X_PC));
  }
  if (!c.root) return;
  c.mass = c.gravity_mass = 0;
  c.com = c.gravity_com = {};
  for (Link* l : c.members) {
    c.mass += l->mass;
    c.com += (l->X_RL * l->com) * l->mass;
    if (l->gravity) {
      c.gravity_mass += l->mass;
      c.gravity_com += (l->X_RL * l->com) * l->mass;
    }
  }
  c.com = c.com * (1 / c.mass);
  if (c.gravity_mass > 0) c.gravity_com = c.gravity_com * (1 / c.gravity_mass);
  c.uniform_gravity = c.gravity_mass == c.mass;
  c.inertia = {};
  for (Link* l : c.members) {
    c.inertia += rotate(l->X_RL.q, l->inertia);
    c.inertia += point_inertia(l->mass, l->X_RL * l->com - c.com);
  }
}

// Puts the cluster's body where its root link is, moving as the root link moves, with the composite mass.
void World::place_cluster(Cluster& c) {
  if (c.root) {
    Link& root = *c.root;
    dBodyID body = root.body;
    dMass m;
    const Sym3& I = c.inertia;
    dMassSetParameters(&m, c.mass, 0, 0, 0, I.xx, I.yy, I.zz, I.xy, I.xz, I.yz);
    dBodySetMass(body, &m);
    if (root.kinematic) dBodySetKinematic(body);
    const Vec3 arm = rotate(root.X_WL.q, c.com);
    set_body_pose(body, {root.X_WL.p + arm, root.X_WL.q});
    set_body_twist(body, root.v + cross(root.w, arm), root.w);
    dBodySetGravityMode(body, c.uniform_gravity && c.gravity_mass > 0);
    dBodySetLinearDamping(body, root.linear_decay);
    dBodySetAngularDamping(body, root.angular_decay);
  }
  spread_poses(c);
  for (Link* l : c.members)
    if (l->carrier) {
      dBodySetKinematic(l->body);
      set_body_pose(l->body, l->X_WL);
    }
}

void World::spread_poses(Cluster& c) {
  for (Link* l : c.members)
    if (l != c.root) l->X_WL = c.root ? normalized(c.root->X_WL * l->X_RL) : l->X_RL;
}

// Velocities of the members from that of the root and the commanded rates of the servo joints (or as if these stood still).
void World::spread_twists(Cluster& c, bool servos) {
  for (Link* l : c.members) {
    if (l == c.root) continue;
    Vec3 v, w, from;
    if (l->up_link) v = l->up_link->v, w = l->up_link->w, from = l->up_link->X_WL.p;
    v += cross(w, l->X_WL.p - from);
    if (servos && l->up && l->up->servo == ServoMode::Locked && l->up->rate != 0) {
      const Joint& j = *l->up;
      const Pose X_WJ = j.frame_W();
      const Vec3 rate = rotate(X_WJ.q, j.axes[0].xyz) * (l == j.child ? j.rate : -j.rate);
      if (j.type == JointType::Revolute) {
        w += rate;
        v += cross(rate, l->X_WL.p - X_WJ.p);
      } else {
        v += rate;
      }
    }
    l->v = v;
    l->w = w;
  }
}

void World::place_shapes(Link& link) {
  for (auto& s : link.shapes) {
    const Pose X = link.X_WL * s->X_LC;
    if (s->infinite) {
      const Vec3 n = rotate(X.q, s->plane_normal);
      dGeomPlaneSetParams(s->geom, n.x, n.y, n.z, dot(n, X.p));
      continue;
    }
    const Quat q = s->field ? X.q * Quat{std::sqrt(0.5), 0, 0, std::sqrt(0.5)} : X.q;  // ODE's height fields have y up
    const dQuaternion r = {q.w, q.x, q.y, q.z};
    dGeomSetPosition(s->geom, X.p.x, X.p.y, X.p.z);
    dGeomSetQuaternion(s->geom, r);
  }
}

// Makes the ODE joint. Its anchor and zero are taken with the bodies put, for a moment, exactly as the joint at zero has
// them; then they go back to where they are, so that the joint feels every deviation.
void World::install(Joint& j) {
  dBodyID child = body_of(j.child), parent = body_of(j.parent);
  if (child == parent || (!child && !parent)) return;
  j.sign = child ? 1 : -1;
  dBodyID first = child ? child : parent, second = child ? parent : nullptr;
  const Pose X_CB_J = X_BL(*j.child) * j.X_CJ;  // joint frame in the child's body, or in the world
  const Pose X_PB_J = j.parent ? X_BL(*j.parent) * j.X_PJ : j.X_PJ;
  const Pose X_1J = child ? X_CB_J : X_PB_J, X_2J = child ? X_PB_J : X_CB_J;

  if (!j.joint) {
    switch (j.type) {
      case JointType::Revolute: j.joint = dJointCreateHinge(world_, nullptr); break;
      case JointType::Prismatic: j.joint = dJointCreateSlider(world_, nullptr); break;
      case JointType::Universal: j.joint = dJointCreateUniversal(world_, nullptr); break;
      case JointType::Ball: j.joint = dJointCreateBall(world_, nullptr); break;
      case JointType::Fixed: j.joint = dJointCreateFixed(world_, nullptr); break;
    }
    dJointAttach(j.joint, first, second);
    if (j.watched) dJointSetFeedback(j.joint, &j.ode_feedback);
  }

  const Posed posed(first, second, X_1J, X_2J);
  const Pose& X_WJ = X_2J;
  const Vec3 at = X_WJ.p, a0 = rotate(X_WJ.q, j.axes[0].xyz), a1 = rotate(X_WJ.q, j.axes[1].xyz);
  switch (j.type) {
    case JointType::Revolute:
      dJointSetHingeAnchor(j.joint, at.x, at.y, at.z);
      dJointSetHingeAxis(j.joint, a0.x, a0.y, a0.z);
      break;
    case JointType::Prismatic: dJointSetSliderAxis(j.joint, a0.x, a0.y, a0.z); break;
    case JointType::Universal: {
      const Vec3 f = child ? a1 : a0, s = child ? a0 : a1;
      dJointSetUniversalAnchor(j.joint, at.x, at.y, at.z);
      dJointSetUniversalAxis1(j.joint, f.x, f.y, f.z);
      dJointSetUniversalAxis2(j.joint, s.x, s.y, s.z);
      break;
    }
    case JointType::Ball: dJointSetBallAnchor(j.joint, at.x, at.y, at.z); break;
    case JointType::Fixed: dJointSetFixed(j.joint); break;
  }
  for (int i = 0; i < j.axis_count; ++i) {
    j.inverse_inertia[i] = axis_inverse_inertia(j, i);
    set_limot(j, i, dParamStopERP, j.stop_erp);
    set_limot(j, i, dParamStopCFM, std::max(j.stop_cfm, 1e-10));
    set_limot(j, i, dParamBounce, 0);
  }
}

double World::axis_inverse_inertia(const Joint& j, int axis) const {
  double sum = 0;
  for (Link* l : {j.child, j.parent}) {
    if (!l || l->carrier) continue;
    const Cluster& c = l->model->clusters[l->cluster];
    if (!c.root || c.root->kinematic) continue;
    if (j.type == JointType::Prismatic) {
      sum += 1 / c.mass;
    } else {
      const Quat q = l == j.child ? l->X_RL.q * j.X_CJ.q : l->X_RL.q * j.X_PJ.q;
      sum += inverse_along(c.inertia, rotate(q, j.axes[axis].xyz));
    }
  }
  return sum;
}

// ------------------------------------------------------------------------------------------------ carried clusters

void World::plan_carried() {
  replan_ = false;
  while (Model* model = try_plan_carried()) {
    model->loop = true;
    recluster(*model);
  }
}

// Finds what is carried by which link, outwards from what the world holds and from the base links. Returns a model in which two
// servo joints move the same cluster.
Model* World::try_plan_carried() {
  carried_.clear();
  struct Edge {
    Link *a, *b;
  };
  std::vector<Edge> edges;
  bool any = false;
  for (auto& m : models_) {
    for (auto& c : m->clusters) {
      c.by = c.at = nullptr;
      c.carry_v = c.carry_w = {};
      any |= c.root && c.moving && !c.carriers;
    }
    for (auto& j : m->joints)
      if (j->joint && j->parent) edges.push_back({j->parent, j->child});
  }
  if (!any) return nullptr;
  for (auto& t : ties_)
    if (t.parent) edges.push_back({t.parent, t.child});

  // The link whose motion, given by servo joints, carries what hangs on `l`; null if none does.
  std::map<const Cluster*, Link*> mover;
  auto mover_of = [&](Link* l) -> Link* {
    const Cluster& c = cluster_of(*l);
    if (!c.root || c.carriers) return nullptr;
    if (!l->moving) return mover[&c];
    while (l->up->servo != ServoMode::Locked) l = l->up_link;
    return l;
  };
  std::vector<Cluster*> queue;
  std::set<const Cluster*> seen;
  auto visit = [&](Cluster& c) {
    if (seen.insert(&c).second) queue.push_back(&c);
  };
  size_t next = 0;
  Model* looped = nullptr;
  auto grow = [&] {
    for (; next < queue.size(); ++next)
      for (auto& e : edges)
        for (auto [by, at] : {std::make_pair(e.a, e.b), std::make_pair(e.b, e.a)}) {
          Cluster &c = cluster_of(*at), &from = cluster_of(*by);
          if (&from != queue[next] || &c == &from) continue;
          Link* m = mover_of(by);
          if (seen.count(&c)) {
            if (!c.root || m == mover_of(at)) continue;
            for (Model* model : {by->model, at->model})
              if (!model->loop && model->has_servo) looped = model;
            continue;
          }
          visit(c);
          if (!c.root || c.carriers) continue;
          mover[&c] = at->moving ? at : m;
          if (!mover[&c]) continue;
          c.by = by;
          c.at = at;
          carried_.push_back(&c);
        }
  };
  auto start = [&](auto wanted) {
    for (auto& m : models_)
      for (auto& c : m->clusters)
        if (wanted(c)) visit(c);
    grow();
  };
  start([](const Cluster& c) { return !c.root; });
  start([](const Cluster& c) { return c.root && c.root->parent_joint && !c.root->parent_joint->parent; });
  for (auto& m : models_)
    for (auto& c : m->clusters)
      if (c.root && !c.root->parent_joint) visit(c), grow();
  for (auto& m : models_)
    for (auto& c : m->clusters) visit(c), grow();
  return looped;
}

// True velocity of a carried cluster less that of its body, from the true velocities of what carries it.
void World::update_carry(Cluster& c) {
  const Link &root = *c.root, &by = *c.by, &at = *c.at;
  const dBodyID body = body_of(&by);
  const Vec3 p = root.X_WL * c.com, w = vec(dBodyGetAngularVel(body));
  c.carry_w = by.w - w;
  c.carry_v = by.velocity_at(p) - vec(dBodyGetLinearVel(body)) - cross(w, p - vec(dBodyGetPosition(body)));
  if (!at.moving) return;
  c.carry_w = c.carry_w - (at.w - root.w);
  c.carry_v = c.carry_v - (at.velocity_at(p) - root.velocity_at(p));
}

// For a change of plan: bodies of carried clusters get their true velocities ...
void World::hold_true_velocities() {
  for (Cluster* c : carried_) {
    const dBodyID b = c->root->body;
    set_body_twist(b, vec(dBodyGetLinearVel(b)) + c->carry_v, vec(dBodyGetAngularVel(b)) + c->carry_w);
  }
  replan_ |= !carried_.empty();
  carried_.clear();
}

// ... and give up again what the new plan has them carried with.
void World::rebase_carried() {
  for (Cluster* c : carried_) {
    update_carry(*c);
    const dBodyID b = c->root->body;
    set_body_twist(b, vec(dBodyGetLinearVel(b)) - c->carry_v, vec(dBodyGetAngularVel(b)) - c->carry_w);
  }
}

// True velocities of the links of carried clusters.
void World::spread_carried() {
  for (Cluster* c : carried_) {
    Link& root = *c->root;
    if (c->at->moving) spread_twists(*c);
    update_carry(*c);
    root.w = vec(dBodyGetAngularVel(root.body)) + c->carry_w;
    root.v = vec(dBodyGetLinearVel(root.body)) + c->carry_v - cross(root.w, rotate(root.X_WL.q, c->com));
    spread_twists(*c);
  }
}

void World::keep_relations() {
  for (Cluster* c : carried_) {
    const Link &by = *c->by, &at = *c->at;
    const Quat q = conjugate(by.X_WL.q);
    c->X_by_at = inverse(by.X_WL) * at.X_WL;
    c->w_by_at = rotate(q, at.w - by.w);
    c->v_by_at = rotate(q, at.v - by.velocity_at(at.X_WL.p));
  }
}

// The servo joints have moved: what they carry moves along.
void World::carry_along() {
  for (Cluster* c : carried_) {
    Link& root = *c->root;
    const Link &by = *c->by, &at = *c->at;
    const Pose X_WA = by.X_WL * c->X_by_at;
    root.X_WL = normalized(X_WA * inverse(at.X_RL));
    root.w = by.w + rotate(by.X_WL.q, c->w_by_at);
    root.v = by.velocity_at(X_WA.p) + rotate(by.X_WL.q, c->v_by_at) + cross(root.w, root.X_WL.p - X_WA.p);
    place_cluster(*c);
    spread_twists(*c, false);
  }
}

// ------------------------------------------------------------------------------------------------ inertial forces

// Accelerations of the members from that of the root, the servo joints moving at their rates - and, with `servos`, changing them.
void World::member_accelerations(Cluster& c, bool servos) {
  for (Link* l : c.members) {
    const Vec3& p = l->X_WL.p;
    if (l == c.root) {
      const Vec3 r = p - l->X_WL * c.com;
      const Vec3 &alpha = servos ? c.alpha_all : c.alpha, &a = servos ? c.a_all : c.a;
      l->alpha = alpha;
      l->a = a + cross(alpha, r) + cross(l->w, cross(l->w, r));
      continue;
    }
    Vec3 w, alpha, a, from;
    if (l->up_link) w = l->up_link->w, alpha = l->up_link->alpha, a = l->up_link->a, from = l->up_link->X_WL.p;
    const Joint& j = *l->up;
    const Pose X_WJ = j.frame_W();
    Vec3 r = X_WJ.p - from;
    a += cross(alpha, r) + cross(w, cross(w, r));
    if (j.servo == ServoMode::Locked) {
      const Vec3 axis = rotate(X_WJ.q, j.axes[0].xyz) * (l == j.child ? 1.0 : -1.0);
      const Vec3 rate = axis * j.rate, change = axis * (servos ? (j.rate - j.previous_rate) / dt : 0.0);
      if (j.type == JointType::Revolute) alpha += cross(w, rate) + change;
      else a += cross(w, rate) * 2 + change;
    }
    r = p - X_WJ.p;
    l->alpha = alpha;
    l->a = a + cross(alpha, r) + cross(l->w, cross(l->w, r));
  }
}

// Accelerations of the clusters of a tree of ODE joints that come from its motion alone, with all joint accelerations zero.
// `servos`: with the servo joints of floating clusters moving, as they are, not standing still.
void World::accelerations(Model& model, bool servos) {
  for (auto& c : model.clusters) {
    (servos ? c.alpha_all : c.alpha) = (servos ? c.a_all : c.a) = {};
    if (c.moving && (servos || !c.root || c.carriers)) member_accelerations(c, servos);
  }
  for (auto& t : model.tree) {
    const Joint& j = *t.joint;
    Cluster& c = model.clusters[t.cluster];
    const Link* near = t.outward ? j.parent : j.child;
    const Pose X_WP = j.frame_W(), X_WC = j.child->X_WL * j.X_CJ;
    const Vec3 p = X_WC.p;
    Vec3 w, alpha, a;  // of the near link, at the joint
    if (near) {
      const Cluster& n = model.clusters[near->cluster];
      if (near->moving && (servos || near->carrier)) {
        const Vec3 r = p - near->X_WL.p;
        w = near->w;
        alpha = near->alpha;
        a = near->a + cross(alpha, r) + cross(w, cross(w, r));
      } else if (n.root) {
        const Vec3 r = p - n.root->X_WL * n.com;
        w = servos ? n.root->w : vec(dBodyGetAngularVel(n.root->body));
        alpha = servos ? n.alpha_all : n.alpha;
        a = (servos ? n.a_all : n.a) + cross(alpha, r) + cross(w, cross(w, r));
      }
    }
    const Vec3 first = rotate(X_WP.q, j.axes[0].xyz) * j.axes[0].qd;
    const double sign = t.outward ? 1 : -1;
    Vec3 turn;
    if (j.type == JointType::Revolute) {
      turn = first * sign;
      alpha += cross(w, turn);
    } else if (j.type == JointType::Prismatic) {
      a += cross(w, first) * (2 * sign);
    } else if (j.type == JointType::Universal) {
      const Vec3 second = rotate(X_WC.q, j.axes[1].xyz) * j.axes[1].qd;
      turn = (first + second) * sign;
      const Vec3 w_parent = t.outward ? w : w + turn;
      alpha += (cross(w_parent, first + second) + cross(first, second)) * sign;
    } else if (j.type == JointType::Ball) {
      turn = (t.outward ? j.child->w - w : j.parent->w - w);
      alpha = {};
    }
    w += turn;
    const Vec3 r = c.root->X_WL * c.com - p;
    (servos ? c.alpha_all : c.alpha) = alpha;
    (servos ? c.a_all : c.a) = a + cross(alpha, r) + cross(w, cross(w, r));
    if (c.moving && (servos || c.carriers)) member_accelerations(c, servos);
  }
}

void World::inertial_force(Cluster& c, const Vec3& a, const Vec3& alpha) {
  const Vec3 f = a * -c.mass;
  const Quat& q = c.root->X_WL.q;
  const Vec3 t = -rotate(q, c.inertia * rotate(conjugate(q), alpha));
  dBodyAddForce(c.root->body, f.x, f.y, f.z);
  dBodyAddTorque(c.root->body, t.x, t.y, t.z);
}

// Centrifugal and Coriolis forces. project_joints carries the joint speeds over to where the links are after the step, which
// turns the velocities of the links with them for nothing; this is what it takes.
void World::apply_inertial_forces(Model& model) {
  if (model.tree.empty()) return;
  accelerations(model, false);
  for (auto& t : model.tree) {
    Cluster& c = model.clusters[t.cluster];
    if (!c.asleep && !c.root->kinematic) inertial_force(c, c.a, c.alpha);
  }
}

// What servo joints of floating clusters carry feels that they move, as what hangs on a moving hand does; the cluster itself does
// not feel it (no recoil). A pass of the direct solver of its own, with the clusters moving as they do, whatever pulls.
void World::follow_servos() {
  bool any = false;
  for (auto& m : models_) {
    if (!m->has_servo || m->jump) continue;
    bool moving = false;
    for (auto& j : m->joints) moving |= j->servo == ServoMode::Locked && (j->rate != 0 || j->previous_rate != 0);
    if (moving) accelerations(*m, true);
    for (Cluster* c : carried_)
      if (c->root->model == m.get()) {
        if (!moving) c->a_all = c->a, c->alpha_all = c->alpha;
        any |= moving;
      }
  }
  if (!any) return;

  // Every body that the pass may touch stays as it is, but for the velocities of the carried ones.
  std::set<const Model*> touched;
  for (Cluster* c : carried_) touched.insert({c->root->model, c->by->model});
  for (auto& t : ties_)
    for (Link* l : {t.parent, t.child})
      if (l) touched.insert(l->model);
  std::vector<Cluster*> all;
  for (auto& m : models_)
    if (touched.count(m.get()))
      for (auto& c : m->clusters)
        if (c.root) all.push_back(&c);
  std::vector<BodyState> start;
  remember_bodies(start, all);
  std::vector<std::pair<dBodyID, dMass>> held;
  for (Cluster* c : all) {
    const dBodyID b = c->root->body;
    dBodySetForce(b, 0, 0, 0);
    dBodySetTorque(b, 0, 0, 0);
    if (c->by || c->root->kinematic) continue;
    dMass mass;
    dBodyGetMass(b, &mass);
    held.push_back({b, mass});
    dBodySetKinematic(b);
  }
  dWorldSetGravity(world_, 0, 0, 0);
  dWorldSetCFM(world_, 1e-18);  // what the joints give way to huge inertias here would be a recoil in the main pass
  for (Cluster* c : carried_) {
    const dBodyID b = c->root->body;
    dBodySetGyroscopicMode(b, 0);
    dBodyEnable(b);
    const Model& m = *c->root->model;
    if (!m.has_servo || m.jump) continue;
    inertial_force(*c, c->a_all - c->a, c->alpha_all - c->alpha);
    const Quat& q = c->root->X_WL.q;
    auto spin = [&](const Vec3& w) { return cross(w, rotate(q, c->inertia * rotate(conjugate(q), w))); };
    const Vec3 t = spin(vec(dBodyGetAngularVel(b))) - spin(c->root->w);
    dBodyAddTorque(b, t.x, t.y, t.z);
  }
  auto drive = [&](bool hold) {  // motors and brakes keep the speeds that there are
    for (auto& m : models_)
      if (touched.count(m.get()))
        for (auto& j : m->joints)
          if (j->joint)
            for (int i = 0; i < j->axis_count; ++i) set_limot(*j, i, dParamVel, hold ? j->axes[i].qd * j->sign : j->axes[i].drive);
  };
  drive(true);
  std::vector<std::string> said;
  const Listening listening(said);
  run(true, 0);
  drive(false);

  std::vector<std::pair<Vec3, Vec3>> result;
  for (Cluster* c : carried_) {
    const dBodyID b = c->root->body;
    result.push_back({vec(dBodyGetLinearVel(b)), vec(dBodyGetAngularVel(b))});
    dBodySetGyroscopicMode(b, 1);
  }
  for (auto& j : models_)
    for (auto& joint : j->joints)
      if (joint->watched && joint->joint && touched.count(j.get()) && (cluster_of(*joint->child).by || (joint->parent && cluster_of(*joint->parent).by))) {
        joint->carried_force = vec(joint->ode_feedback.f1);
        joint->carried_torque = vec(joint->ode_feedback.t1);
      }
  for (auto& [body, mass] : held) dBodySetMass(body, &mass);
  recall_bodies(start);
  for (Cluster* c : all) dBodyDisable(c->root->body);
  dWorldSetGravity(world_, gravity.x, gravity.y, gravity.z);
  dWorldSetCFM(world_, std::max(cfm, 1e-10));
  if (!said.empty()) return;
  for (size_t i = 0; i < carried_.size(); ++i)
    if (finite(result[i].first) && finite(result[i].second)) set_body_twist(carried_[i]->root->body, result[i].first, result[i].second);
  spread_carried();
}

// ------------------------------------------------------------------------------------------------ commands

void World::wake(Model& model) {
  for (auto& c : model.clusters) {
    c.asleep = false;
    c.idle_steps = 0;
    c.idle_time = 0;
  }
}

void World::set_model_pose(Model& model, const Pose& old, const Pose& wanted) {
  const Pose X = wanted * inverse(old);
  for (auto& l : model.links) {
    l->X_WL = normalized(X * l->X_WL);
    if (model.is_static) l->X_RL = l->X_WL;
  }
  for (auto& j : model.joints)
    if (!j->parent) j->X_PJ = normalized(X * j->X_PJ);
  model.dirty = true;
  refresh();
  read_back();
}

void World::set_link_pose(Link& link, const Pose& X_WL) {
  Model& model = *link.model;
  refresh();
  Cluster& c = model.clusters[link.cluster];
  if (!c.root && !model.is_static) return;  // bolted to the world
  const Pose X = normalized(X_WL) * inverse(link.X_WL);
  if (c.root)
    c.root->X_WL = normalized(X * c.root->X_WL);
  else
    link.X_WL = normalized(X_WL);
  model.dirty = true;
  refresh();
  read_back();
}

void World::set_link_twist(Link& link, const Vec3& v, const Vec3& w) {
  refresh();
  Cluster& c = link.model->clusters[link.cluster];
  if (!c.root) return;
  wake(*link.model);
  c.root->v = v + cross(w, c.root->X_WL.p - link.X_WL.p);
  c.root->w = w;
  place_cluster(c);
  if (c.by) {
    const dBodyID b = c.root->body;
    set_body_twist(b, vec(dBodyGetLinearVel(b)) - c.carry_v, vec(dBodyGetAngularVel(b)) - c.carry_w);
  }
  spread_twists(c);
}

void World::zero_velocities(Model& model) {
  refresh();
  for (auto& l : model.links) l->v = l->w = l->force = l->torque = {};
  for (auto& j : model.joints) {
    j->rate = j->previous_rate = 0;
    for (auto& a : j->axes) a.qd = a.force = 0;
  }
  wake(model);
  for (auto& c : model.clusters) place_cluster(c);
  read_back();
}

bool World::set_joint_position(Joint& j, int axis, double q) {
  if (j.axis_count == 0) return false;
  bool loop = false;
  refresh();
  const auto beyond = subtree(j, &loop);
  if (loop) return false;
  Axis& a = j.axes[axis];
  q = std::min(std::max(q, a.lower), a.upper);
  const Pose X_WJ = j.frame_W();
  Pose X_J;
  if (j.type == JointType::Universal) {
    const double q0 = axis == 0 ? q : j.axes[0].q, q1 = axis == 1 ? q : j.axes[1].q;
    X_J.q = axis_angle(j.axes[0].xyz, q0) * axis_angle(j.axes[1].xyz, q1);
  } else {
    X_J = j.motion(q);
  }
  const Pose X_WC = X_WJ * X_J * inverse(j.X_CJ);
  const Pose X = X_WC * inverse(j.child->X_WL);
  for (Link* l : beyond) {
    l->X_WL = normalized(X * l->X_WL);
    l->v = l->w = {};
  }
  a.q = q;
  a.qd = 0;
  j.target = j.previous_target = q;
  j.rate = 0;
  wake(*j.model);
  j.model->dirty = true;
  refresh();
  read_back();
  return true;
}

void World::set_servo(Joint& j, double target) {
  if (j.type != JointType::Revolute && j.type != JointType::Prismatic) return;
  const Axis& a = j.axes[0];
  j.target = std::min(std::max(target, a.lower), a.upper);
  if (j.servo != ServoMode::Off) return;
  j.servo = ServoMode::Locked;
  j.previous_target = a.q;
  j.released = 0;
  j.model->dirty = true;
  j.model->take_exempt = true;
}

void World::servo_off(Joint& j) {
  if (j.servo == ServoMode::Off) return;
  j.servo = ServoMode::Off;
  j.rate = 0;
  j.leader = nullptr;
  j.model->dirty = true;
}

void World::set_inertial(Link& link, double mass, const Vec3& com, const Sym3& inertia) {
  link.model->mass += mass - link.mass;
  link.mass = mass;
  link.com = com;
  link.inertia = inertia;
  link.model->dirty = true;
  for (auto& j : link.model->joints) j->sane = sane_beyond(*j);
}

// ------------------------------------------------------------------------------------------------ ties

// Holds the child where it is now relative to the parent (to the world if null). Returns the tie's number.
int World::attach(Link* parent, Link& child) {
  refresh();
  ties_.push_back({next_tie_++, parent, &child, parent ? inverse(parent->X_WL) * child.X_WL : child.X_WL});
  for (Link* l : {parent, &child})
    if (l) wake(*l->model), l->model->dirty = true;
  return ties_.back().id;
}

void World::detach(int id) {
  for (size_t i = 0; i < ties_.size(); ++i) {
    if (ties_[i].id != id) continue;
    for (Link* l : {ties_[i].parent, ties_[i].child})
      if (l) wake(*l->model), l->model->dirty = true;
    ties_.erase(ties_.begin() + i);
    return;
  }
}

void World::detach_all() {
  while (!ties_.empty()) detach(ties_.back().id);
}

Tie* World::find_tie(int id) {
  for (auto& t : ties_)
    if (t.id == id) return &t;
  return nullptr;
}

// Links that are tied do not collide, nor does what is rigidly joined to them.
bool World::tied(const Link& a, const Link& b) const {
  const auto same = [](const Link* l, const Link& m) { return l && l->model == m.model && l->cluster == m.cluster; };
  for (auto& t : ties_)
    if ((same(t.parent, a) && same(t.child, b)) || (same(t.parent, b) && same(t.child, a))) return true;
  return false;
}

Link* World::find_link(int id) const {
  for (auto& m : models_)
    for (auto& l : m->links)
      if (l->id == id) return l.get();
  return nullptr;
}

// Made anew for each step: which bodies carry the links changes when servo joints lock and unlock.
void World::make_tie_joints() {
  for (auto& t : ties_) {
    t.joint = nullptr;
    const dBodyID child = body_of(t.child), parent = body_of(t.parent);
    if (child == parent || (!child && !parent)) continue;
    t.joint = dJointCreateFixed(world_, contact_group_);
    dJointSetFeedback(t.joint, &t.feedback);
    dJointAttach(t.joint, child ? child : parent, child ? parent : nullptr);
    const Pose X_CB = X_BL(*t.child), X_PB = (t.parent ? X_BL(*t.parent) : Pose{}) * t.X_PC;
    const Posed posed(child ? child : parent, child ? parent : nullptr, child ? X_CB : X_PB, child ? X_PB : X_CB);
    dJointSetFixed(t.joint);
  }
}

// ------------------------------------------------------------------------------------------------ collisions

bool World::allowed(const Shape& a, const Shape& b) const {
  const Link &la = *a.link, &lb = *b.link;
  if (&la == &lb) return false;
  if (!(a.surface.collide_bitmask & b.surface.collide_bitmask)) return false;
  const Cluster &ca = la.model->clusters[la.cluster], &cb = lb.model->clusters[lb.cluster];
  const bool still_a = !ca.root ? !la.moving : ca.asleep, still_b = !cb.root ? !lb.moving : cb.asleep;
  if (still_a && still_b) return false;
  if (la.model == lb.model) {
    if (!la.self_collide && !lb.self_collide) return false;
    if (la.cluster == lb.cluster && !la.moving && !lb.moving) return false;
    if (la.model->jointed.count(std::minmax(la.id, lb.id))) return false;
  }
  return !tied(la, lb);
}

void World::near_callback(void* data, dGeomID ga, dGeomID gb) {
  auto* self = static_cast<World*>(data);
  auto *a = static_cast<Shape*>(dGeomGetData(ga)), *b = static_cast<Shape*>(dGeomGetData(gb));
  if (a->id > b->id) std::swap(a, b);
  if (self->allowed(*a, *b)) self->pairs_.push_back({a, b});
}

void World::collide() {
  contacts_.clear();
  pairs_.clear();
  dSpaceCollide(space_, this, &near_callback);
  // The space reports pairs in an order that depends on its history.
  std::sort(pairs_.begin(), pairs_.end(),
            [](auto& p, auto& q) { return std::make_pair(p.first->id, p.second->id) < std::make_pair(q.first->id, q.second->id); });
  dContactGeom found[250];
  for (auto& [a, b] : pairs_) {
    dGeomID ga = a->geom, gb = b->geom;
    // ODE has no collider for two cylinders, or a cylinder and a capsule: one of them goes in as a faceted mesh.
    const int ta = dGeomGetClass(ga), tb = dGeomGetClass(gb);
    Shape* stand_in = nullptr;
    if (ta == dCylinderClass && (tb == dCylinderClass || tb == dCapsuleClass)) stand_in = a;
    else if (tb == dCylinderClass && ta == dCapsuleClass) stand_in = b;
    if (stand_in && stand_in->faceted) {
      dGeomSetPosition(stand_in->faceted, dGeomGetPosition(stand_in->geom)[0], dGeomGetPosition(stand_in->geom)[1],
                       dGeomGetPosition(stand_in->geom)[2]);
      dGeomSetRotation(stand_in->faceted, dGeomGetRotation(stand_in->geom));
      (stand_in == a ? ga : gb) = stand_in->faceted;
    }
    int n = dCollide(ga, gb, 250, found, sizeof found[0]);
    n = std::min(n, 250);
    const int most = std::min({max_contacts, a->max_contacts, b->max_contacts});
    if (n > most) {
      std::stable_sort(found, found + n, [](auto& p, auto& q) { return p.depth > q.depth; });
      n = std::max(most, 0);
    }
    const size_t first = contacts_.size();
    for (int i = 0; i < n; ++i) {
      Contact c;
      c.a = a;
      c.b = b;
      c.pos = vec(found[i].pos);
      c.normal = vec(found[i].normal);
      c.depth = found[i].depth;
      const double length = norm(c.normal);
      if (!finite(c.pos) || !std::isfinite(c.depth) || !(length > 0.5)) continue;
      c.normal = c.normal * (1 / length);
      contacts_.push_back(c);
    }
    if (a->wheel) merge_tread(*a, first);
    if (b->wheel) merge_tread(*b, first);
    const int kept = static_cast<int>(contacts_.size() - first);
    for (size_t i = first; i < contacts_.size(); ++i) contacts_[i].count = kept;
  }
  counters.contacts = contacts_.size();
}

// A wheel touches with the middle of its tread. ODE gives a contact at either edge; a robot that turns would then pivot on
// one of them (two rings under dry friction leave it open on which), and its effective track be off by the tread's width.
void World::merge_tread(const Shape& wheel, size_t first) {
  const Vec3 axis = rotate(wheel.link->X_WL.q * wheel.X_LC.q, Vec3{0, 0, 1});
  size_t kept = first;
  for (size_t i = first; i < contacts_.size(); ++i) {
    Contact c = contacts_[i];
    if (std::abs(dot(c.normal, axis)) < 0.1) {
      double low = dot(axis, c.pos), high = low;
      for (size_t k = contacts_.size() - 1; k > i; --k) {
        const Contact& other = contacts_[k];
        if (dot(other.normal, c.normal) < 0.999) continue;
        const double at = dot(axis, other.pos);
        low = std::min(low, at);
        high = std::max(high, at);
        if (other.depth > c.depth) c.depth = other.depth, c.pos = other.pos;
        contacts_.erase(contacts_.begin() + k);
      }
      c.pos += axis * ((low + high) / 2 - dot(axis, c.pos));
    }
    contacts_[kept++] = c;
  }
  contacts_.resize(kept);
}

// ------------------------------------------------------------------------------------------------ servo joints

void World::set_rates(Model& model) {
  for (auto& j : model.joints) {
    if (j->servo == ServoMode::Off) continue;
    Axis& a = j->axes[0];
    if (j->leader) {
      const Joint& l = *j->leader;
      const double q = l.servo == ServoMode::Locked ? l.target : l.axes[0].q + l.axes[0].qd * dt;
      j->target = std::min(std::max(j->multiplier * q + j->offset, a.lower), a.upper);
    }
    double rate = (j->target - a.q) / dt;
    if (j->servo == ServoMode::Locked) {
      if (j->catching_up) {
        const double most = a.velocity > 0 && a.velocity < kUnlimited ? a.velocity : 1.0;
        if (std::abs(rate) <= most) j->catching_up = false;
        rate = std::min(std::max(rate, -most), most);
      }
      j->rate = rate;
    } else {
      feed_forward(*j);
    }
  }
  model.jump = false;
  for (auto& j : model.joints)
    if (j->servo == ServoMode::Locked) model.jump |= std::max(std::abs(j->rate), std::abs(j->previous_rate)) > kJump;
  for (auto& c : model.clusters)
    if (c.moving) {
      spread_twists(c);
      for (Link* l : c.members)
        if (l->carrier) set_body_twist(l->body, l->v, l->w);
    }
}

// A joint in Motor mode whose command changes speed takes what is beyond along without a reaction on what carries it, as
// a locked one does - unless something holds it back.
void World::feed_forward(Joint& j) {
  Axis& a = j.axes[0];
  const double most = a.velocity > 0 && a.velocity < kUnlimited ? a.velocity : 100.0;
  const double wanted = std::min(std::max((j.target - j.previous_target) / dt, -most), most);
  const double change = wanted - j.rate;
  const bool free = std::abs(a.qd - j.rate) < 0.05 * std::abs(j.rate) + 1e-3;
  j.rate = wanted;
  if (!free || std::abs(change) < 1e-12) return;
  const Pose X_WJ = j.frame_W();
  const Vec3 delta = rotate(X_WJ.q, a.xyz) * change;
  std::set<dBodyID> done;
  for (Link* l : subtree(j)) {
    if (l->cluster < 0 || l->carrier) continue;
    const Cluster& c = j.model->clusters[l->cluster];
    if (!c.root || !done.insert(c.root->body).second) continue;
    dBodyID b = c.root->body;
    Vec3 v = vec(dBodyGetLinearVel(b)), w = vec(dBodyGetAngularVel(b));
    if (j.type == JointType::Revolute) {
      w += delta;
      v += cross(delta, vec(dBodyGetPosition(b)) - X_WJ.p);
    } else {
      v += delta;
    }
    set_body_twist(b, v, w);
  }
}

bool World::promote_path(Link* link) {
  bool any = false;
  for (; link; link = link->up_link)
    if (link->up && link->up->servo == ServoMode::Locked && link->up->sane) {
      link->up->servo = ServoMode::Motor;
      link->up->released = 0;
      link->model->dirty = true;
      ++counters.promotions;
      any = true;
    }
  return any;
}

// Where a moving link of a cluster touches something else, the servo joints above it become motors.
bool World::promote() {
  bool any = false;
  for (auto& m : models_)
    if (m->has_servo) {
      std::set<std::pair<int, int>> touching;
      for (auto& c : contacts_) {
        Link *la = c.a->link, *lb = c.b->link;
        if (la->model != m.get() && lb->model != m.get()) continue;
        const std::pair<int, int> pair{c.a->id, c.b->id};
        touching.insert(pair);
        if (m->take_exempt || m->exempt.count(pair)) continue;
        if (c.a->surface.collide_without_contact || c.b->surface.collide_without_contact) continue;
        if (la->model == m.get() && la->moving) any |= promote_path(la);
        if (lb->model == m.get() && lb->moving) any |= promote_path(lb);
      }
      if (m->take_exempt) {
        m->exempt = touching;
        m->take_exempt = false;
      } else {
        for (auto it = m->exempt.begin(); it != m->exempt.end();)
          it = touching.count(*it) ? std::next(it) : m->exempt.erase(it);
      }
      // Contacts keep the motors above them going.
      for (auto& j : m->joints)
        if (j->servo == ServoMode::Motor) ++j->released;
      for (auto& c : contacts_)
        for (Link* l : {c.a->link, c.b->link}) {
          if (l->model != m.get() || m->exempt.count({c.a->id, c.b->id})) continue;
          for (Joint* j = l->parent_joint; j; j = j->parent ? j->parent->parent_joint : nullptr) j->released = 0;
        }
    }
  return any;
}

void World::demote() {
  for (auto& m : models_)
    for (auto& j : m->joints) {
      if (j->servo != ServoMode::Motor || j->released < 20) continue;
      const double off = std::abs(j->target - j->axes[0].q);
      if (off < 1e-4 || j->released > 1000) {
        j->servo = ServoMode::Locked;
        j->catching_up = off >= 1e-4;
        m->dirty = true;
      }
    }
}

// What the motor needs to hold the links beyond against gravity.
void World::motor_load(Joint& j) {
  const Pose X_WJ = j.frame_W();
  const Vec3 axis = rotate(X_WJ.q, j.axes[0].xyz);
  double load = 0, mass = 0, reach = 0;
  for (Link* l : subtree(j)) {
    const Vec3 f = l->gravity ? gravity * l->mass : Vec3{};
    load += j.type == JointType::Revolute ? dot(axis, cross(l->com_W() - X_WJ.p, f)) : dot(axis, f);
    mass += l->mass;
    reach = std::max(reach, norm(l->com_W() - X_WJ.p) + l->size);
  }
  double effort = j.axes[0].effort;
  if (effort <= 0 || effort > kUnlimited) {  // none given: enough to carry itself twice over
    effort = 2 * mass * std::max(norm(gravity), 1.0) * (j.type == JointType::Revolute ? reach : 1.0) + 1.0;
  }
  j.load = std::abs(load) + effort;
}

// ------------------------------------------------------------------------------------------------ forces

void World::apply_axis_force(Joint& j, int axis, double f) {
  if (f == 0) return;
  const dBodyID child = body_of(j.child), parent = body_of(j.parent);
  const Pose X_WJ = axis == 0 ? j.frame_W() : j.child->X_WL * j.X_CJ;
  const Vec3 v = rotate(X_WJ.q, j.axes[axis].xyz) * f;
  if (j.type == JointType::Prismatic) {
    const Vec3 p = (j.child->X_WL * j.X_CJ).p;
    if (child) dBodyAddForceAtPos(child, v.x, v.y, v.z, p.x, p.y, p.z);
    if (parent) dBodyAddForceAtPos(parent, -v.x, -v.y, -v.z, p.x, p.y, p.z);
  } else {
    if (child) dBodyAddTorque(child, v.x, v.y, v.z);
    if (parent) dBodyAddTorque(parent, -v.x, -v.y, -v.z);
  }
}

// Motor, friction, limits, damping and spring of one axis for this step.
void World::update_axis(Joint& j, int i) {
  Axis& a = j.axes[i];
  double velocity = 0, most = 0, softness = 1e-10, force = a.force;
  double damping = a.damping;
  const double stiffness = a.spring_stiffness;
  const double pull = stiffness > 0 ? -stiffness * (a.q - a.spring_reference) : 0;
  const double stiff = dt * (damping + dt * stiffness) * j.inverse_inertia[i];
  if (i == 0 && j.servo == ServoMode::Motor) {
    motor_load(j);
    const double fastest = a.velocity > 0 && a.velocity < kUnlimited ? a.velocity : 100.0;
    velocity = std::min(std::max((j.target - a.q) / dt, -fastest), fastest);
    most = j.load;
  } else if (a.motor_force > 0) {
    velocity = a.motor_velocity;
    most = a.motor_force;
  } else if (a.friction > 0) {
    most = a.friction;
  } else if (damping + stiffness > 0 && (j.implicit_spring_damper || stiff > 0.05) &&
             a.q - a.lower > kNearStop && a.upper - a.q > kNearStop) {
    // Implicit: a motor row whose softness is the damper, and whose speed is that at which the spring balances it. Not at a
    // stop, where ODE turns motors into torques of their greatest size.
    const double d = damping + dt * stiffness;
    velocity = pull / d;
    softness = 1 / d;
    most = dInfinity;
    damping = 0;
  }
  if (softness <= 1e-10) {
    if (stiff > 0.05) damping /= 1 + stiff;
    force += pull - damping * a.qd;
  }
  set_limot(j, i, dParamFMax, most);
  a.drive = velocity * j.sign;
  set_limot(j, i, dParamVel, a.drive);
  set_limot(j, i, dParamCFM, softness);
  // ODE knows angles within a turn: its stops move along with the turns.
  double lower = a.lower, upper = a.upper;
  if (j.type == JointType::Revolute && std::abs(a.q) > 3) {
    const double turns = 2 * kPi * std::round((a.q - j.sign * dJointGetHingeAngle(j.joint)) / (2 * kPi));
    lower -= turns;
    upper -= turns;
  }
  if (upper - lower > 1e-9) {  // with both stops at one place ODE holds the joint there by itself
    lower += kStopSkin;
    upper -= kStopSkin;
  }
  if (j.sign < 0) std::tie(lower, upper) = std::make_pair(-upper, -lower);
  set_limot(j, i, dParamLoStop, std::isfinite(lower) ? lower : -dInfinity);
  set_limot(j, i, dParamHiStop, std::isfinite(upper) ? upper : dInfinity);
  set_limot(j, i, dParamLoStop, std::isfinite(lower) ? lower : -dInfinity);  // ODE refuses a low stop above the old high one
  apply_axis_force(j, i, force);
}

void World::apply_forces() {
  dWorldSetGravity(world_, gravity.x, gravity.y, gravity.z);
  dWorldSetERP(world_, erp);
  dWorldSetCFM(world_, std::max(cfm, 1e-10));
  for (auto& m : models_) {
    for (auto& l : m->links) {
      l->applied_force = l->force;
      l->applied_torque = l->torque;
      if (l->cluster < 0) continue;
      Cluster& c = m->clusters[l->cluster];
      if (!c.root) continue;
      dBodyID body = c.root->body;
      if (l->force.x != 0 || l->force.y != 0 || l->force.z != 0) {
        const Vec3 p = l->com_W();
        dBodyAddForceAtPos(body, l->force.x, l->force.y, l->force.z, p.x, p.y, p.z);
      }
      dBodyAddTorque(body, l->torque.x, l->torque.y, l->torque.z);
    }
    for (auto& c : m->clusters)
      if (c.root && !c.uniform_gravity && c.gravity_mass > 0) {
        const Vec3 p = c.root->X_WL * c.gravity_com, f = gravity * c.gravity_mass;
        dBodyAddForceAtPos(c.root->body, f.x, f.y, f.z, p.x, p.y, p.z);
      }
    for (auto& j : m->joints)
      if (j->joint)
        for (int i = 0; i < j->axis_count; ++i) update_axis(*j, i);
    apply_inertial_forces(*m);
  }
}

// ------------------------------------------------------------------------------------------------ contacts

// N: the share of the lighter model's weight, taken as even; for what only needs its size.
double World::borne_by_contact(const Link& a, const Link& b) const {
  double least = dInfinity;
  for (const Link* l : {&a, &b})
    if (!l->model->is_static) least = std::min(least, l->model->mass / l->model->contact_count);
  return std::isfinite(least) ? least * norm(gravity) : 0;
}

void World::make_contact_joints() {
  feedback_.clear();
  size_t watched = 0;
  auto wanted = [](const Contact& c) { return c.a->watched || c.b->watched || c.a->link->weighed || c.b->link->weighed; };
  for (auto& m : models_) m->contact_count = 0;
  for (auto& c : contacts_) {
    watched += wanted(c);
    ++c.a->link->model->contact_count;
    ++c.b->link->model->contact_count;
  }
  feedback_.resize(watched);
  size_t next = 0;
  // Resting contacts must persist, or friction is lost every other step: this much overlap (m) is left alone.
  constexpr double slack = 2e-5;
  for (auto& c : contacts_) {
    const Surface &sa = c.a->surface, &sb = c.b->surface;
    if (sa.collide_without_contact || sb.collide_without_contact) continue;
    Link *la = c.a->link, *lb = c.b->link;
    dBodyID ba = body_of(la), bb = body_of(lb);
    if (la->carrier) ba = nullptr;  // kinematic: only its surface speed counts
    if (lb->carrier) bb = nullptr;
    const Cluster &ca = la->model->clusters[la->cluster], &cb = lb->model->clusters[lb->cluster];
    if (la->carrier && ca.root) ba = ca.root->body;
    if (lb->carrier && cb.root) bb = cb.root->body;
    if (ba == bb) continue;

    dContact d{};
    d.geom.pos[0] = c.pos.x; d.geom.pos[1] = c.pos.y; d.geom.pos[2] = c.pos.z;
    Vec3 n = c.normal;
    Link *l1 = la, *l2 = lb;
    c.swapped = !ba;
    if (c.swapped) {  // ODE's contact motion is only well defined with a first body
      std::swap(ba, bb);
      std::swap(l1, l2);
      n = -n;
    }
    d.geom.normal[0] = n.x; d.geom.normal[1] = n.y; d.geom.normal[2] = n.z;

    const double kp = sa.kp > 0 && sb.kp > 0 ? 1 / (1 / sa.kp + 1 / sb.kp) : 0;
    const double kd = sa.kd + sb.kd;
    const double soft = dt * kp + kd;
    const double soft_erp = soft > 0 ? dt * kp / soft : erp;
    d.surface.mode = dContactMu2 | dContactSoftERP | dContactSoftCFM | dContactApprox1 | dContactFDir1 | dContactBounce |
                     dContactSlip1 | dContactSlip2;
    d.surface.mu = std::max(std::min(sa.mu, sb.mu), 0.0);
    d.surface.mu2 = std::max(std::min(sa.mu2, sb.mu2), 0.0);
    d.surface.soft_erp = soft_erp;
    double inverse_mass = 0;
    for (Link* l : {la, lb})
      if (!l->model->is_static) inverse_mass += 1 / l->model->mass;
    d.surface.soft_cfm = std::max(soft > 0 ? 1 / soft : 1e-9, contact_softness * dt * inverse_mass);
    d.surface.slip1 = (sa.slip1 + sb.slip1) * c.count + friction_softness * dt * inverse_mass;
    d.surface.slip2 = (sa.slip2 + sb.slip2) * c.count + friction_softness * dt * inverse_mass;
    d.surface.bounce = std::min(sa.restitution, sb.restitution);
    d.surface.bounce_vel = std::min(sa.bounce_threshold, sb.bounce_threshold);

    // Depth beyond the tolerated one, cut so that it is corrected no faster than allowed. What the model's own weight presses
    // in at this stiffness is no error to correct: cut as well, it would carry less than the weight, which then sinks and sinks.
    double depth = std::max(c.depth - std::max(std::min(sa.min_depth, sb.min_depth), slack), 0.0);
    double fastest = contact_max_vel;
    for (double v : {sa.max_vel, sb.max_vel})
      if (v >= 0) fastest = std::min(fastest, v);
    const double pressed_in = kp > 0 && inverse_mass > 0 ? norm(gravity) / (inverse_mass * kp) : 0;
    if (soft_erp > 0) depth = std::min(depth, fastest * dt / soft_erp + pressed_in);
    d.geom.depth = depth;

    // First friction direction, where friction is not the same all around: what a collision asks for (of two that do, the one
    // with less friction), as seen in the contact plane; else any tangent.
    Vec3 t1{};
    const bool second = norm(sb.fdir1) > 0 && (norm(sa.fdir1) == 0 || sb.mu < sa.mu);
    const Shape& directed = second ? *c.b : *c.a;
    const bool isotropic = d.surface.mu == d.surface.mu2 && sa.slip1 + sb.slip1 == sa.slip2 + sb.slip2;
    if (isotropic) {
      // Where it slides, friction is to point against the motion, not along two fixed axes at once: fully along the slip, and
      // across it in proportion (Coulomb), or a wheel that spins would still be held sideways like one that stands.
      t1 = la->velocity_at(c.pos) - lb->velocity_at(c.pos);
      t1 = t1 - n * dot(n, t1);
      const double speed = norm(t1), load = borne_by_contact(*la, *lb);
      if (speed < 1e-5) t1 = {};
      else if (load > 0 && d.surface.mu > 0) d.surface.slip2 += speed / (d.surface.mu * load);
    } else if (norm(directed.surface.fdir1) > 0) {
      t1 = rotate(directed.link->X_WL.q * directed.X_LC.q, directed.surface.fdir1);
      t1 = t1 - n * dot(n, t1);
    }
    if (norm(t1) < 1e-6) {
      const dReal nn[3] = {n.x, n.y, n.z};
      dReal p[3], q[3];
      dPlaneSpace(nn, p, q);
      t1 = vec(p);
    }
    t1 = t1 * (1 / norm(t1));
    d.fdir1[0] = t1.x; d.fdir1[1] = t1.y; d.fdir1[2] = t1.z;

    // Surface speed that the bodies do not have: links moved by servo joints.
    auto driven = [&](const Link* l) { return l->moving || (cluster_of(*l).by && !cluster_of(*cluster_of(*l).by).root->model->jump); };
    const bool driven1 = driven(l1), driven2 = driven(l2);
    if (driven1 || driven2) {
      auto slide = [&](Link* l, dBodyID body) {
        Vec3 u = l->velocity_at(c.pos);
        if (body) u = u - (vec(dBodyGetLinearVel(body)) + cross(vec(dBodyGetAngularVel(body)), c.pos - vec(dBodyGetPosition(body))));
        return u;
      };
      const Vec3 u = (driven1 ? slide(l1, ba) : Vec3{}) - (driven2 ? slide(l2, bb) : Vec3{});
      d.surface.mode |= dContactMotion1 | dContactMotion2 | dContactMotionN;
      d.surface.motion1 = -dot(t1, u);
      d.surface.motion2 = -dot(cross(n, t1), u);
      d.surface.motionN = -dot(n, u);
    }
    c.joint = dJointCreateContact(world_, contact_group_, &d);
    dJointAttach(c.joint, ba, bb);
    if (wanted(c)) {
      c.feedback = static_cast<int>(next);
      dJointSetFeedback(c.joint, &feedback_[next++]);
    }
  }
}

std::vector<ContactRecord> World::contact_records() {
  std::vector<ContactRecord> out;
  out.reserve(contacts_.size());
  for (auto& c : contacts_) {
    ContactRecord r{};
    r.collision1 = c.a->id;
    r.collision2 = c.b->id;
    r.position[0] = c.pos.x; r.position[1] = c.pos.y; r.position[2] = c.pos.z;
    r.normal[0] = c.normal.x; r.normal[1] = c.normal.y; r.normal[2] = c.normal.z;
    r.depth = c.depth;
    if (c.feedback >= 0 && c.feedback < static_cast<int>(feedback_.size())) {
      // ODE gives what acts on its first body about that body's CoM; here: on the first link, about its CoM.
      const dJointFeedback& f = feedback_[c.feedback];
      const Vec3 force = c.swapped ? -vec(f.f1) : vec(f.f1);
      const Vec3 torque = cross(c.pos - c.a->link->com_W(), force);
      r.force[0] = force.x; r.force[1] = force.y; r.force[2] = force.z;
      r.torque[0] = torque.x; r.torque[1] = torque.y; r.torque[2] = torque.z;
    }
    out.push_back(r);
  }
  return out;
}

// ------------------------------------------------------------------------------------------------ solving

void World::remember_bodies(std::vector<BodyState>& out, const std::vector<Cluster*>& clusters) const {
  out.clear();
  for (Cluster* c : clusters) {
    BodyState s;
    s.body = c->root->body;
    s.p = vec(dBodyGetPosition(s.body));
    s.q = quat(dBodyGetQuaternion(s.body));
    s.v = vec(dBodyGetLinearVel(s.body));
    s.w = vec(dBodyGetAngularVel(s.body));
    s.f = vec(dBodyGetForce(s.body));
    s.t = vec(dBodyGetTorque(s.body));
    std::memcpy(s.R, dBodyGetRotation(s.body), sizeof s.R);
    out.push_back(s);
  }
}

void World::recall_bodies(const std::vector<BodyState>& in) const {
  for (auto& s : in) {
    set_body_pose(s.body, {s.p, s.q});
    set_body_twist(s.body, s.v, s.w);
    dBodySetForce(s.body, s.f.x, s.f.y, s.f.z);
    dBodySetTorque(s.body, s.t.x, s.t.y, s.t.z);
    const dReal q[4] = {s.q.w, s.q.x, s.q.y, s.q.z};
    std::memcpy(const_cast<dReal*>(dBodyGetQuaternion(s.body)), q, sizeof q);
    std::memcpy(const_cast<dReal*>(dBodyGetRotation(s.body)), s.R, sizeof s.R);
  }
}

std::string World::island_names(const std::vector<Cluster*>& clusters) const {
  std::vector<std::string> names;
  for (Cluster* c : clusters) {
    const std::string& n = c->root->model->name;
    if (std::find(names.begin(), names.end(), n) == names.end()) names.push_back(n);
  }
  std::string out;
  for (size_t i = 0; i < names.size() && i < 3; ++i) out += (i ? ", " : "") + names[i];
  if (names.size() > 3) out += " and " + std::to_string(names.size() - 3) + " more";
  return out;
}

void World::report(const std::string& text, const std::string& who) {
  const std::string line = (who.empty() ? "" : who + ": ") + text;
  if (message_counts_[line]++ == 0) messages_.push_back(line);
}

std::vector<std::string> World::take_messages() {
  std::vector<std::string> out;
  out.swap(messages_);
  return out;
}

void World::run(bool direct, int iterations_wanted) {
  try {
    if (direct) {
      dWorldStep(world_, dt);
    } else {
      dWorldSetQuickStepNumIterations(world_, iterations_wanted);
      dWorldSetQuickStepW(world_, sor);
      dWorldQuickStep(world_, dt);
    }
  } catch (const OdeFailure&) {
    // What the pass has not moved stays where it is; guard_nan mends what it has spoilt.
  }
}

// Finds the islands, puts those at rest to sleep, and steps the others: small ones exactly, large ones iteratively.
void World::solve() {
  nodes_.clear();
  for (auto& m : models_)
    for (auto& c : m->clusters) {
      c.node = -1;
      if (!c.root || c.root->kinematic) continue;
      c.node = static_cast<int>(nodes_.size());
      nodes_.push_back(&c);
    }
  std::vector<int> group(nodes_.size());
  std::iota(group.begin(), group.end(), 0);
  auto find = [&](int i) {
    while (group[i] != i) i = group[i] = group[group[i]];
    return i;
  };
  auto node = [&](const Link* l) { return l && !l->carrier ? l->model->clusters[l->cluster].node : -1; };
  auto merge = [&](int a, int b) {
    if (a < 0 || b < 0) return;
    a = find(a), b = find(b);
    if (a != b) group[std::max(a, b)] = std::min(a, b);
  };
  auto contact_node = [&](const Link* l) { return l->model->clusters[l->cluster].node; };
  for (auto& m : models_)
    for (auto& j : m->joints)
      if (j->joint) merge(node(j->parent), node(j->child));
  for (auto& t : ties_)
    if (t.joint) merge(node(t.parent), node(t.child));
  for (auto& c : contacts_)
    if (c.joint) merge(contact_node(c.a->link), contact_node(c.b->link));

  islands_.clear();
  std::vector<int> island_of(nodes_.size(), -1);
  for (size_t i = 0; i < nodes_.size(); ++i) {
    const int g = find(static_cast<int>(i));
    if (island_of[g] < 0) {
      island_of[g] = static_cast<int>(islands_.size());
      islands_.emplace_back();
    }
    island_of[i] = island_of[g];
    islands_[island_of[i]].clusters.push_back(nodes_[i]);
  }
  for (auto& m : models_)
    for (auto& j : m->joints)
      if (j->joint) {
        const int n = std::max(node(j->parent), node(j->child));
        if (n < 0) continue;
        islands_[island_of[n]].joints = true;
        islands_[island_of[n]].rows += j->type == JointType::Ball ? 3 : j->type == JointType::Universal ? 6 : 6;
      }
  for (auto& t : ties_)
    if (const int n = std::max(node(t.parent), node(t.child)); t.joint && n >= 0) {
      islands_[island_of[n]].joints = true;
      islands_[island_of[n]].rows += 6;
    }
  for (auto& c : contacts_)
    if (c.joint) {
      const int n = std::max(contact_node(c.a->link), contact_node(c.b->link));
      if (n >= 0) islands_[island_of[n]].contact_rows += 3;
    }

  std::vector<Cluster*> exact, touching, iterative;
  std::vector<Island*> touching_islands;
  for (auto& island : islands_) {
    bool all_may_sleep = true, idle = true;
    for (Cluster* c : island.clusters) {
      all_may_sleep &= c->root->model->may_sleep;
      if (!c->asleep) island.awake = true;
    }
    if (island.awake && all_may_sleep)
      for (Cluster* c : island.clusters) {
        dBodyID b = c->root->body;
        const Vec3 v = vec(dBodyGetLinearVel(b)), w = vec(dBodyGetAngularVel(b));
        if (dot(v, v) < 0.01 && dot(w, w) < 0.01) {
          ++c->idle_steps;
          c->idle_time += dt;
        } else {
          c->idle_steps = 0;
          c->idle_time = 0;
        }
        if (c->idle_steps < 5 || c->idle_time < 1.0) idle = false;
      }
    if (island.awake && all_may_sleep && idle && island.contact_rows > 0) {
      for (Cluster* c : island.clusters) {
        c->asleep = true;
        set_body_twist(c->root->body, {}, {});
        c->root->v = c->root->w = {};
        spread_twists(*c);
      }
      island.awake = false;
    }
    for (Cluster* c : island.clusters) {
      if (island.awake) c->asleep = false;
      if (!island.awake) dBodySetForce(c->root->body, 0, 0, 0), dBodySetTorque(c->root->body, 0, 0, 0);
    }
    if (!island.awake) continue;
    auto& kind = island.contact_rows == 0 ? exact : island.rows + island.contact_rows <= (island.joints ? direct_rows : heap_rows) ? touching : iterative;
    kind.insert(kind.end(), island.clusters.begin(), island.clusters.end());
    if (&kind == &touching) touching_islands.push_back(&island);
  }

  auto enable = [&](const std::vector<Cluster*>& clusters, bool on) {
    for (Cluster* c : clusters) on ? dBodyEnable(c->root->body) : dBodyDisable(c->root->body);
  };
  // Kinematic bodies move in exactly one pass.
  std::vector<dBodyID> kinematic;
  for (auto& m : models_)
    for (auto& l : m->links)
      if (l->carrier || (l->kinematic && l->cluster >= 0 && m->clusters[l->cluster].root == l.get())) kinematic.push_back(l->body);
  for (dBodyID b : kinematic) dBodyEnable(b);

  auto run_iterative = [&](const std::vector<Cluster*>& clusters, int times, std::vector<std::string>& said) {
    said.clear();
    enable(clusters, true);
    {
      std::lock_guard<std::mutex> lock(ode_mutex);
      dRandSetSeed(static_cast<unsigned long>(mix(seed ^ mix(iterations)) & 0xffffffffu));
      run(false, times);
    }
    enable(clusters, false);
    ++counters.quick;
    for (auto& s : said) report("ODE: " + s, island_names(clusters));
    said.clear();
  };

  std::vector<std::string> said;
  const Listening listening(said);
  remember_bodies(before_, nodes_);
  for (Cluster* c : nodes_) {
    dBodyID b = c->root->body;
    const Vec3 f = vec(dBodyGetForce(b)), t = vec(dBodyGetTorque(b));
    const double size = norm(t);
    const double spin = size > 0 ? size * inverse_along(c->inertia, rotate(conjugate(c->root->X_WL.q), t * (1 / size))) : 0;
    if (norm(f) / c->mass * dt < kFastest && spin * dt < kFastest) continue;
    dBodySetForce(b, 0, 0, 0);
    dBodySetTorque(b, 0, 0, 0);
    report("a force beyond all reason was left out. Look at its masses, inertias and commands", c->root->model->name);
  }

  if (!exact.empty() || !kinematic.empty()) {
    enable(exact, true);
    run(true, 0);
    enable(exact, false);
    ++counters.direct;
    for (auto& s : said) report("ODE: " + s, island_names(exact));
    said.clear();
  }
  // ODE wakes them again with the islands that they touch: this is how far they have come in this step.
  std::vector<Pose> kinematic_poses;
  for (dBodyID b : kinematic) {
    dBodyDisable(b);
    kinematic_poses.push_back(body_pose(b));
  }
  if (!touching.empty()) {
    std::vector<BodyState> start;
    remember_bodies(start, touching);
    enable(touching, true);
    run(true, 0);
    enable(touching, false);
    ++counters.direct;
    if (!said.empty()) {
      // The direct solver lost its way in some island: find it, and give that one to the iterative solver.
      recall_bodies(start);
      for (Island* island : touching_islands) {
        said.clear();
        remember_bodies(start, island->clusters);
        enable(island->clusters, true);
        run(true, 0);
        enable(island->clusters, false);
        if (said.empty()) continue;
        recall_bodies(start);
        // Small, so that many more iterations than usual are affordable.
        run_iterative(island->clusters, 10 * iters, said);
        ++counters.fallbacks;
      }
      said.clear();
    }
  }
  if (!iterative.empty()) run_iterative(iterative, iters, said);
  for (size_t i = 0; i < kinematic.size(); ++i) {
    set_body_pose(kinematic[i], kinematic_poses[i]);
    dBodyDisable(kinematic[i]);
  }
}

// A body whose numbers are lost goes back to where it was, at rest.
void World::guard_nan() {
  for (auto& s : before_) {
    const bool good = finite(body_pose(s.body)) && finite(vec(dBodyGetLinearVel(s.body))) &&
                      finite(vec(dBodyGetAngularVel(s.body))) && norm(vec(dBodyGetPosition(s.body))) < kFarthest;
    if (good) continue;
    for (auto& n : nodes_)
      if (n->root->body == s.body)
        report("its motion became infinite; it was stopped where it was. Look at its masses, inertias and commands",
               n->root->model->name);
    BodyState still = s;
    still.v = still.w = still.f = still.t = {};
    recall_bodies({still});
  }
}

// ------------------------------------------------------------------------------------------------ results

void World::read_joint(Joint& j) {
  const Pose X_WJ = j.frame_W();
  const Pose X_J = inverse(X_WJ) * j.child->X_WL * j.X_CJ;
  const Vec3 vp = j.parent ? j.parent->velocity_at(j.child->X_WL * j.X_CJ.p) : Vec3{}, wp = j.parent ? j.parent->w : Vec3{};
  const Vec3 w = j.child->w - wp;
  auto turn = [&](Axis& a, double angle) {
    a.q = angle + 2 * kPi * std::round((a.q - angle) / (2 * kPi));
  };
  switch (j.type) {
    case JointType::Revolute: {
      Axis& a = j.axes[0];
      a.qd = dot(w, rotate(X_WJ.q, a.xyz));
      turn(a, 2 * std::atan2(dot({X_J.q.x, X_J.q.y, X_J.q.z}, a.xyz), X_J.q.w));
      break;
    }
    case JointType::Prismatic: {
      Axis& a = j.axes[0];
      a.q = dot(X_J.p, a.xyz);
      a.qd = dot(j.child->velocity_at(j.child->X_WL * j.X_CJ.p) - vp, rotate(X_WJ.q, a.xyz));
      break;
    }
    case JointType::Universal: {
      const Vec3 x = j.axes[0].xyz, y = j.axes[1].xyz, z = cross(x, y);
      const Vec3 cx = rotate(X_J.q, x), cy = rotate(X_J.q, y), cz = rotate(X_J.q, z);
      const Vec3 a0 = rotate(X_WJ.q, x), a1 = rotate((j.child->X_WL * j.X_CJ).q, y);
      j.axes[0].qd = dot(w, a0);
      j.axes[1].qd = dot(w, a1);
      turn(j.axes[0], std::atan2(dot(z, cy), dot(y, cy)));
      turn(j.axes[1], std::atan2(dot(x, cz), dot(x, cx)));
      break;
    }
    default: break;
  }
}

void World::read_feedback(Joint& j) {
  if (!j.watched || !j.joint) return;
  const dJointFeedback& f = j.ode_feedback;
  const bool child_first = j.sign > 0;
  const Vec3 at = j.frame_W().p;
  const dBodyID first = dJointGetBody(j.joint, 0);
  const Vec3 force = vec(f.f1) + j.carried_force;
  const Vec3 torque = vec(f.t1) + j.carried_torque - cross(at - vec(dBodyGetPosition(first)), force);
  j.carried_force = j.carried_torque = {};
  j.feedback.child_force = child_first ? force : -force;
  j.feedback.child_torque = child_first ? torque : -torque;
  j.feedback.parent_force = -j.feedback.child_force;
  j.feedback.parent_torque = -j.feedback.child_torque;
}

void World::momentum(const Load& load, Vec3& linear, Vec3& spin) const {
  linear = spin = {};
  for (const Link* l : load.links) {
    const Vec3 p = l->velocity_at(l->com_W()) * l->mass;
    linear += p;
    spin += rotate(l->X_WL.q, l->inertia * rotate(conjugate(l->X_WL.q), l->w)) + cross(l->com_W() - load.anchor, p);
  }
}

// A servo joint held exactly is no joint for ODE. What it bears follows from what is beyond: the change of its momentum less what
// else acts on it. Before the step ...
void World::weigh(Model& model) {
  for (auto& l : model.links) l->weighed = false;
  for (auto& j : model.joints) {
    Load& load = j->load_beyond;
    load.links.clear();
    if (!j->watched || j->servo != ServoMode::Locked) continue;
    bool loop = false;
    load.links = subtree(*j, &loop);
    if (loop) load.links.clear();
    load.anchor = j->frame_W().p;
    load.force = load.torque = {};
    momentum(load, load.momentum, load.spin);
    for (Link* l : load.links) {
      l->weighed = true;
      const Vec3 f = (l->gravity ? gravity * l->mass : Vec3{}) + l->force;
      load.force += f;
      load.torque += cross(l->com_W() - load.anchor, f) + l->torque;
    }
  }
}

// ... and after it.
void World::read_load(Joint& j) {
  const Load& load = j.load_beyond;
  if (!j.watched || j.servo != ServoMode::Locked) return;
  j.feedback = {};
  if (load.links.empty()) return;
  Vec3 linear, spin, force = load.force, torque = load.torque;
  momentum(load, linear, spin);
  auto beyond = [&](const Link* l) { return std::find(load.links.begin(), load.links.end(), l) != load.links.end(); };
  for (auto& c : contacts_) {
    const bool a = beyond(c.a->link), b = beyond(c.b->link);
    if (c.feedback < 0 || a == b) continue;
    const Vec3 f = vec(feedback_[c.feedback].f1) * ((c.swapped ? -1.0 : 1.0) * (a ? 1.0 : -1.0));
    force += f;
    torque += cross(c.pos - load.anchor, f);
  }
  for (auto& t : ties_) {
    const bool child = beyond(t.child), parent = t.parent && beyond(t.parent);
    if (!t.joint || child == parent) continue;
    const bool first = child == (body_of(t.child) != nullptr);  // whether ODE's first body is of the load
    const Vec3 f = vec(first ? t.feedback.f1 : t.feedback.f2), at = vec(dBodyGetPosition(dJointGetBody(t.joint, first ? 0 : 1)));
    force += f;
    torque += vec(first ? t.feedback.t1 : t.feedback.t2) + cross(at - load.anchor, f);
  }
  j.feedback.child_force = -force;
  j.feedback.child_torque = -torque;
  if (!j.model->jump) {
    j.feedback.child_force += (linear - load.momentum) * (1 / dt);
    j.feedback.child_torque += (spin - load.spin) * (1 / dt);
  }
  j.feedback.parent_force = -j.feedback.child_force;
  j.feedback.parent_torque = -j.feedback.child_torque;
}

// Puts the links of a tree of ODE joints exactly where the joint angles say, moving as the joint speeds say, from what the
// world holds or the first link outwards. Bodies move along straight lines within a step, while their joints would have
// them on arcs. Left to ODE's correcting forces, that costs energy, fights with static friction (turning wheels scrub and
// carry uneven loads) and shows as gaping joints. What floats free keeps its centre of mass and its momentum.
void World::project_joints(Model& model) {
  if (model.tree.empty()) return;
  for (auto& c : model.clusters) c.moved = false;
  for (auto& t : model.tree) {
    read_joint(*t.joint);
    // A hard stop is where it is: nothing overshoots it, and nothing is thrown back by the correction.
    if (t.joint->stop_cfm <= 0 && t.joint->type != JointType::Universal)
      for (Axis& a : t.joint->axes) a.q = std::min(std::max(a.q, a.lower), a.upper);
  }
  for (auto& t : model.tree) {
    Joint& j = *t.joint;
    Cluster& c = model.clusters[t.cluster];
    if (c.asleep || c.root->kinematic) continue;
    Link &child = *j.child, &moved = t.outward ? child : *j.parent;
    Pose X_J = j.motion(j.axes[0].q);
    if (j.type == JointType::Universal)
      X_J.q = axis_angle(j.axes[0].xyz, j.axes[0].q) * axis_angle(j.axes[1].xyz, j.axes[1].q);
    else if (j.type == JointType::Ball)
      X_J.q = conjugate(j.frame_W().q) * child.X_WL.q * j.X_CJ.q;
    const Pose wanted = t.outward ? j.frame_W() * X_J * inverse(j.X_CJ)
                                  : child.X_WL * j.X_CJ * inverse(X_J) * inverse(j.X_PJ);
    c.root->X_WL = normalized(wanted * inverse(moved.X_RL));
    spread_poses(c);

    // Velocities: of the moved link, then of its root.
    const Pose X_WP = j.frame_W(), X_WC = child.X_WL * j.X_CJ;
    const Vec3 first = rotate(X_WP.q, j.axes[0].xyz) * j.axes[0].qd;
    Vec3 turn, slide;
    if (j.type == JointType::Revolute) turn = first;
    else if (j.type == JointType::Prismatic) slide = first;
    else if (j.type == JointType::Universal) turn = first + rotate(X_WC.q, j.axes[1].xyz) * j.axes[1].qd;
    Vec3 w, v;  // of the moved link, at the joint origin
    if (t.outward) {
      w = (j.parent ? j.parent->w : Vec3{}) + turn;
      v = (j.parent ? j.parent->velocity_at(X_WC.p) : Vec3{}) + slide;
    } else {
      w = child.w - turn;
      v = child.velocity_at(X_WC.p) - slide;
    }
    if (j.type == JointType::Ball) w = moved.w;
    // The cluster moves as the moved link does, less what servo joints inside do.
    c.root->w += w - moved.w;
    c.root->v += v + cross(w, moved.X_WL.p - X_WC.p) - moved.v + cross(w - moved.w, c.root->X_WL.p - moved.X_WL.p);
    spread_twists(c, c.carriers);
    c.moved = j.projected = true;
  }
  for (int head : model.tree_heads) {
    double mass = 0;
    Vec3 shift, kick;
    auto add = [&](const Cluster& c) {
      mass += c.mass;
      const Vec3 com = c.root->X_WL * c.com;
      shift += (vec(dBodyGetPosition(c.root->body)) - com) * c.mass;
      kick += (vec(dBodyGetLinearVel(c.root->body)) + c.a * dt - c.root->velocity_at(com)) * c.mass;
    };
    auto move = [&](Cluster& c) {
      c.root->X_WL.p += shift;
      c.root->v += kick;
      c.moved = true;
    };
    add(model.clusters[head]);
    for (auto& t : model.tree)
      if (t.head == head) add(model.clusters[t.cluster]);
    shift = shift * (1 / mass);
    kick = kick * (1 / mass);
    move(model.clusters[head]);
    for (auto& t : model.tree)
      if (t.head == head) move(model.clusters[t.cluster]);
  }
  for (auto& c : model.clusters)
    if (c.moved) {
      const Vec3 com = c.root->X_WL * c.com;
      set_body_pose(c.root->body, {com, c.root->X_WL.q});
      const Vec3 v = c.root->velocity_at(com);
      set_body_twist(c.root->body, v, c.root->w);
    }
}

// The order in which project_joints goes: from what the world holds, else from the first link, outwards, each cluster once.
void World::plan_tree(Model& model) {
  model.tree.clear();
  model.tree_heads.clear();
  std::vector<bool> seen(model.clusters.size(), false);
  std::vector<int> queue;
  size_t next = 0;
  auto grow = [&](int head) {
    for (; next < queue.size(); ++next)
      for (auto& j : model.joints) {
        if (!j->joint || !j->parent) continue;
        const int child = j->child->cluster, parent = j->parent->cluster;
        const bool outward = parent == queue[next];
        const int other = outward ? child : child == queue[next] ? parent : -1;
        if (other < 0 || seen[other]) continue;
        seen[other] = true;
        model.tree.push_back({j.get(), other, head, outward});
        queue.push_back(other);
      }
  };
  auto visit = [&](int cluster) {
    seen[cluster] = true;
    queue.push_back(cluster);
  };
  for (size_t i = 0; i < model.clusters.size(); ++i)
    if (!model.clusters[i].root) visit(static_cast<int>(i));
  for (auto& j : model.joints)
    if (j->joint && !j->parent && !seen[j->child->cluster]) {
      model.tree.push_back({j.get(), j->child->cluster, -1, true});
      visit(j->child->cluster);
    }
  grow(-1);
  for (size_t i = 0; i < model.clusters.size(); ++i) {
    if (seen[i]) continue;
    const size_t before = model.tree.size();
    visit(static_cast<int>(i));
    grow(static_cast<int>(i));
    if (model.tree.size() > before) model.tree_heads.push_back(static_cast<int>(i));
  }
}

void World::integrate_servos() {
  for (auto& m : models_)
    for (auto& j : m->joints) {
      if (j->servo == ServoMode::Off) continue;
      j->previous_target = j->target;
      if (j->servo != ServoMode::Locked) continue;
      Axis& a = j->axes[0];
      a.q = j->catching_up ? a.q + j->rate * dt : j->target;
      a.qd = j->rate;
    }
}

// Link poses and velocities from the bodies; without `servos`, velocities as the bodies have them: those of floating clusters as
// if servo joints stood still.
void World::pull(bool servos) {
  for (auto& m : models_)
    for (auto& c : m->clusters) {
      if (c.root) {
        const Pose X_WB = body_pose(c.root->body);
        Link& root = *c.root;
        root.X_WL = {X_WB.p - rotate(X_WB.q, c.com), X_WB.q};
        root.w = vec(dBodyGetAngularVel(root.body));
        root.v = vec(dBodyGetLinearVel(root.body)) + cross(root.w, root.X_WL.p - X_WB.p);
      }
      if (c.members.size() > 1 || !c.root) {
        spread_poses(c);
        spread_twists(c, servos || !c.root || c.carriers);
      }
    }
  if (servos) spread_carried();
}

// Shapes, joint readings and shared arrays from the links.
void World::publish() {
  for (auto& m : models_) {
    for (auto& l : m->links) {
      if (l->cluster < 0) continue;
      const Cluster& c = m->clusters[l->cluster];
      if (c.root ? !c.asleep : l->moving) place_shapes(*l);
      double* row = &link_poses[7 * l->row];
      const Pose& X = l->X_WL;
      row[0] = X.p.x; row[1] = X.p.y; row[2] = X.p.z;
      row[3] = X.q.x; row[4] = X.q.y; row[5] = X.q.z; row[6] = X.q.w;
    }
    for (auto& j : m->joints) {
      if (!j->merged() && !j->projected) read_joint(*j);
      j->projected = false;
      for (int i = 0; i < j->axis_count; ++i) {
        joint_positions[j->row + i] = j->axes[i].q;
        joint_velocities[j->row + i] = j->axes[i].qd;
      }
    }
  }
}

void World::read_back() {
  pull();
  publish();
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

// ------------------------------------------------------------------------------------------------ snapshots

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
