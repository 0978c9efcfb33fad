// A joint that turns without end, beyond half a turn: targets, what is remembered, inverse kinematics and lines.
#include <moveit/move_group_interface/move_group_interface.h>

#include <gtest/gtest.h>

using moveit::planning_interface::MoveGroupInterface;
using Codes = moveit_msgs::MoveItErrorCodes;
using Values = std::vector<double>;

namespace {

const Values HOME = {0, -0.6, 1.6, 0, 1.0, 0};
const Values BEYOND = {9.0, -4.0, 3.3};  // rad, of the last joint

Values with(double last) {
  Values values = HOME;
  values.back() = last;
  return values;
}

class Endless : public testing::Test {
 protected:
  Endless() : arm_("manipulator", nullptr, ros::WallDuration(60)) {
    arm_.setMaxVelocityScalingFactor(1);
    arm_.setMaxAccelerationScalingFactor(1);
  }

  // Whole turns aside: where a joint without end stands is told by its angle alone.
  void expectAt(const Values& expected) {
    const Values values = arm_.getCurrentJointValues();
    ASSERT_EQ(values.size(), expected.size());
    for (std::size_t i = 0; i < values.size(); ++i) EXPECT_NEAR(std::cos(values[i] - expected[i]), 1, 1e-4) << "joint " << i;
  }

  moveit::core::RobotState state(double last) {
    moveit::core::RobotState result(*arm_.getCurrentState());
    result.setJointGroupPositions("manipulator", with(last));
    result.update();
    return result;
  }

  MoveGroupInterface arm_;
};

TEST_F(Endless, TargetsAndRememberedOnesAreReached) {
  for (double last : BEYOND) {
    EXPECT_TRUE(arm_.setJointValueTarget(with(last))) << last;
    ASSERT_EQ(arm_.move(), Codes::SUCCESS);
    expectAt(with(last));
    arm_.rememberJointValues("spun", with(last + 1));
    EXPECT_TRUE(arm_.setNamedTarget("spun")) << last;
    ASSERT_EQ(arm_.move(), Codes::SUCCESS);
    expectAt(with(last + 1));
  }
  EXPECT_FALSE(arm_.setJointValueTarget("joint_1", 9.0));
  arm_.rememberJointValues("too far", {9.0, -0.6, 1.6, 0, 1.0, 0});
  EXPECT_FALSE(arm_.setNamedTarget("too far"));
}

TEST_F(Endless, KinematicsFindAPoseFromThere) {
  for (double last : BEYOND) {
    moveit::core::RobotState seed = state(last);
    Eigen::Isometry3d pose = seed.getGlobalLinkTransform("hand");
    pose.translation().y() += 0.02;
    ASSERT_TRUE(seed.setFromIK(seed.getJointModelGroup("manipulator"), pose)) << last;
    EXPECT_TRUE(seed.getGlobalLinkTransform("hand").isApprox(pose, 1e-3)) << last;
    EXPECT_TRUE(seed.satisfiesBounds()) << last;
  }
}

TEST_F(Endless, LinesBeginThereWithoutATurn) {
  for (double last : BEYOND) {
    moveit::core::RobotState start = state(last);
    geometry_msgs::Pose down = arm_.getCurrentPose("hand").pose;
    const Eigen::Isometry3d& here = start.getGlobalLinkTransform("hand");
    const Eigen::Quaterniond turn(here.linear());
    down.position.x = here.translation().x();
    down.position.y = here.translation().y();
    down.position.z = here.translation().z() - 0.05;
    down.orientation.x = turn.x();
    down.orientation.y = turn.y();
    down.orientation.z = turn.z();
    down.orientation.w = turn.w();
    arm_.setStartState(start);
    moveit_msgs::RobotTrajectory line;
    EXPECT_EQ(arm_.computeCartesianPath({down}, 0.01, line), 1.0) << last;
    const auto& points = line.joint_trajectory.points;
    ASSERT_GT(points.size(), 4u);
    EXPECT_NEAR(std::cos(points[0].positions[5] - last), 1, 1e-6);
    for (std::size_t k = 1; k < points.size(); ++k)
      for (std::size_t i = 0; i < 6; ++i) EXPECT_LT(std::abs(points[k].positions[i] - points[k - 1].positions[i]), 0.2) << last;
  }
}

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "test_endless");
  return RUN_ALL_TESTS();
}
