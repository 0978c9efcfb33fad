#pragma once
#include <gazebo/ode/ode.h>
#include <gazebo/physics/Collision.hh>
#include <gazebo/physics/ode/ODETypes.hh>

namespace gazebo
{
namespace physics
{

/// A collision that a plugin makes to hang rays of ODE on. It meets nothing by itself; the simulator's own collisions have no space or geom.
class GAZEBO_VISIBLE ODECollision : public Collision
{
public:
  explicit ODECollision(LinkPtr link) : Collision(link) {}
  void SetCollision(dGeomID geom, bool placeable);  // which says from then on whose it is
  dGeomID GetCollisionId() const { return collisionId; }
  int GetCollisionClass() const { return collisionId ? dGeomGetClass(collisionId) : 0; }
  dSpaceID GetSpaceId() const { return spaceId; }
  void SetSpaceId(dSpaceID space) { spaceId = space; }

protected:
  dSpaceID spaceId = nullptr;
  dGeomID collisionId = nullptr;
};

}  // namespace physics
}  // namespace gazebo
