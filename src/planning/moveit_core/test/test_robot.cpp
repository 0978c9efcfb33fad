#include <geometric_shapes/shapes.h>
#include <gtest/gtest.h>
#include <ros/time.h>
#include <moveit/robot_state/conversions.h>
#include <moveit/robot_state/robot_state.h>
#include <srdfdom/srdf_writer.h>

#include "arm.hpp"
#include "motion/robot_state.hpp"

using namespace moveit::core;
using Names = std::vector<std::string>;

namespace
{
const double TIGHT = 1e-12;

RobotState readyState()
{
  RobotState state(makeArm());
  state.setToDefaultValues();
  EXPECT_TRUE(state.setToDefaultValues("manipulator", "ready"));
  return state;
}
}  // namespace

TEST(RobotModel, namesOfJointsLinksAndVariables)
{
  const RobotModelPtr model = makeArm();
  EXPECT_EQ(model->getName(), "arm");
  EXPECT_EQ(model->getModelFrame(), "floor");
  EXPECT_EQ(model->getRootJointName(), "stand");
  EXPECT_EQ(model->getRootLinkName(), "base");
  EXPECT_EQ(model->getVariableNames(),
            (Names{ "stand/x", "stand/y", "stand/theta", "turn", "lift", "bend", "grip", "grip_mirror" }));
  EXPECT_EQ(model->getActiveJointModelNames(), (Names{ "stand", "turn", "lift", "bend", "grip" }));
  EXPECT_EQ(model->getJointModel("stand")->getType(), JointModel::PLANAR);
  EXPECT_EQ(model->getJointModel("stand")->getLocalVariableNames(), (Names{ "x", "y", "theta" }));
  EXPECT_EQ(model->getJointModel("grip_mirror")->getMimic(), model->getJointModel("grip"));
  EXPECT_EQ(model->getVariableIndex("turn"), 3);
  EXPECT_THROW(model->getVariableIndex("no_such"), moveit::Exception);
  EXPECT_EQ(model->getJointModel("no_such"), nullptr);
  EXPECT_EQ(model->getLinkModelsWithCollisionGeometry().size(), 5u);
  EXPECT_EQ(model->getCommonRoot(model->getJointModel("grip"), model->getJointModel("grip_mirror"))->getName(), "wrist");
}

TEST(RobotModel, groupsStatesAndEndEffectors)
{
  const RobotModelPtr model = makeArm();
  EXPECT_EQ(model->getJointModelGroupNames(), (Names{ "fingers", "manipulator" }));
  EXPECT_EQ(model->getJointModelGroup("no_such"), nullptr);
  const JointModelGroup* arm = model->getJointModelGroup("manipulator");
  EXPECT_TRUE(arm->isChain());
  EXPECT_EQ(arm->getJointModelNames(), (Names{ "turn", "lift", "bend", "wrist" }));
  EXPECT_EQ(arm->getVariableNames(), (Names{ "turn", "lift", "bend" }));
  EXPECT_EQ(arm->getLinkModelNames(), (Names{ "column", "upper", "lower", "hand" }));
  EXPECT_EQ(arm->getDefaultStateNames(), Names{ "ready" });
  std::map<std::string, double> ready;
  EXPECT_TRUE(arm->getVariableDefaultPositions("ready", ready));
  EXPECT_EQ(ready, (std::map<std::string, double>{ { "turn", 0.3 }, { "lift", 0.5 }, { "bend", 1.2 } }));
  EXPECT_EQ(arm->getOnlyOneEndEffectorTip(), model->getLinkModel("hand"));
  const JointModelGroup* fingers = model->getEndEffector("gripper");
  EXPECT_EQ(fingers, model->getJointModelGroup("fingers"));
  EXPECT_EQ(fingers->getEndEffectorParentGroup(), std::make_pair(std::string("manipulator"), std::string("hand")));
  EXPECT_EQ(fingers->getVariableCount(), 2u);        // the mirrored one counts as a variable,
  EXPECT_EQ(fingers->getActiveVariableCount(), 1u);  // but does not move by itself
}

