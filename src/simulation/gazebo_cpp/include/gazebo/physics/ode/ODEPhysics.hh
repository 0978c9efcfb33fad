#pragma once
#include <memory>

#include <gazebo/ode/common.h>
#include <gazebo/physics/PhysicsEngine.hh>
#include <gazebo/physics/ode/ODETypes.hh>
#include <gazebo/ode/ode.h>
#include <gazebo/physics/Shape.hh>

namespace gazebo
{
namespace physics
{

/// The settings of the steps, and a space of ODE in which rays are looked for.
class GAZEBO_VISIBLE ODEPhysics : public PhysicsEngine
{
public:
  explicit ODEPhysics(WorldPtr world);
  ~ODEPhysics() override;
  /// One geom stands in it for all that there is: dCollide() of a ray with it finds what the ray meets first in the world, and
  /// GetLaserRetro() of its collision is that of what was met last. Ask anew before each search, as the world moves.
  dSpaceID GetSpaceId() const;

private:
  class RayTarget;
  std::unique_ptr<RayTarget> all_;
};

}  // namespace physics
}  // namespace gazebo
