// Collisions by the numbers of their shapes, by which contacts and rays name them.
#pragma once
#include <gazebo/physics/PhysicsTypes.hh>

namespace gazebo
{
namespace physics
{
Collision* collision_of(int shape);
void number_collision(int shape, Collision* collision);  // null: it has gone
}  // namespace physics
}  // namespace gazebo
