// Actor.
#include <gazebo/physics/physics.hh>

#include <cmath>

#include "mirror.hpp"

namespace gazebo
{
namespace physics
{

Actor::~Actor()
{
  for (const auto& each : animations_)
    delete each.second;
}

void Actor::Play()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  state_.active = true;
  state_.started_ns = Mirror::Get().Now();
}

void Actor::Stop()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  state_.active = false;
}

bool Actor::IsActive() const { return Wanted().active; }

void Actor::Fini()
{
  ResetCustomTrajectory();
  Model::Fini();
}

void Actor::Reset()
{
  ResetCustomTrajectory();
  Play();
  Model::Reset();
}

void Actor::SetScriptTime(const double time)
{
  if (!std::isfinite(time))
    return refused(GetScopedName() + ": SetScriptTime() takes seconds; it is left as it is");
  const std::lock_guard<std::mutex> lock(mutex_);
  state_.script_time = time;
}

double Actor::ScriptTime() const { return Wanted().script_time; }

void Actor::SetCustomTrajectory(TrajectoryInfoPtr& trajectory)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  trajectory_ = trajectory;
}

TrajectoryInfoPtr Actor::CustomTrajectory() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return trajectory_;
}

void Actor::ResetCustomTrajectory()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  trajectory_.reset();
}

Actor::State Actor::Wanted() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  State wanted = state_;
  wanted.custom = static_cast<bool>(trajectory_);
  if (trajectory_)  // plugins change it while it is set
    wanted.type = trajectory_->type;
  return wanted;
}

void Actor::Plays(const State& state, bool anew)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  if (anew)
  {
    trajectory_.reset();
    state_.active = state.active;
    state_.started_ns = state.started_ns;
  }
  if (!trajectory_)
    state_.script_time = state.script_time;
}

void Actor::LetCollide()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  state_.collides = true;
}

}  // namespace physics
}  // namespace gazebo
