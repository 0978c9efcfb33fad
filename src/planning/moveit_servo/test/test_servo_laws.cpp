// The laws, against numbers from paper.
#include <gtest/gtest.h>

#include <moveit_servo/low_pass_filter.h>

#include "laws.hpp"
#include "read_parameters.hpp"

namespace laws = moveit_servo::laws;

TEST(Laws, ThresholdScaleFallsToAThousandth)
{
  EXPECT_EQ(laws::thresholdScale(0.06, 0.05), 1.0);
  EXPECT_EQ(laws::thresholdScale(0.05, 0.05), 1.0);
  EXPECT_NEAR(laws::thresholdScale(0.0, 0.05), 0.001, 1e-12);
  EXPECT_NEAR(laws::thresholdScale(0.025, 0.05), 0.0316228, 1e-6);  // sqrt(0.001)
  EXPECT_EQ(laws::thresholdScale(0.01, 0.0), 1.0);
  EXPECT_LT(laws::thresholdScale(-0.01, 0.0), 0.01);
}

TEST(Laws, StopDistanceHaltsWhatCannotStand)
{
  EXPECT_EQ(laws::stopDistanceScale(0.2, -0.1, 0.01, 1.9), 1.0);  // two seconds to go
  EXPECT_EQ(laws::stopDistanceScale(0.2, -0.1, 0.01, 2.1), 0.0);
  EXPECT_EQ(laws::stopDistanceScale(0.2, 0.1, 0.01, 2.1), 1.0);  // on its way out
  EXPECT_EQ(laws::stopDistanceScale(0.005, 0.1, 0.01, 2.1), 1.0);
  EXPECT_EQ(laws::stopDistanceScale(0.005, 0.0, 0.01, 0.0), 0.0);
}

TEST(Laws, TheSlowestJointSaysWhenTheArmStands)
{
  EXPECT_DOUBLE_EQ(laws::worstCaseStopTime(Eigen::Array3d(1.0, -0.9, 0.0), Eigen::Array3d(5.0, 3.0, 0.0)), 0.3);
  EXPECT_EQ(laws::worstCaseStopTime(Eigen::Array3d(0.0, 0.0, 0.0), Eigen::Array3d(0.0, 3.0, 1.0)), 0.0);
  EXPECT_TRUE(std::isinf(laws::worstCaseStopTime(Eigen::Array2d(0.1, 0.0), Eigen::Array2d(0.0, 1.0))));
}

TEST(Laws, VelocitiesKeepTheirProportion)
{
  const Eigen::Array3d lower(-2.0, -2.0, -1.0), upper(2.0, 2.0, 1.0);
  EXPECT_DOUBLE_EQ(laws::velocityLimitScale(Eigen::Array3d(1.0, -2.0, 0.0), lower, upper), 1.0);
  EXPECT_DOUBLE_EQ(laws::velocityLimitScale(Eigen::Array3d(4.0, 1.0, -5.0), lower, upper), 0.2);
  EXPECT_EQ(laws::velocityLimitScale(Eigen::Array3d(4.0, 0.0, 0.0), Eigen::Array3d(-2.0, 0.0, 0.0), Eigen::Array3d::Zero()),
            0.0);
}

TEST(Laws, SingularityScaleIsALine)
{
  EXPECT_EQ(laws::singularityScale(17.0, 17.0, 30.0), 1.0);
  EXPECT_NEAR(laws::singularityScale(20.25, 17.0, 30.0), 0.75, 1e-12);
  EXPECT_EQ(laws::singularityScale(30.0, 17.0, 30.0), 0.0);
  EXPECT_EQ(laws::singularityScale(std::numeric_limits<double>::infinity(), 17.0, 30.0), 0.0);
  EXPECT_EQ(laws::singularityScale(20.0, 20.0, 20.0), 1.0);
  EXPECT_EQ(laws::singularityScale(21.0, 20.0, 20.0), 0.0);
}

TEST(Laws, ConditionOfADiagonal)
{
  const Eigen::MatrixXd J = Eigen::Vector3d(2.0, 10.0, 0.5).asDiagonal();
  EXPECT_NEAR(laws::condition(Eigen::JacobiSVD<Eigen::MatrixXd>(J)), 20.0, 1e-9);
  const Eigen::MatrixXd flat = Eigen::Vector2d(1.0, 0.0).asDiagonal();
  EXPECT_TRUE(std::isinf(laws::condition(Eigen::JacobiSVD<Eigen::MatrixXd>(flat))));
}