// As a task that moves an arm and its hand at once makes one.
TEST(RobotModel, groupsOfJointsThatNoGroupHasTogether)
{
  const RobotModelPtr robot = makeArm();
  std::vector<const JointModel*> joints = robot->getJointModelGroup("fingers")->getJointModels();
  for (const JointModel* joint : robot->getJointModelGroup("manipulator")->getJointModels())
    joints.push_back(joint);
  const JointModelGroup both("manipulator+fingers", srdf::Model::Group(), joints, robot.get());
  EXPECT_EQ(both.getName(), "manipulator+fingers");
  EXPECT_EQ(both.getVariableNames(), (std::vector<std::string>{ "turn", "lift", "bend", "grip", "grip_mirror" }));
  EXPECT_EQ(both.getActiveJointModelNames(), (std::vector<std::string>{ "turn", "lift", "bend", "grip" }));
  EXPECT_EQ(both.getCommonRoot()->getName(), "turn");
  EXPECT_TRUE(both.isLinkUpdated("left"));
  EXPECT_FALSE(both.isLinkUpdated("base"));
  EXPECT_FALSE(both.isChain());
  EXPECT_FALSE(robot->hasJointModelGroup("manipulator+fingers"));

  RobotState state(robot);
  state.setToDefaultValues();
  state.setJointGroupPositions(&both, std::vector<double>{ 0.1, 0.2, 0.3, 0.02, 0.02 });
  EXPECT_EQ(state.getVariablePosition("bend"), 0.3);
  EXPECT_EQ(state.getVariablePosition("grip_mirror"), 0.02);
  RobotState other(robot);
  other.setToDefaultValues();
  EXPECT_NEAR(state.distance(other, &both), 0.1 + 0.2 + 0.3 + 0.02, 1e-9);
}

TEST(RobotModel, boundsAreThoseOfTheLibrary)
{
  const RobotModelPtr model = makeArm();
  const VariableBounds& lift = model->getVariableBounds("lift");
  EXPECT_TRUE(lift.position_bounded_);
  EXPECT_EQ(lift.min_position_, -2.0);
  EXPECT_EQ(lift.max_velocity_, 1.5);
  EXPECT_EQ(lift.min_velocity_, -1.5);
  EXPECT_FALSE(model->getVariableBounds("turn").position_bounded_);
  VariableBounds tighter = lift;
  tighter.max_position_ = 1.0;
  model->getJointModel("lift")->setVariableBounds("lift", tighter);
  EXPECT_EQ(model->core()->bounds[model->getVariableIndex("lift")].max_position, 1.0);
  RobotState state(model);
  state.setVariablePosition("lift", 1.5);
  EXPECT_FALSE(state.satisfiesBounds());
  state.enforceBounds();
  EXPECT_EQ(state.getVariablePosition("lift"), 1.0);
}

TEST(RobotState, posesFollowValues)
{
  RobotState state = readyState();
  const double reach = 0.5 * std::sin(0.5) + 0.4 * std::sin(1.7), height = 0.4 + 0.5 * std::cos(0.5) + 0.4 * std::cos(1.7);
  const Eigen::Vector3d hand(reach * std::cos(0.3), reach * std::sin(0.3), height);
  EXPECT_TRUE(state.getGlobalLinkTransform("hand").translation().isApprox(hand, TIGHT));
  state.setVariablePosition("stand/x", 2.0);
  EXPECT_TRUE(state.getFrameTransform("hand").translation().isApprox(hand + 2.0 * Eigen::Vector3d::UnitX(), TIGHT));
  bool found = true;
  state.getFrameTransform("no_such", &found);
  EXPECT_FALSE(found);
  state.getVariablePositions()[3] = 0.0;  // written to directly
  state.update(true);
  EXPECT_NEAR(state.getGlobalLinkTransform("hand").translation().y(), 0.0, TIGHT);
  state.updateStateWithLinkAt("upper", Eigen::Isometry3d::Identity());
  EXPECT_TRUE(state.getGlobalLinkTransform("upper").isApprox(Eigen::Isometry3d::Identity()));
  EXPECT_NEAR(state.getGlobalLinkTransform("column").translation().x(), 2.0, TIGHT);
}

