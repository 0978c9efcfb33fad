#pragma once
#include <ignition/math/Vector3.hh>

#include <gazebo/common/common.hh>

namespace gazebo
{
namespace physics
{

/// Forces (N) and torques (N m) of a joint or contact on its two bodies.
class JointWrench
{
public:
  JointWrench operator+(const JointWrench& other) const
  {
    JointWrench sum = *this;
    sum.body1Force += other.body1Force, sum.body1Torque += other.body1Torque;
    sum.body2Force += other.body2Force, sum.body2Torque += other.body2Torque;
    return sum;
  }
  JointWrench operator-(const JointWrench& other) const
  {
    JointWrench sum = *this;
    sum.body1Force -= other.body1Force, sum.body1Torque -= other.body1Torque;
    sum.body2Force -= other.body2Force, sum.body2Torque -= other.body2Torque;
    return sum;
  }

  ignition::math::Vector3d body1Force, body2Force, body1Torque, body2Torque;
};

}  // namespace physics
}  // namespace gazebo
