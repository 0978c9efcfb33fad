#pragma once
#include <functional>
#include <utility>

#include <ignition/math/Vector3.hh>

#include <gazebo/physics/PhysicsTypes.hh>

namespace gazebo
{
namespace physics
{

/// The wind of a world, m/s in its axes: everywhere the same, or what a function says. It blows at nothing by itself: plugins do.
class GAZEBO_VISIBLE Wind
{
public:
  using Function = std::function<ignition::math::Vector3d(const Wind*, const Entity*)>;

  const ignition::math::Vector3d& LinearVel() const { return velocity_; }
  void SetLinearVel(const ignition::math::Vector3d& velocity) { velocity_ = velocity; }
  void SetLinearVelFunc(Function function) { function_ = std::move(function); }
  ignition::math::Vector3d WorldLinearVel(const Entity* entity) const;     // where it is
  ignition::math::Vector3d RelativeLinearVel(const Entity* entity) const;  // in its axes

private:
  ignition::math::Vector3d velocity_;
  Function function_;
};

}  // namespace physics
}  // namespace gazebo