TEST(RobotState, groupsInTheOrderOfTheirVariables)
{
  RobotState state = readyState();
  std::vector<double> values;
  state.copyJointGroupPositions("manipulator", values);
  EXPECT_EQ(values, (std::vector<double>{ 0.3, 0.5, 1.2 }));
  Eigen::VectorXd vector;
  state.copyJointGroupPositions(state.getJointModelGroup("manipulator"), vector);
  EXPECT_EQ(vector[2], 1.2);
  state.setJointGroupPositions("fingers", std::vector<double>{ 0.03, 0.0 });
  EXPECT_EQ(state.getVariablePosition("grip_mirror"), 0.03);
  EXPECT_THROW(state.setJointGroupPositions("manipulator", std::vector<double>{ 1.0 }), moveit::Exception);
  EXPECT_FALSE(state.hasVelocities());
  EXPECT_EQ(state.getVariableVelocity("lift"), 0.0);
  state.setJointGroupVelocities("manipulator", std::vector<double>{ 1.0, 2.0, 3.0 });
  EXPECT_TRUE(state.hasVelocities());
  EXPECT_EQ(state.getVariableVelocity("lift"), 2.0);
  EXPECT_FALSE(state.satisfiesBounds(state.getJointModelGroup("manipulator")));
}

TEST(RobotState, randomValuesAreWithinBoundsAndRepeatWithASeed)
{
  RobotState a = readyState(), b(a);
  const JointModelGroup* arm = a.getJointModelGroup("manipulator");
  random_numbers::RandomNumberGenerator first(7), second(7);
  a.setToRandomPositions(arm, first);
  b.setToRandomPositions(arm, second);
  EXPECT_EQ(a.distance(b), 0.0);
  EXPECT_TRUE(a.satisfiesBounds(arm));
  EXPECT_GT(a.distance(readyState(), arm), 0.0);
  const RobotState seed(a);
  a.setToRandomPositionsNearBy(arm, seed, 0.1);
  EXPECT_GT(a.distance(seed, arm), 0.0);
  for (const JointModel* joint : arm->getActiveJointModels())
    EXPECT_LE(a.distance(seed, joint), 0.1 + TIGHT);
}

TEST(RobotState, jacobianIsTheDerivativeOfThePose)
{
  RobotState state = readyState();
  state.setVariablePosition("stand/theta", 0.8);
  const JointModelGroup* arm = state.getJointModelGroup("manipulator");
  const Eigen::MatrixXd J = state.getJacobian(arm);
  ASSERT_EQ(J.rows(), 6);
  ASSERT_EQ(J.cols(), 3);
  const Eigen::Isometry3d base = state.getGlobalLinkTransform("base");
  const double h = 1e-6;
  for (int k = 0; k < 3; ++k)
  {
    RobotState moved(state);
    moved.setVariablePosition(arm->getVariableIndexList()[k], state.getVariablePosition(arm->getVariableIndexList()[k]) + h);
    const Eigen::Vector3d v =
        base.linear().transpose() *
        (moved.getGlobalLinkTransform("hand").translation() - state.getGlobalLinkTransform("hand").translation()) / h;
    EXPECT_TRUE(v.isApprox(J.col(k).head<3>(), 1e-5)) << v.transpose() << " and " << J.col(k).transpose();
  }
  Eigen::MatrixXd with_quaternion;
  ASSERT_TRUE(state.getJacobian(arm, state.getLinkModel("hand"), Eigen::Vector3d::Zero(), with_quaternion, true));
  auto turned = [&base](const RobotState& s) {
    const Eigen::Quaterniond q((base.inverse() * s.getGlobalLinkTransform("hand")).linear());
    return Eigen::Vector4d(q.w(), q.x(), q.y(), q.z());
  };
  RobotState moved(state);
  moved.setVariablePosition("bend", state.getVariablePosition("bend") + h);
  EXPECT_TRUE(((turned(moved) - turned(state)) / h).isApprox(with_quaternion.col(2).tail<4>(), 1e-5));
}

TEST(RobotState, twistMovesTheTip)
{
  RobotState state = readyState();
  const JointModelGroup* arm = state.getJointModelGroup("manipulator");
  const Eigen::Isometry3d before = state.getGlobalLinkTransform("hand");
  Eigen::VectorXd twist = Eigen::VectorXd::Zero(6);
  twist << 0.02, 0, 0.01, 0, 0, 0;
  Eigen::VectorXd qdot;
  state.computeVariableVelocity(arm, qdot, twist, state.getLinkModel("hand"));
  ASSERT_TRUE(state.integrateVariableVelocity(arm, qdot, 1e-3));
  const Eigen::Vector3d way =
      before.linear().transpose() * (state.getGlobalLinkTransform("hand").translation() - before.translation());
  const Eigen::MatrixXd J = readyState().getJacobian(arm);
  const Eigen::Vector3d wanted = before.linear().transpose() * (J * qdot).head<3>() * 1e-3;
  EXPECT_TRUE(way.isApprox(wanted, 1e-3)) << way.transpose() << " and " << wanted.transpose();
}

