#pragma once
#include <string>

#include <gazebo/physics/PhysicsTypes.hh>

namespace gazebo
{
namespace physics
{
/// The one world. Throws common::Exception where there is none, or none of that name.
GAZEBO_VISIBLE WorldPtr get_world(const std::string& name = "");
GAZEBO_VISIBLE bool has_world(const std::string& name = "");
GAZEBO_VISIBLE void pause_world(WorldPtr world, bool pause);
GAZEBO_VISIBLE void pause_worlds(bool pause);
GAZEBO_VISIBLE uint32_t getUniqueId();
}  // namespace physics

namespace internal
{
/// Joint goes to the position and stays there, whatever pulls at it, as those of gazebo_ros_control without gains do.
GAZEBO_VISIBLE void Drive(const physics::JointPtr& joint, double position);
}  // namespace internal
}  // namespace gazebo
