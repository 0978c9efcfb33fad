// JointController.
#include <gazebo/physics/physics.hh>

#include <algorithm>
#include <cmath>

#include "convert.hpp"

namespace gazebo
{
namespace physics
{

namespace
{

// What a PID gives, with the law behind it: the simulation holds gains that are too high for its step, as those of ros_control.
// `slope`: how much less it gives per unit of the joint's speed, negative where it is of the position alone.
void give(Joint& joint, common::PID& pid, double error, const common::Time& passed, double slope)
{
  const double force = pid.Update(error, passed);
  const auto core = joint.Core();
  double p, i, d;
  pid.GetErrors(p, i, d);
  const double law = -(pid.GetPGain() * p + pid.GetIGain() * i + pid.GetDGain() * d);
  const bool bounded = pid.GetCmdMax() >= pid.GetCmdMin();
  const double bound = bounded ? pid.GetCmdMax() : ode_sim::kInf;
  // What a bound that is not the same to both sides has cut is no law.
  const bool lawful = !bounded || pid.GetCmdMin() == -bound || (force > pid.GetCmdMin() && force < bound);
  if (core && core->axis_count > 0 && slope != 0 && lawful && std::isfinite(law))
    ode_sim::add_law(core->axes[0], law, slope, bound);
  else
    joint.SetForce(0, force);
}

double slope_of_position(const common::PID& pid, double seconds)
{
  const double p = std::max(pid.GetPGain(), 0.0) * seconds;
  return pid.GetDGain() > 0 ? pid.GetDGain() + p : -p;
}

double slope_of_velocity(const common::PID& pid, double seconds)
{
  return std::max(pid.GetPGain() + pid.GetDGain() / seconds, 0.0);
}

}  // namespace

JointController::JointController(ModelPtr model) : model_(model.get()), last_(model->GetWorld()->SimTime())
{
  for (const JointPtr& joint : model->GetJoints())
    AddJoint(joint);
}

void JointController::AddJoint(JointPtr joint)
{
  joints_[joint->GetScopedName()] = joint;
  position_pids_[joint->GetScopedName()].Init(1, 0.1, 0.01, 1, -1, 1000, -1000);
  velocity_pids_[joint->GetScopedName()].Init(1, 0.1, 0.01, 1, -1, 1000, -1000);
}

void JointController::RemoveJoint(Joint* joint)
{
  const std::string name = joint ? joint->GetScopedName() : "";
  joints_.erase(name), position_pids_.erase(name), velocity_pids_.erase(name);
  forces_.erase(name), positions_.erase(name), velocities_.erase(name);
}

void JointController::Reset()
{
  forces_.clear(), positions_.clear(), velocities_.clear();
  for (auto& pid : position_pids_)
    pid.second.Reset();
  for (auto& pid : velocity_pids_)
    pid.second.Reset();
}

void JointController::Update()
{
  const common::Time now = model_->GetWorld()->SimTime(), passed = now - last_;
  last_ = now;
  if (passed <= common::Time::Zero)
    return;
  for (const auto& force : forces_)
    joints_[force.first]->SetForce(0, force.second);
  for (const auto& target : positions_)
  {
    const JointPtr& joint = joints_[target.first];
    common::PID& pid = position_pids_[target.first];
    give(*joint, pid, joint->Position(0) - target.second, passed, slope_of_position(pid, passed.Double()));
  }
  for (const auto& target : velocities_)
  {
    const JointPtr& joint = joints_[target.first];
    common::PID& pid = velocity_pids_[target.first];
    give(*joint, pid, joint->GetVelocity(0) - target.second, passed, slope_of_velocity(pid, passed.Double()));
  }
}

void JointController::SetJointPosition(const std::string& name, double position, int index)
{
  const auto found = joints_.find(name);
  const JointPtr joint = found == joints_.end() ? model_->GetJoint(name) : found->second;
  if (!joint)
    return refused("the joint controller of " + model_->GetName() + " has no joint '" + name + "'");
  SetJointPosition(joint, position, index);
}

void JointController::SetJointPosition(JointPtr joint, double position, int index) { joint->SetPosition(index, position); }

void JointController::SetJointPositions(const std::map<std::string, double>& positions)
{
  for (const auto& position : positions)
    SetJointPosition(position.first, position.second);
}

void JointController::SetPositionPID(const std::string& name, const common::PID& pid)
{
  if (joints_.count(name))
    position_pids_[name] = pid;
  else
    refused("the joint controller of " + model_->GetName() + " has no joint '" + name +
            "'; it takes scoped names (model::joint)");
}

void JointController::SetVelocityPID(const std::string& name, const common::PID& pid)
{
  if (joints_.count(name))
    velocity_pids_[name] = pid;
  else
    refused("the joint controller of " + model_->GetName() + " has no joint '" + name +
            "'; it takes scoped names (model::joint)");
}

bool JointController::SetPositionTarget(const std::string& name, double target)
{
  return joints_.count(name) && (positions_[name] = target, true);
}
bool JointController::SetVelocityTarget(const std::string& name, double target)
{
  return joints_.count(name) && (velocities_[name] = target, true);
}
bool JointController::SetForce(const std::string& name, double force)
{
  return joints_.count(name) && (forces_[name] = force, true);
}

}  // namespace physics
}  // namespace gazebo
