// Joint: those that plugins make while the simulation runs, and how joints let go.
#include <gazebo/physics/physics.hh>

#include <algorithm>
#include <map>

#include "convert.hpp"
#include "mirror.hpp"
#include "sdf_text.hpp"

namespace gazebo
{
namespace physics
{

using ignition::math::Pose3d;
using ignition::math::Vector3d;

namespace
{

ode_sim::JointType core_type(const Joint& joint)
{
  static const std::map<Base::EntityType, ode_sim::JointType> types = {
    { Base::SLIDER_JOINT, ode_sim::JointType::Prismatic }, { Base::FIXED_JOINT, ode_sim::JointType::Fixed },
    { Base::BALL_JOINT, ode_sim::JointType::Ball },        { Base::UNIVERSAL_JOINT, ode_sim::JointType::Universal },
    { Base::HINGE2_JOINT, ode_sim::JointType::Universal }, { Base::SCREW_JOINT, ode_sim::JointType::Screw },
    { Base::GEARBOX_JOINT, ode_sim::JointType::Gearbox },
  };
  for (const auto& [kind, type] : types)
    if (joint.HasType(kind))
      return type;
  return ode_sim::JointType::Revolute;
}

int axes_in(ode_sim::JointType type)
{
  using Type = ode_sim::JointType;
  return type == Type::Fixed || type == Type::Ball ? 0 : type == Type::Revolute || type == Type::Prismatic ? 1 : 2;
}

// What a plugin has set.
void take_settings(ode_sim::Joint& to, const ode_sim::Joint& from)
{
  to.stop_erp = from.stop_erp, to.stop_cfm = from.stop_cfm, to.thread_pitch = from.thread_pitch;
  for (int i = 0; i < 2; ++i)
  {
    to.axes[i] = from.axes[i];
    to.axes[i].relax();
    to.axes[i].q = 0;
  }
}

}  // namespace

// The links keep what holds them.
Joint::~Joint() = default;

// Of a joint that a plugin makes: as it is to be, also before Init() and when it has let go.
ode_sim::Joint& Joint::wanted() const
{
  if (core_)
    return *core_;
  if (!made_)
  {
    made_ = std::make_shared<ode_sim::Joint>();
    made_->type = core_type(*this);
    made_->axis_count = axes_in(made_->type);
    made_->axes[1].xyz = { 0, 1, 0 };
  }
  return *made_;
}

ode_sim::Axis* Joint::settings(unsigned int index) const
{
  ode_sim::Joint& joint = wanted();
  return index < static_cast<unsigned int>(joint.axis_count) ? &joint.axes[index] : nullptr;
}

void Joint::changed() const
{
  if (core_)
    core_->model->dirty = true;
}

// Fixed, or with both limits at one place.
bool Joint::firm() const
{
  const ode_sim::Axis* axis = settings(0);
  return wanted().type == ode_sim::JointType::Fixed || (axis && axis->upper - axis->lower < 1e-6);
}

// Holds as its settings have it now: firmly, or by a joint of its type.
void Joint::hold()
{
  const bool weld = firm();
  if (!wanted_now_ || (!parent_ && !child_) || (weld ? weld_ != 0 : core_ != nullptr))
    return;
  letGo();
  const LinkPtr child = child_ ? child_ : parent_, parent = child_ ? parent_ : LinkPtr();
  change("joint '" + GetName() + "' of " + (parent ? parent->GetScopedName() : "the world") + " and " + child->GetScopedName(),
         [&] {
           ode_sim::World* world = world_of(child->Core()->model);
           if (!world)
             return;
           const ode_sim::Joint& as = wanted();
           if (weld)
           {
             weld_ = world->weld(parent ? parent->Core() : nullptr, child->Core());
             return;
           }
           const auto joint = world->connect(as.type, parent ? parent->Core().get() : nullptr, *child->Core(), as.X_CJ);
           take_settings(*joint, as);
           core_ = joint;
         });
}

void Joint::letGo()
{
  const LinkPtr link = child_ ? child_ : parent_;
  if (core_ && made_)
    take_settings(*made_, *core_);
  if (!link || (!core_ && !weld_))
    return;
  change(GetName(), [&] {
    ode_sim::World* world = world_of(link->Core()->model);
    if (world && core_)
      world->disconnect(*core_);
    else if (world)
      world->unweld(weld_);
  });
  core_.reset();
  weld_ = 0;
}

void Joint::Load(LinkPtr parent, LinkPtr child, const Pose3d& pose)
{
  if (core_ && !made_)
    return;  // of a description
  const bool others = parent_ != parent || child_ != child;
  if (others)
    letGo();
  parent_ = parent, child_ = child;
  if (!core_ && !weld_)
    wanted().X_CJ = ode(pose);
  if (child && !GetWorld())
    SetWorld(child->GetWorld());
}

void Joint::Load(sdf::ElementPtr sdf)
{
  Base::Load(sdf);
  const auto model = boost::dynamic_pointer_cast<Model>(Base::GetParent());
  if (!model || (core_ && !made_))
    return;
  const auto link = [&](const char* tag) { return inside(sdf, tag) ? model->GetLink(sdf->Get<std::string>(tag)) : LinkPtr(); };
  Load(link("parent"), link("child"), inside(sdf, "pose") ? sdf->Get<Pose3d>("pose") : Pose3d());
  for (unsigned int i = 0; i < 2; ++i)
  {
    const sdf::ElementPtr axis = inside(sdf, i == 1 ? "axis2" : "axis");
    if (!axis || !settings(i))
      continue;
    if (inside(axis, "xyz"))
      SetAxis(i, axis->Get<Vector3d>("xyz"));
    const auto number = [](const sdf::ElementPtr& in, const char* tag, double otherwise) {
      return inside(in, tag) ? in->Get<double>(tag) : otherwise;
    };
    if (const sdf::ElementPtr limit = inside(axis, "limit"))
    {
      SetUpperLimit(i, number(limit, "upper", 1e16)), SetLowerLimit(i, number(limit, "lower", -1e16));
      SetEffortLimit(i, number(limit, "effort", -1)), SetVelocityLimit(i, number(limit, "velocity", -1));
    }
    if (const sdf::ElementPtr dynamics = inside(axis, "dynamics"))
    {
      SetStiffnessDamping(i, number(dynamics, "spring_stiffness", 0), number(dynamics, "damping", 0),
                          number(dynamics, "spring_reference", 0));
      SetParam("friction", i, number(dynamics, "friction", 0));
    }
  }
}

void Joint::SetModel(ModelPtr model)
{
  if (model)
    SetWorld(model->GetWorld());
}

void Joint::Init()
{
  if (core_ || weld_)
    return;
  wanted_now_ = true;
  hold();
}

// A fixed joint holds at once, and so does one that was let go.
void Joint::Attach(LinkPtr parent, LinkPtr child)
{
  if (core_ && !made_)
    return;
  if (parent_ != parent || child_ != child)
    letGo();
  parent_ = parent, child_ = child;
  wanted_now_ |= HasType(FIXED_JOINT);
  hold();
}

void Joint::Detach()
{
  if (!core_ || made_)
    return letGo();
  change(GetScopedName(), [&] {
    if (ode_sim::World* world = world_of(core_->model))
      world->disconnect(*core_);
  });
}

void Joint::SetAnchor(unsigned int, const Vector3d& anchor)
{
  const LinkPtr link = child_ ? child_ : parent_;
  if (!made_ || !link || !anchor.IsFinite())
    return;
  const bool held = core_ != nullptr;
  if (held)
    letGo();
  made_->X_CJ.p = inverse(link->Core()->X_WL) * ode(anchor);
  if (held)
    hold();
}

// What the links feel of it; of one that holds firmly, what its weld bore.
ode_sim::Feedback Joint::feedback() const
{
  if (core_)
    return core_->feedback;
  ode_sim::Feedback out;
  const LinkPtr& link = child_ ? child_ : parent_;
  if (!link || !weld_)
    return out;
  change(GetName(), [&] {
    ode_sim::World* world = world_of(link->Core()->model);
    const ode_sim::Weld* weld = world ? world->find_weld(weld_) : nullptr;
    if (!weld)
      return;
    const dBodyID child = ode_sim::body_of(weld->child.get()), parent = ode_sim::body_of(weld->parent.get());
    if (!child && !parent)
      return;
    const auto vec = [](const dReal* v) { return ode_sim::Vec3{ v[0], v[1], v[2] }; };
    const double sign = child ? 1 : -1;  // ODE's first body is the child's, if it has one
    const ode_sim::Vec3 at = vec(dBodyGetPosition(child ? child : parent));
    out.child_force = vec(weld->feedback.f1) * sign;
    out.child_torque = vec(weld->feedback.t1) * sign + cross(at - ode(WorldPose().Pos()), out.child_force);
    out.parent_force = -out.child_force;
    out.parent_torque = -out.child_torque;
  });
  return out;
}

}  // namespace physics
}  // namespace gazebo
