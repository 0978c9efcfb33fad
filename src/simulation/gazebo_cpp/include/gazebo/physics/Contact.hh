#pragma once
#include <string>

#include <ignition/math/Vector3.hh>

#include <gazebo/common/Time.hh>
#include <gazebo/physics/JointWrench.hh>
#include <gazebo/physics/PhysicsTypes.hh>
#include <gazebo/common/common.hh>

#define MAX_COLLIDE_RETURNS 250
#define MAX_CONTACT_JOINTS 250

namespace gazebo
{
namespace msgs
{
class Contact;
}

namespace physics
{

/// All points at which two collisions touch in a step. World axes; forces on the links of collision 1 and 2.
class GAZEBO_VISIBLE Contact
{
public:
  Contact() = default;
  Contact(const Contact&) = default;
  Contact& operator=(const Contact&) = default;
  Contact& operator=(const msgs::Contact& message);  // collisions that are not in the world any more are null
  void FillMsg(msgs::Contact& message) const;
  std::string DebugString() const;
  void Reset() { count = 0; }

  Collision* collision1 = nullptr;
  Collision* collision2 = nullptr;
  JointWrench wrench[MAX_CONTACT_JOINTS];
  ignition::math::Vector3d positions[MAX_CONTACT_JOINTS];
  ignition::math::Vector3d normals[MAX_CONTACT_JOINTS];
  double depths[MAX_CONTACT_JOINTS] = {};
  int count = 0;
  common::Time time;
  WorldPtr world;
};

}  // namespace physics
}  // namespace gazebo