TEST(Laws, CommandsLeadByHalfASecondAtMost)
{
  const double period = 0.01;
  const Eigen::Array2d step(0.002, 0.0);  // 0.2 rad/s: a lead of 0.1 rad
  const Eigen::Array2d measured(1.0, 2.0);
  EXPECT_NEAR(laws::nextPositions(Eigen::Array2d(1.05, 2.0), measured, step, period)[0], 1.052, 1e-12);
  EXPECT_NEAR(laws::nextPositions(Eigen::Array2d(1.5, 2.0), measured, step, period)[0], 1.102, 1e-12);
  EXPECT_NEAR(laws::nextPositions(Eigen::Array2d(0.5, 2.0), measured, step, period)[0], 0.902, 1e-12);
  EXPECT_EQ(laws::nextPositions(Eigen::Array2d(1.05, 2.0), measured, Eigen::Array2d::Zero(), period)[0], 1.05);
}

TEST(LowPassFilter, FollowsWithoutAnErrorAndDampsTheHighest)
{
  moveit_servo::LowPassFilter filter(2.0);
  filter.reset(1.0);
  EXPECT_DOUBLE_EQ(filter.filter(1.0), 1.0);
  EXPECT_DOUBLE_EQ(filter.filter(4.0), 2.0);         // (4 + 1 + 1) / 3
  EXPECT_DOUBLE_EQ(filter.filter(4.0), 10.0 / 3.0);  // (4 + 4 + 2) / 3
  double last = 0.0;
  for (int i = 0; i < 100; ++i)
    last = filter.filter(i % 2 ? 5.0 : 3.0);  // half the sampling rate is blocked
  EXPECT_NEAR(last, 4.0, 1e-9);
}

moveit_servo::ServoParameters right()
{
  moveit_servo::ServoParameters p;
  p.publish_period = 0.01;
  p.low_pass_filter_coeff = 2.0;
  p.lower_singularity_threshold = 17.0;
  p.hard_stop_singularity_threshold = 30.0;
  p.command_in_type = "unitless";
  p.command_out_type = "std_msgs/Float64MultiArray";
  p.publish_joint_positions = true;
  p.collision_check_type = "threshold_distance";
  p.collision_check_rate = 50.0;
  p.collision_distance_safety_factor = 1000.0;
  return p;
}

TEST(Parameters, WhatIsWrongIsNamed)
{
  using moveit_servo::ServoParameters;
  EXPECT_EQ(moveit_servo::whatIsWrong(right()), "");
  const std::vector<std::pair<std::string, std::function<void(ServoParameters&)>>> wrong = {
    { "publish_period", [](ServoParameters& p) { p.publish_period = 0.0; } },
    { "publish_period", [](ServoParameters& p) { p.publish_period = std::nan(""); } },
    { "num_outgoing_halt_msgs_to_publish", [](ServoParameters& p) { p.num_outgoing_halt_msgs_to_publish = -1; } },
    { "hard_stop_singularity_threshold", [](ServoParameters& p) { p.hard_stop_singularity_threshold = 16.0; } },
    { "lower_singularity_threshold", [](ServoParameters& p) { p.lower_singularity_threshold = -1.0; } },
    { "low_pass_filter_coeff", [](ServoParameters& p) { p.low_pass_filter_coeff = 0.5; } },
    { "joint_limit_margin", [](ServoParameters& p) { p.joint_limit_margin = -0.1; } },
    { "command_in_type", [](ServoParameters& p) { p.command_in_type = "speed"; } },
    { "command_out_type", [](ServoParameters& p) { p.command_out_type = "std_msgs/Float64"; } },
    { "publish_joint_positions", [](ServoParameters& p) { p.publish_joint_positions = false; } },
    { "choose publish_joint_positions", [](ServoParameters& p) { p.publish_joint_velocities = true; } },
    { "collision_check_type", [](ServoParameters& p) { p.collision_check_type = "distance"; } },
    { "self_collision_proximity_threshold", [](ServoParameters& p) { p.self_collision_proximity_threshold = -0.1; } },
    { "scene_collision_proximity_threshold", [](ServoParameters& p) { p.scene_collision_proximity_threshold = -0.1; } },
    { "collision_check_rate", [](ServoParameters& p) { p.collision_check_rate = 0.0; } },
    { "collision_distance_safety_factor", [](ServoParameters& p) { p.collision_distance_safety_factor = 0.9; } },
    { "min_allowable_collision_distance", [](ServoParameters& p) { p.min_allowable_collision_distance = -0.1; } },
  };
  for (const auto& each : wrong)
  {
    ServoParameters p = right();
    each.second(p);
    EXPECT_NE(moveit_servo::whatIsWrong(p).find(each.first), std::string::npos) << each.first;
  }
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
