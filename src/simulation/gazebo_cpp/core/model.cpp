// Model.
#include <gazebo/physics/physics.hh>

#include <algorithm>
#include <boost/algorithm/string/predicate.hpp>

#include "mirror.hpp"
#include "sdf_text.hpp"

namespace gazebo
{
namespace physics
{

using ignition::math::Vector3d;

Model::~Model() = default;

boost::shared_ptr<Model> Model::shared_from_this() { return boost::static_pointer_cast<Model>(Base::shared_from_this()); }

const sdf::ElementPtr Model::GetSDF()
{
  if (!sdf)
    sdf = model_element(text_, GetName());
  return sdf;
}

void Model::SetWindMode(bool enable)
{
  for (const LinkPtr& link : links_)
    link->SetWindMode(enable);
}
bool Model::WindMode() const { return !links_.empty() && links_.front()->WindMode(); }

bool Model::IsStatic() const { return core_ && core_->is_static; }

const ignition::math::Pose3d& Model::WorldPose() const
{
  return worldPose = links_.empty() ? InitialRelativePose() : X_LM_ + links_.front()->WorldPose();
}

void Model::place(const ignition::math::Pose3d& X_WM)
{
  if (ode_sim::World* core = world_of(core_.get()))
    core->set_model_pose(*core_, ode(WorldPose()), ode(X_WM));
}

void Model::Reset()
{
  SetWorldPose(InitialRelativePose());
  ResetPhysicsStates();
}

void Model::ResetPhysicsStates()
{
  change(GetScopedName(), [&] {
    if (ode_sim::World* core = world_of(core_.get()))
      core->zero_velocities(*core_);
  });
}

void Model::SetLinearVel(const Vector3d& velocity)
{
  for (const LinkPtr& link : links_)
    link->SetLinearVel(velocity);
}

void Model::SetAngularVel(const Vector3d& velocity)
{
  for (const LinkPtr& link : links_)
    link->SetAngularVel(velocity);
}

void Model::SetWorldTwist(const Vector3d& linear, const Vector3d& angular, bool)
{
  const Vector3d origin = WorldPose().Pos();
  for (const LinkPtr& link : links_)
    link->SetWorldTwist(linear + angular.Cross(link->WorldPose().Pos() - origin), angular);
}

Vector3d Model::WorldLinearVel() const { return links_.empty() ? Vector3d() : links_.front()->WorldLinearVel(); }
Vector3d Model::WorldAngularVel() const { return links_.empty() ? Vector3d() : links_.front()->WorldAngularVel(); }
Vector3d Model::WorldLinearAccel() const { return links_.empty() ? Vector3d() : links_.front()->WorldLinearAccel(); }
Vector3d Model::WorldAngularAccel() const { return links_.empty() ? Vector3d() : links_.front()->WorldAngularAccel(); }

ignition::math::AxisAlignedBox Model::BoundingBox() const
{
  ignition::math::AxisAlignedBox box;
  for (const LinkPtr& link : links_)
    box += link->BoundingBox();
  return box;
}

JointPtr Model::GetJoint(const std::string& name)
{
  for (const JointPtr& joint : joints_)
    if (joint->GetName() == name || joint->GetScopedName() == name)
      return joint;
  return JointPtr();
}

LinkPtr Model::GetLink(const std::string& name) const
{
  if (name == "canonical")
    return links_.empty() ? LinkPtr() : links_.front();
  for (const LinkPtr& link : links_)
    if (link->GetName() == name || link->GetScopedName() == name)
      return link;
  return LinkPtr();
}

LinkPtr Model::GetLinkById(unsigned int id) const
{
  for (const LinkPtr& link : links_)
    if (link->GetId() == id)
      return link;
  return LinkPtr();
}

bool Model::GetSelfCollide() const { return core_ && core_->self_collide; }

void Model::SetSelfCollide(bool self_collide)
{
  for (const LinkPtr& link : links_)
    link->SetSelfCollide(self_collide);
}

void Model::SetGravityMode(const bool& on)
{
  for (const LinkPtr& link : links_)
    link->SetGravityMode(on);
}

void Model::SetCollideMode(const std::string& mode)
{
  for (const LinkPtr& link : links_)
    link->SetCollideMode(mode);
}

void Model::SetJointPosition(const std::string& joint, double position, int index)
{
  GetJointController()->SetJointPosition(joint, position, index);
}

void Model::SetJointPositions(const std::map<std::string, double>& positions)
{
  GetJointController()->SetJointPositions(positions);
}

void Model::SetEnabled(bool enabled)
{
  for (const LinkPtr& link : links_)
    link->SetEnabled(enabled);
}

void Model::SetLinkWorldPose(const ignition::math::Pose3d& pose, std::string link) { SetLinkWorldPose(pose, GetLink(link)); }

void Model::SetLinkWorldPose(const ignition::math::Pose3d& pose, const LinkPtr& link)
{
  if (!link)
    return refused(GetScopedName() + " has no such link for SetLinkWorldPose()");
  SetWorldPose((WorldPose() - link->WorldPose()) + pose);
}

void Model::SetAutoDisable(bool disable)
{
  if (core_)
    core_->may_sleep = disable;
}

bool Model::GetAutoDisable() const { return core_ && core_->may_sleep; }

unsigned int Model::GetPluginCount() const
{
  unsigned int count = 0;
  for (std::size_t at = text_.find("<plugin"); at != std::string::npos; at = text_.find("<plugin", at + 1))
    ++count;
  return count;
}

unsigned int Model::GetSensorCount() const
{
  unsigned int count = 0;
  for (const LinkPtr& link : links_)
    count += link->GetSensorCount();
  return count;
}

std::vector<std::string> Model::SensorScopedName(const std::string& name) const
{
  std::vector<std::string> names;
  for (const LinkPtr& link : links_)
    for (unsigned int i = 0; i < link->GetSensorCount(); ++i)
    {
      const std::string full = link->GetSensorName(i);
      if (full == name || boost::algorithm::ends_with(full, "::" + name))  // by as much of it as is told
        names.push_back(full);
    }
  return names;
}

JointControllerPtr Model::GetJointController()
{
  if (!controller_)
    controller_.reset(new JointController(shared_from_this()));
  return controller_;
}

double Model::GetWorldEnergyPotential() const
{
  double sum = 0;
  for (const LinkPtr& link : links_)
    sum += link->GetWorldEnergyPotential();
  return sum;
}

double Model::GetWorldEnergyKinetic() const
{
  double sum = 0;
  for (const LinkPtr& link : links_)
    sum += link->GetWorldEnergyKinetic();
  return sum;
}

JointPtr Model::newJoint(const std::string& name, const std::string& type)
{
  if (GetJoint(name))
  {
    refused(GetScopedName() + " has a joint '" + name + "' already; CreateJoint() makes none");
    return JointPtr();
  }
  const JointPtr joint = GetWorld()->Physics()->CreateJoint(type, shared_from_this());
  joint->SetName(name);
  joints_.push_back(joint);
  AddChild(joint);
  return joint;
}

JointPtr Model::CreateJoint(const std::string& name, const std::string& type, LinkPtr parent, LinkPtr child)
{
  const JointPtr joint = newJoint(name, type);
  if (!joint)
    return joint;
  joint->Attach(parent, child);
  joint->Load(parent, child, ignition::math::Pose3d());
  joint->Init();
  return joint;
}

JointPtr Model::CreateJoint(sdf::ElementPtr sdf)
{
  const JointPtr joint = newJoint(sdf->Get<std::string>("name"), sdf->Get<std::string>("type"));
  if (!joint)
    return joint;
  joint->Load(sdf);
  joint->Init();
  return joint;
}

bool Model::RemoveJoint(const std::string& name)
{
  const JointPtr joint = GetJoint(name);
  if (!joint)
    return false;
  joint->Detach();
  joints_.erase(std::find(joints_.begin(), joints_.end(), joint));
  RemoveChild(BasePtr(joint));
  return true;
}

}  // namespace physics
}  // namespace gazebo
