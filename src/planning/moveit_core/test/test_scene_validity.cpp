// Scenes as text; what is valid, on the way and at the end; constraints in their frames.
#include <geometric_shapes/shapes.h>
#include <gtest/gtest.h>
#include <ros/time.h>

#include <cmath>
#include <sstream>

#include <moveit/kinematic_constraints/utils.h>
#include <moveit/robot_state/conversions.h>
#include <moveit/utils/message_checks.h>

#include "scenes.hpp"

// The format, and what stays, is that of upstream's saveGeometryToStream() and loadGeometryFromStream().
TEST(Scene, objectsGoToATextAndBack)
{
  const auto scene = std::make_shared<PlanningScene>(makeArm());
  scene->setName("kitchen");
  ASSERT_TRUE(scene->processCollisionObjectMsg(box("crate", 0.5, 0.0, 0.25, 0.125)));
  std_msgs::ColorRGBA green;
  green.g = green.a = 1.0f;
  scene->setObjectColor("crate", green);
  std::stringstream text;
  scene->saveGeometryToStream(text);
  text << "another\n.\n";
  EXPECT_EQ(text.str().substr(0, 8), "kitchen\n");
  EXPECT_NE(text.str().find("\nbox\n0.125 0.125 0.125"), std::string::npos);

  const auto other = std::make_shared<PlanningScene>(makeArm());
  ASSERT_TRUE(other->processCollisionObjectMsg(box("stays", 3, 0, 0, 0.1)));
  ASSERT_TRUE(other->processCollisionObjectMsg(box("crate", 3, 0, 0, 0.1)));
  ASSERT_TRUE(other->loadGeometryFromStream(text, Eigen::Isometry3d(Eigen::Translation3d(0, 0, 1.0))));
  EXPECT_EQ(other->getName(), "kitchen");
  EXPECT_TRUE(other->getWorld()->hasObject("stays"));
  const auto crate = other->getWorld()->getObject("crate");
  ASSERT_EQ(crate->shapes_.size(), 1u);
  EXPECT_EQ(static_cast<const shapes::Box&>(*crate->shapes_[0]).size[0], 0.125);
  EXPECT_TRUE(crate->global_shape_poses_[0].translation().isApprox(Eigen::Vector3d(0.5, 0.0, 1.25)));
  EXPECT_EQ(other->getObjectColor("crate").g, 1.0f);
  EXPECT_TRUE(other->loadGeometryFromStream(text));  // the next in the stream
  EXPECT_EQ(other->getName(), "another");

  std::istringstream broken("kitchen\n* crate\n0 0 0\n0 0 0 1\n1\npyramid\n1 1 1\n.\n"), empty("");
  EXPECT_FALSE(other->loadGeometryFromStream(broken));
  EXPECT_FALSE(other->loadGeometryFromStream(empty));
  EXPECT_EQ(other->getName(), "another");
  EXPECT_TRUE(other->getWorld()->hasObject("crate"));
}

TEST(Scene, aPathEndsAtOneOfItsGoals)
{
  const PlanningScenePtr scene = readyScene();
  moveit_msgs::RobotState start;
  moveit::core::robotStateToRobotStateMsg(scene->getCurrentState(), start);
  moveit_msgs::RobotTrajectory path;
  path.joint_trajectory.joint_names = { "turn" };
  path.joint_trajectory.points.resize(2);
  const double turn = scene->getCurrentState().getVariablePosition("turn");
  path.joint_trajectory.points[0].positions = { turn };
  path.joint_trajectory.points[1].positions = { turn + 0.2 };
  moveit_msgs::Constraints here, there;
  here.joint_constraints.resize(1);
  here.joint_constraints[0].joint_name = "turn";
  here.joint_constraints[0].position = turn;
  here.joint_constraints[0].tolerance_above = here.joint_constraints[0].tolerance_below = 0.01;
  here.joint_constraints[0].weight = 1.0;
  there = here;
  there.joint_constraints[0].position = turn + 0.2;
  const moveit_msgs::Constraints none;
  std::vector<std::size_t> wrong;
  EXPECT_TRUE(scene->isPathValid(start, path, none, there, "manipulator", false, &wrong));
  EXPECT_FALSE(scene->isPathValid(start, path, none, here, "manipulator", false, &wrong));
  EXPECT_EQ(wrong, (std::vector<std::size_t>{ 1 }));
  EXPECT_TRUE(scene->isPathValid(start, path, none, std::vector<moveit_msgs::Constraints>{ here, there }, "manipulator"));
  robot_trajectory::RobotTrajectory states(scene->getRobotModel(), "manipulator");
  states.setRobotTrajectoryMsg(scene->getCurrentState(), path);
  EXPECT_TRUE(scene->isPathValid(states, none, there));
  EXPECT_FALSE(scene->isPathValid(states, none, here));
}

