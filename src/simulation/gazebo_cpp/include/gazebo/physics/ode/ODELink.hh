#pragma once
#include <gazebo/ode/common.h>
#include <gazebo/physics/Link.hh>
#include <gazebo/physics/ode/ODETypes.hh>
#include <gazebo/ode/ode.h>

namespace gazebo
{
namespace physics
{

/// A link. Its space is what a plugin has put there; it has no body of ODE, since bodies are the simulator's own.
class GAZEBO_VISIBLE ODELink : public Link
{
public:
  explicit ODELink(EntityPtr parent) : Link(parent) {}
  dSpaceID GetSpaceId() const { return spaceId; }
  void SetSpaceId(dSpaceID space) { spaceId = space; }

private:
  dSpaceID spaceId = nullptr;
};

}  // namespace physics
}  // namespace gazebo
