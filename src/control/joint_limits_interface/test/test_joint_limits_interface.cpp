// Limits and what they make of commands, in C++.
#include <gtest/gtest.h>

#include <joint_limits_interface/joint_limits_interface.h>
#include <joint_limits_interface/joint_limits_urdf.h>

using namespace joint_limits_interface;
using hardware_interface::JointHandle;
using hardware_interface::JointStateHandle;

namespace
{

struct Joint
{
  double position = 0.0, velocity = 0.0, effort = 0.0, command = 0.0;
  JointHandle handle{ JointStateHandle("j", &position, &velocity, &effort), &command };
};

const ros::Duration period(0.1);

JointLimits limits()
{
  JointLimits limits;
  limits.has_position_limits = limits.has_velocity_limits = limits.has_effort_limits = true;
  limits.min_position = -1.0;
  limits.max_position = 1.0;
  limits.max_velocity = 2.0;
  limits.max_effort = 8.0;
  return limits;
}

SoftJointLimits soft()
{
  SoftJointLimits soft;
  soft.min_position = -0.8;
  soft.max_position = 0.8;
  soft.k_position = 20.0;
  soft.k_velocity = 40.0;
  return soft;
}

}  // namespace

TEST(Position, StepsAreLimitedByTheVelocity)
{
  Joint joint;
  PositionJointSaturationHandle handle(joint.handle, limits());
  joint.command = 5.0;
  handle.enforceLimits(period);
  EXPECT_DOUBLE_EQ(0.2, joint.command);
  for (int i = 0; i < 10; ++i)
  {
    joint.command = 5.0;
    handle.enforceLimits(period);
  }
  EXPECT_DOUBLE_EQ(1.0, joint.command);
  joint.position = -0.5;
  handle.reset();
  joint.command = -5.0;
  handle.enforceLimits(period);
  EXPECT_DOUBLE_EQ(-0.7, joint.command);
}

TEST(Position, SoftLimitsSlowDown)
{
  Joint joint;
  joint.position = 0.79;
  PositionJointSoftLimitsHandle handle(joint.handle, limits(), soft());
  joint.command = 1.0;
  handle.enforceLimits(period);
  EXPECT_DOUBLE_EQ(0.79 + 0.2 * 0.1, joint.command);
}

TEST(Effort, NothingPushesFurtherOut)
{
  Joint joint;
  EffortJointSaturationHandle handle(joint.handle, limits());
  joint.command = 100.0;
  handle.enforceLimits(period);
  EXPECT_DOUBLE_EQ(8.0, joint.command);
  joint.position = 1.1;
  handle.enforceLimits(period);
  EXPECT_DOUBLE_EQ(0.0, joint.command);
  joint.command = -100.0;
  handle.enforceLimits(period);
  EXPECT_DOUBLE_EQ(-8.0, joint.command);
}

TEST(Effort, SoftLimitsBrake)
{
  Joint joint;
  joint.position = 0.8;
  joint.velocity = 0.1;
  EffortJointSoftLimitsHandle handle(joint.handle, limits(), soft());
  joint.command = 8.0;
  handle.enforceLimits(period);
  EXPECT_DOUBLE_EQ(-4.0, joint.command);
}

TEST(Velocity, StepsAreLimitedByTheAcceleration)
{
  Joint joint;
  JointLimits accelerated = limits();
  accelerated.has_acceleration_limits = true;
  accelerated.max_acceleration = 5.0;
  VelocityJointSaturationHandle handle(joint.handle, accelerated);
  joint.command = 9.0;
  handle.enforceLimits(period);
  EXPECT_DOUBLE_EQ(0.5, joint.command);
  VelocityJointSoftLimitsHandle soft_handle(joint.handle, limits(), soft());
  joint.position = 0.9;
  joint.command = 1.0;
  soft_handle.enforceLimits(period);
  EXPECT_DOUBLE_EQ(-2.0, joint.command);
}

TEST(Handles, NeedTheirLimits)
{
  Joint joint;
  EXPECT_THROW(EffortJointSaturationHandle(joint.handle, JointLimits()), JointLimitsInterfaceException);
  EXPECT_THROW(VelocityJointSaturationHandle(joint.handle, JointLimits()), JointLimitsInterfaceException);
  EXPECT_THROW(PositionJointSoftLimitsHandle(joint.handle, JointLimits(), soft()), JointLimitsInterfaceException);
}

TEST(Interfaces, EnforceAll)
{
  Joint joint;
  PositionJointSaturationInterface interface;
  interface.registerHandle(PositionJointSaturationHandle(joint.handle, limits()));
  joint.command = 5.0;
  interface.enforceLimits(period);
  EXPECT_DOUBLE_EQ(0.2, joint.command);
  interface.reset();
  EXPECT_THROW(interface.getHandle("x"), JointLimitsInterfaceException);
}

TEST(Urdf, LimitsOfAJoint)
{
  auto joint = std::make_shared<urdf::Joint>();
  JointLimits read;
  SoftJointLimits read_soft;
  EXPECT_FALSE(getJointLimits(joint, read));
  EXPECT_FALSE(getSoftJointLimits(joint, read_soft));
  joint->type = urdf::Joint::REVOLUTE;
  joint->limits = std::make_shared<urdf::JointLimits>();
  joint->limits->lower = -2.0;
  joint->limits->velocity = 3.0;
  ASSERT_TRUE(getJointLimits(joint, read));
  EXPECT_TRUE(read.has_position_limits && read.has_velocity_limits && read.has_effort_limits);
  EXPECT_EQ(-2.0, read.min_position);
  EXPECT_EQ(3.0, read.max_velocity);
  joint->type = urdf::Joint::CONTINUOUS;
  getJointLimits(joint, read);
  EXPECT_FALSE(read.has_position_limits);
  EXPECT_TRUE(read.angle_wraparound);
}