// The frame does not move, so that the wanted rotation is not the same in it and in the model's frame.
TEST(Constraints, aWantedRotationIsToldInItsReferenceFrame)
{
  const auto scene = std::make_shared<PlanningScene>(makeArm());
  geometry_msgs::TransformStamped tilted;
  tilted.header.frame_id = "table";
  tilted.child_frame_id = scene->getPlanningFrame();
  tilted.transform.rotation.z = tilted.transform.rotation.w = std::sqrt(0.5);
  scene->getTransformsNonConst().setTransforms({ tilted });
  moveit_msgs::OrientationConstraint wanted;
  wanted.header.frame_id = "table";
  wanted.link_name = "hand";
  wanted.orientation.x = wanted.orientation.w = std::sqrt(0.5);
  wanted.absolute_x_axis_tolerance = wanted.absolute_y_axis_tolerance = wanted.absolute_z_axis_tolerance = 0.1;
  wanted.weight = 1.0;
  kinematic_constraints::OrientationConstraint constraint(scene->getRobotModel());
  ASSERT_TRUE(constraint.configure(wanted, scene->getTransforms()));
  const Eigen::Matrix3d in_table = Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitX()).toRotationMatrix();
  EXPECT_TRUE(constraint.getDesiredRotationMatrixInRefFrame().isApprox(in_table, 1e-9));
  const Eigen::Matrix3d table = Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  EXPECT_TRUE(constraint.getDesiredRotationMatrix().isApprox(table * in_table, 1e-9));
}

TEST(Scene, feasibilityAndConstraints)
{
  const PlanningScenePtr scene = readyScene();
  const auto& state = scene->getCurrentState();
  EXPECT_TRUE(scene->isStateValid(state, "manipulator"));
  scene->setStateFeasibilityPredicate(
      [](const moveit::core::RobotState& s, bool) { return s.getVariablePosition("lift") < 0.4; });
  EXPECT_FALSE(scene->isStateValid(state, "manipulator"));
  scene->setStateFeasibilityPredicate(planning_scene::StateFeasibilityFn());

  geometry_msgs::PoseStamped pose;
  pose.header.frame_id = "base";
  const Eigen::Isometry3d hand = state.getGlobalLinkTransform("hand");
  pose.pose.position.x = hand.translation().x();
  pose.pose.position.y = hand.translation().y();
  pose.pose.position.z = hand.translation().z();
  const Eigen::Quaterniond q(hand.linear());
  pose.pose.orientation.x = q.x(), pose.pose.orientation.y = q.y(), pose.pose.orientation.z = q.z(),
  pose.pose.orientation.w = q.w();
  const moveit_msgs::Constraints goal = kinematic_constraints::constructGoalConstraints("hand", pose, 1e-3, 1e-2);
  EXPECT_TRUE(scene->isStateConstrained(state, goal));
  kinematic_constraints::KinematicConstraintSet set(scene->getRobotModel());
  ASSERT_TRUE(set.add(goal, scene->getTransforms()));
  moveit::core::RobotState moved(state);
  moved.setVariablePosition("turn", state.getVariablePosition("turn") + 0.005);
  const auto verdict = set.decide(moved);
  EXPECT_FALSE(verdict.satisfied);  // the hand is 4 mm away
  EXPECT_GT(verdict.distance, 0.003);
  moveit_msgs::Constraints unknown = goal;
  unknown.position_constraints[0].link_name = "no_such";
  EXPECT_FALSE(kinematic_constraints::KinematicConstraintSet(scene->getRobotModel()).add(unknown, scene->getTransforms()));
}

