#pragma once
#include <boost/shared_ptr.hpp>

#include <gazebo/ode/common.h>

namespace gazebo
{
namespace physics
{
#define GZ_PHYSICS_ODE(name) \
  class name;                \
  typedef boost::shared_ptr<name> name##Ptr;
GZ_PHYSICS_ODE(ODECollision)
GZ_PHYSICS_ODE(ODELink)
GZ_PHYSICS_ODE(ODEMultiRayShape)
GZ_PHYSICS_ODE(ODEPhysics)
GZ_PHYSICS_ODE(ODERayShape)
#undef GZ_PHYSICS_ODE
}  // namespace physics
}  // namespace gazebo
