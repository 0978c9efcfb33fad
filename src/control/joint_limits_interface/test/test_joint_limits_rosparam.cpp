// Limits from the parameter server. What upstream does with names: those that no parameter can have have no limits.
#include <gtest/gtest.h>
#include <joint_limits_interface/joint_limits_rosparam.h>

using namespace joint_limits_interface;

TEST(JointLimitsFromParameters, AreReadWhereTheNodeHandleStands)
{
  JointLimits limits;
  EXPECT_TRUE(getJointLimits("elbow", ros::NodeHandle("arm"), limits));
  EXPECT_TRUE(limits.has_velocity_limits);
  EXPECT_EQ(limits.max_velocity, 2.0);
  SoftJointLimits soft;
  EXPECT_TRUE(getSoftJointLimits("elbow", ros::NodeHandle("arm"), soft));
  EXPECT_EQ(soft.max_position, 0.5);
  EXPECT_FALSE(getJointLimits("elbow", ros::NodeHandle(), limits)) << "there is no joint_limits in the root";
  EXPECT_FALSE(getSoftJointLimits("wrist", ros::NodeHandle("arm"), soft));
}

class NamesOfNoParameter : public testing::TestWithParam<const char*>
{
};

TEST_P(NamesOfNoParameter, HaveNoLimits)
{
  const ros::NodeHandle nh("arm");
  JointLimits limits;
  EXPECT_NO_THROW(EXPECT_FALSE(getJointLimits(GetParam(), nh, limits)));
  EXPECT_FALSE(limits.has_velocity_limits);
  SoftJointLimits soft;
  EXPECT_NO_THROW(EXPECT_FALSE(getSoftJointLimits(GetParam(), nh, soft)));
}

INSTANTIATE_TEST_SUITE_P(Names, NamesOfNoParameter, testing::Values("~elbow", "wheel-left", "joint 1"));

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "joint_limits_from_parameters");
  const ros::NodeHandle nh;
  return RUN_ALL_TESTS();
}