// As MoveIt's message_checks and its planning scene have it: a pose is not set as long as all of it is 0.
TEST(Scene, anObjectOfOneShapeIsWhereItsShapeIsIfNobodySaysWhereItIs)
{
  geometry_msgs::Pose none, identity;
  identity.orientation.w = 1.0;
  EXPECT_TRUE(moveit::core::isEmpty(none));
  EXPECT_FALSE(moveit::core::isEmpty(identity));
  const auto scene = readyScene();
  moveit_msgs::CollisionObject object = box("crate", 0.5, 0.0, 0.1, 0.1);
  object.pose = none;
  ASSERT_TRUE(scene->processCollisionObjectMsg(object));
  EXPECT_NEAR(scene->getFrameTransform("crate").translation().x(), 0.5, 1e-12);
  object.id = "placed", object.pose = identity;
  ASSERT_TRUE(scene->processCollisionObjectMsg(object));
  EXPECT_NEAR(scene->getFrameTransform("placed").translation().x(), 0.0, 1e-12);
  EXPECT_NEAR(scene->getWorld()->getObject("placed")->global_shape_poses_.at(0).translation().x(), 0.5, 1e-12);

  moveit_msgs::CollisionObject move;
  move.header = object.header, move.id = "placed", move.operation = moveit_msgs::CollisionObject::MOVE;
  move.pose = identity, move.pose.position.z = 1.0;
  ASSERT_TRUE(scene->processCollisionObjectMsg(move));
  EXPECT_NEAR(scene->getWorld()->getObject("placed")->global_shape_poses_.at(0).translation().x(), 0.5, 1e-12);
  EXPECT_NEAR(scene->getWorld()->getObject("placed")->global_shape_poses_.at(0).translation().z(), 1.1, 1e-12);
}

// As MoveIt's JointConstraint and PositionConstraint; "lift" goes to 2 rad, "turn" has no limits.
TEST(Constraints, areTakenAsUpstreamTakesThem)
{
  const auto scene = readyScene();
  moveit_msgs::JointConstraint message;
  message.weight = 1.0, message.tolerance_above = message.tolerance_below = 0.1;
  const auto configured = [&](const std::string& joint, double position) {
    kinematic_constraints::JointConstraint constraint(scene->getRobotModel());
    message.joint_name = joint, message.position = position;
    EXPECT_TRUE(constraint.configure(message));
    return constraint;
  };
  EXPECT_NEAR(configured("turn", 7.0).getDesiredJointPosition(), 7.0 - 2 * M_PI, 1e-12);
  EXPECT_EQ(configured("lift", 2.05).getDesiredJointPosition(), 2.05);
  EXPECT_EQ(configured("lift", 2.05).getJointToleranceBelow(), 0.1);
  EXPECT_EQ(configured("lift", 2.5).getDesiredJointPosition(), 2.0);
  EXPECT_NEAR(configured("lift", 2.5).getJointToleranceBelow(), 0.0, 1e-9);
  EXPECT_EQ(configured("lift", -2.5).getDesiredJointPosition(), -2.0);

  moveit_msgs::PositionConstraint region;
  region.link_name = "hand", region.header.frame_id = "base", region.weight = 1.0;
  region.constraint_region.primitives = box("", 0, 0, 0, 0.1).primitives;
  kinematic_constraints::PositionConstraint constraint(scene->getRobotModel());
  EXPECT_FALSE(constraint.configure(region, scene->getTransforms()));
  region.constraint_region.primitive_poses.resize(2);  // one more than shapes
  for (geometry_msgs::Pose& pose : region.constraint_region.primitive_poses)
    pose.orientation.w = 1.0;
  EXPECT_TRUE(constraint.configure(region, scene->getTransforms()));
}

TEST(Robot, aContinuousJointExtendsOverAWholeTurn)
{
  const auto model = makeArm();
  EXPECT_NEAR(model->getJointModel("turn")->getMaximumExtent(), 2 * M_PI,
              1e-12);  // as upstream: the upper bound less the lower
  EXPECT_NEAR(model->getJointModel("lift")->getMaximumExtent(), 4.0, 1e-12);
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::Time::init();
  return RUN_ALL_TESTS();
}