TEST(RobotState, carriedBodiesMoveAlongAndAreCopied)
{
  RobotState state = readyState();
  FixedTransformsMap subframes;
  subframes["tip"] = Eigen::Isometry3d(Eigen::Translation3d(0, 0, 0.1));
  state.attachBody("tool", Eigen::Isometry3d(Eigen::Translation3d(0, 0, 0.2)), { std::make_shared<shapes::Box>(0.1, 0.1, 0.1) },
                   { Eigen::Isometry3d(Eigen::Translation3d(0.5, 0, 0)) }, std::vector<std::string>{ "left" }, "hand",
                   trajectory_msgs::JointTrajectory(), subframes);
  RobotState copy(state);
  copy.setVariablePosition("turn", 0.0);
  copy.setVariablePosition("lift", 0.0);
  copy.setVariablePosition("bend", 0.0);
  EXPECT_TRUE(copy.getFrameTransform("tool/tip").translation().isApprox(Eigen::Vector3d(0, 0, 1.6), TIGHT));
  EXPECT_TRUE(copy.getAttachedBody("tool")->getGlobalCollisionBodyTransforms()[0].translation().isApprox(
      Eigen::Vector3d(0.5, 0, 1.5), TIGHT));
  EXPECT_FALSE(state.getFrameTransform("tool/tip").isApprox(copy.getFrameTransform("tool/tip")));
  EXPECT_EQ(copy.core().attached().size(), 1u);
  EXPECT_TRUE(copy.clearAttachedBody("tool"));
  EXPECT_EQ(copy.core().attached().size(), 0u);
  EXPECT_TRUE(state.hasAttachedBody("tool"));
  EXPECT_FALSE(haveSameAttachedObjects(state, copy));
}

TEST(Conversions, stateToMessageAndBack)
{
  RobotState state = readyState(), other(state.getRobotModel());
  state.setVariablePosition("stand/y", 1.5);
  state.setVariablePosition("stand/theta", -0.4);
  state.attachBody("tool", Eigen::Isometry3d(Eigen::Translation3d(0, 0, 0.2)), { std::make_shared<shapes::Sphere>(0.1) },
                   { Eigen::Isometry3d::Identity() }, std::set<std::string>{ "left", "right" }, "hand");
  moveit_msgs::RobotState message;
  robotStateToRobotStateMsg(state, message);
  EXPECT_EQ(message.joint_state.name.size(), 5u);
  EXPECT_EQ(message.multi_dof_joint_state.joint_names, Names{ "stand" });
  ASSERT_TRUE(robotStateMsgToRobotState(message, other));
  EXPECT_NEAR(other.distance(state), 0.0, 1e-9);
  EXPECT_TRUE(haveSameAttachedObjects(state, other));
  EXPECT_EQ(other.getAttachedBody("tool")->getTouchLinks(), (std::set<std::string>{ "left", "right" }));
}

TEST(Conversions, whatIsNoStateIsRefused)
{
  RobotState state = readyState();
  const RobotState before(state);
  moveit_msgs::RobotState message;
  EXPECT_FALSE(robotStateMsgToRobotState(message, state));
  sensor_msgs::JointState joints;
  joints.name = { "lift", "bend" };
  joints.position = { 1.0 };
  EXPECT_FALSE(jointStateToRobotState(joints, state));
  EXPECT_EQ(state.distance(before), 0.0);
}

TEST(Srdf, writtenAndReadAgain)
{
  const RobotModelPtr model = makeArm();
  srdf::SRDFWriter writer;
  writer.initModel(*model->getURDF(), *model->getSRDF());
  writer.groups_[0].name_ = "crane";
  writer.updateSRDFModel(*model->getURDF());
  const srdf::Model& read = *writer.srdf_model_;
  EXPECT_EQ(read.getGroups()[0].name_, "crane");
  EXPECT_EQ(read.getGroups()[0].chains_[0].second, "hand");
  EXPECT_EQ(read.getGroupStates()[0].joint_values_.at("bend"), std::vector<double>{ 1.2 });
  EXPECT_EQ(read.getDisabledCollisionPairs().size(), 5u);
  EXPECT_EQ(read.getEndEffectors()[0].component_group_, "fingers");
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::Time::init();
  return RUN_ALL_TESTS();
}
