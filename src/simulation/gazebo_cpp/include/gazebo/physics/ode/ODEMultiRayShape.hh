#pragma once
#include <gazebo/physics/MultiRayShape.hh>
#include <gazebo/physics/ode/ODETypes.hh>

namespace gazebo
{
namespace physics
{

/// Rays that a plugin adds; they are looked for all together.
class GAZEBO_VISIBLE ODEMultiRayShape : public MultiRayShape
{
public:
  explicit ODEMultiRayShape(CollisionPtr parent) : MultiRayShape(parent) {}
};

}  // namespace physics
}  // namespace gazebo
