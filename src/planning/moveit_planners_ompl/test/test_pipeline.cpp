// Compiled planner and adapters in a pipeline; constraint samplers; planning and execution within one program (MoveItCpp).
#include <geometric_shapes/shapes.h>
#include <gtest/gtest.h>
#include <ros/ros.h>

#include <cmath>
#include <ctime>
#include <memory>
#include <thread>

#include <moveit/constraint_samplers/constraint_sampler_manager.h>
#include <moveit/constraint_samplers/default_constraint_samplers.h>
#include <moveit/kinematic_constraints/utils.h>
#include <moveit/moveit_cpp/planning_component.h>
#include <moveit/planning_pipeline/planning_pipeline.h>
#include <moveit/robot_model_loader/robot_model_loader.h>
#include <moveit/robot_state/conversions.h>

using moveit_msgs::MoveItErrorCodes;
using planning_interface::MotionPlanRequest;
using planning_interface::MotionPlanResponse;

namespace
{
const robot_model_loader::RobotModelLoader& loader()
{
  static const robot_model_loader::RobotModelLoader made("robot_description");
  return made;
}

planning_scene::PlanningScenePtr homeScene()
{
  const auto scene = std::make_shared<planning_scene::PlanningScene>(loader().getModel());
  scene->getCurrentStateNonConst().setToDefaultValues("manipulator", "home");
  scene->getCurrentStateNonConst().update();
  return scene;
}

planning_pipeline::PlanningPipeline& pipeline()
{
  static planning_pipeline::PlanningPipeline made(loader().getModel(), ros::NodeHandle("~/ompl"));
  return made;
}

MotionPlanRequest to(const std::string& pose)
{
  moveit::core::RobotState goal(loader().getModel());
  goal.setToDefaultValues("manipulator", pose);
  MotionPlanRequest request;
  request.group_name = "manipulator";
  request.allowed_planning_time = 5.0;
  request.goal_constraints = { kinematic_constraints::constructGoalConstraints(goal, goal.getJointModelGroup("manipulator"),
                                                                               1e-4) };
  return request;
}

geometry_msgs::PoseStamped poseOf(const std::string& state_name)
{
  moveit::core::RobotState state(loader().getModel());
  state.setToDefaultValues("manipulator", state_name);
  state.update();
  geometry_msgs::PoseStamped pose;
  pose.header.frame_id = loader().getModel()->getModelFrame();
  const Eigen::Isometry3d& there = state.getGlobalLinkTransform("hand");
  const Eigen::Quaterniond turn(there.linear());
  pose.pose.position.x = there.translation().x();
  pose.pose.position.y = there.translation().y();
  pose.pose.position.z = there.translation().z();
  pose.pose.orientation.x = turn.x();
  pose.pose.orientation.y = turn.y();
  pose.pose.orientation.z = turn.z();
  pose.pose.orientation.w = turn.w();
  return pose;
}
}  // namespace

TEST(Pipeline, plansToJointsAndPosesWithTimes)
{
  for (const bool joints : { true, false })
  {
    MotionPlanRequest request = to("left");
    if (!joints)
      request.goal_constraints = { kinematic_constraints::constructGoalConstraints("hand", poseOf("left"), 1e-3, 1e-2) };
    MotionPlanResponse response;
    ASSERT_TRUE(pipeline().generatePlan(homeScene(), request, response));
    EXPECT_EQ(response.error_code_.val, MoveItErrorCodes::SUCCESS);
    ASSERT_GT(response.trajectory_->getWayPointCount(), 2u);
    EXPECT_GT(response.trajectory_->getDuration(), 0.3);
    EXPECT_GT(response.planning_time_, 0.0);
    EXPECT_NEAR(response.trajectory_->getFirstWayPoint().getVariablePosition("joint_2"), -0.6, 1e-9);
    kinematic_constraints::KinematicConstraintSet goal(loader().getModel());
    goal.add(request.goal_constraints[0], homeScene()->getTransforms());
    EXPECT_TRUE(goal.decide(response.trajectory_->getLastWayPoint()).satisfied);
  }
}

TEST(Pipeline, refusalsHaveTheirCodes)
{
  MotionPlanRequest request = to("left");
  MotionPlanResponse response;
  request.group_name = "legs";
  EXPECT_FALSE(pipeline().generatePlan(homeScene(), request, response));
  EXPECT_EQ(response.error_code_.val, MoveItErrorCodes::FAILURE);
  request.group_name = "manipulator";
  request.goal_constraints.clear();
  EXPECT_FALSE(pipeline().generatePlan(homeScene(), request, response));
  EXPECT_EQ(response.error_code_.val, MoveItErrorCodes::INVALID_GOAL_CONSTRAINTS);
  geometry_msgs::PoseStamped far = poseOf("left");
  far.pose.position.x = 30.0;
  request.goal_constraints = { kinematic_constraints::constructGoalConstraints("hand", far) };
  EXPECT_FALSE(pipeline().generatePlan(homeScene(), request, response));
  EXPECT_EQ(response.error_code_.val, MoveItErrorCodes::GOAL_STATE_INVALID);
  planning_pipeline::PlanningPipeline absent(loader().getModel(), ros::NodeHandle("~/absent"));
  EXPECT_FALSE(absent.getPlannerManager());
  EXPECT_FALSE(absent.generatePlan(homeScene(), to("left"), response));
}

TEST(Pipeline, startsAreMended)
{
  const auto scene = homeScene();
  moveit::core::RobotState& state = scene->getCurrentStateNonConst();
  const double limit = loader().getModel()->getVariableBounds("joint_2").min_position_;
  state.setVariablePosition("joint_2", limit - 0.05);
  MotionPlanResponse response;
  std::vector<std::size_t> added;
  ASSERT_TRUE(pipeline().generatePlan(scene, to("left"), response, added));
  EXPECT_EQ(added, (std::vector<std::size_t>{ 0 }));
  EXPECT_NEAR(response.trajectory_->getFirstWayPoint().getVariablePosition("joint_2"), limit - 0.05, 1e-9);
  EXPECT_NEAR(response.trajectory_->getWayPoint(1).getVariablePosition("joint_2"), limit, 1e-6);
  state.setVariablePosition("joint_2", limit - 0.3);
  EXPECT_FALSE(pipeline().generatePlan(scene, to("left"), response));

  // A plate that the hand just touches.
  const auto touching = homeScene();
  const Eigen::Vector3d hand = touching->getCurrentState().getGlobalLinkTransform("hand").translation();
  const auto plate = std::make_shared<shapes::Box>(0.02, 0.02, 0.02);
  Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
  place.translation() = hand + Eigen::Vector3d(0.5, 0.0, 0.0);
  touching->getWorldNonConst()->addToObject("plate", plate, place);
  while (!touching->isStateColliding("manipulator") && place.translation().x() > hand.x())
  {
    place.translation().x() -= 0.001;
    touching->getWorldNonConst()->moveShapeInObject("plate", plate, place);
  }
  ASSERT_TRUE(touching->isStateColliding("manipulator"));
  ASSERT_TRUE(pipeline().generatePlan(touching, to("left"), response, added));
  EXPECT_EQ(added, (std::vector<std::size_t>{ 0 }));
}

TEST(Pipeline, pathConstraintsAreReachedFirst)
{
  MotionPlanRequest request = to("left");
  request.path_constraints.joint_constraints.resize(1);
  request.path_constraints.joint_constraints[0].joint_name = "joint_6";
  request.path_constraints.joint_constraints[0].tolerance_above =
      request.path_constraints.joint_constraints[0].tolerance_below = 0.1;
  request.path_constraints.joint_constraints[0].weight = 1.0;
  const auto scene = homeScene();
  scene->getCurrentStateNonConst().setVariablePosition("joint_6", 0.8);
  MotionPlanResponse response;
  std::vector<std::size_t> added;
  ASSERT_TRUE(pipeline().generatePlan(scene, request, response, added));
  EXPECT_GE(added.size(), 2u);
  for (std::size_t i = 0; i < response.trajectory_->getWayPointCount(); ++i)
    if (std::find(added.begin(), added.end(), i) == added.end())
      EXPECT_LE(std::abs(response.trajectory_->getWayPoint(i).getVariablePosition("joint_6")), 0.1 + 1e-6);
}

TEST(Pipeline, terminateEndsASearch)
{
  MotionPlanRequest request = to("left");
  request.planner_id = "RRTstar";  // goes on improving until its time is over
  request.allowed_planning_time = 60.0;
  MotionPlanResponse response;
  const ros::WallTime began = ros::WallTime::now();
  std::thread end([]() {
    while (!pipeline().isActive())
      ros::WallDuration(0.01).sleep();
    const std::clock_t start = std::clock();
    while (std::clock() - start < CLOCKS_PER_SEC / 4)  // of the processor: the search is under way
      ros::WallDuration(0.01).sleep();
    pipeline().terminate();
  });
  EXPECT_FALSE(pipeline().generatePlan(homeScene(), request, response));
  EXPECT_EQ(response.error_code_.val, MoveItErrorCodes::PREEMPTED);
  EXPECT_LT((ros::WallTime::now() - began).toSec(), 20.0);
  end.join();
}

TEST(Samplers, keepToConstraints)
{
  using constraint_samplers::ConstraintSamplerManager;
  const auto scene = homeScene();
  moveit_msgs::Constraints constraints = kinematic_constraints::constructGoalConstraints("hand", poseOf("left"), 0.02, 0.2);
  const auto sampler = ConstraintSamplerManager::selectDefaultSampler(scene, "manipulator", constraints);
  ASSERT_TRUE(sampler);
  EXPECT_EQ(sampler->getName(), "IKConstraintSampler");
  kinematic_constraints::KinematicConstraintSet all(loader().getModel());
  all.add(constraints, scene->getTransforms());
  std::set<double> different;
  moveit::core::RobotState state(scene->getCurrentState());
  for (int i = 0; i < 20; ++i)
  {
    ASSERT_TRUE(sampler->sample(state, scene->getCurrentState(), 20));
    EXPECT_TRUE(all.decide(state).satisfied);
    different.insert(state.getVariablePosition("joint_1"));
  }
  EXPECT_GT(different.size(), 10u);

  constraints = moveit_msgs::Constraints();
  constraints.joint_constraints.resize(1);
  constraints.joint_constraints[0].joint_name = "joint_3";
  constraints.joint_constraints[0].position = 0.5;
  constraints.joint_constraints[0].tolerance_above = constraints.joint_constraints[0].tolerance_below = 0.01;
  const auto joints = ConstraintSamplerManager::selectDefaultSampler(scene, "manipulator", constraints);
  ASSERT_TRUE(joints);
  const auto& joint_sampler = dynamic_cast<constraint_samplers::JointConstraintSampler&>(*joints);
  EXPECT_EQ(joint_sampler.getConstrainedJointCount(), 1u);
  EXPECT_EQ(joint_sampler.getUnconstrainedJointCount(), 5u);
  for (int i = 0; i < 20; ++i)
  {
    ASSERT_TRUE(joints->sample(state));
    EXPECT_NEAR(state.getVariablePosition("joint_3"), 0.5, 0.01);
    EXPECT_TRUE(state.satisfiesBounds());
  }
  constraints.joint_constraints[0].position =
      100.0;  // beyond the limit as a whole: the limit, as upstream's JointConstraint has it
  const auto limit = ConstraintSamplerManager::selectDefaultSampler(scene, "manipulator", constraints);
  ASSERT_TRUE(limit);
  ASSERT_TRUE(limit->sample(state));
  EXPECT_NEAR(state.getVariablePosition("joint_3"), scene->getRobotModel()->getVariableBounds("joint_3").max_position_, 1e-9);
  constraints.joint_constraints.push_back(constraints.joint_constraints[0]);
  constraints.joint_constraints[1].position = 0.5;
  EXPECT_FALSE(ConstraintSamplerManager::selectDefaultSampler(scene, "manipulator", constraints));
  EXPECT_FALSE(ConstraintSamplerManager::selectDefaultSampler(scene, "legs", constraints));
  EXPECT_FALSE(ConstraintSamplerManager::selectDefaultSampler(
      scene, "hand", kinematic_constraints::constructGoalConstraints("hand", poseOf("left"))));
}

TEST(MoveItCpp, plansExecutesAndStops)
{
  const auto cpp = std::make_shared<moveit_cpp::MoveItCpp>(ros::NodeHandle("~"));
  EXPECT_EQ(cpp->getPlanningPipelines().size(), 1u);
  // joint_state_publisher says zeros until it has heard of the controllers where the robot is.
  for (int i = 0; i < 1000 && std::abs(cpp->getCurrentState(0.0)->getVariablePosition("joint_2") + 0.6) > 0.01; ++i)
    ros::WallDuration(0.01).sleep();
  moveit_cpp::PlanningComponent arm("manipulator", cpp);
  EXPECT_FALSE(arm.plan());  // no goal
  EXPECT_FALSE(arm.execute());
  EXPECT_FALSE(arm.setGoal("nowhere"));
  ASSERT_TRUE(arm.setGoal("left"));
  ASSERT_TRUE(arm.plan());
  ASSERT_TRUE(arm.execute());
  EXPECT_NEAR(cpp->getCurrentState(2.0)->getVariablePosition("joint_1"), 1.2, 0.01);

  // What starts elsewhere is not executed.
  arm.setStartState("zeros");
  ASSERT_TRUE(arm.setGoal("home"));
  ASSERT_TRUE(arm.plan());
  EXPECT_FALSE(arm.execute());

  arm.setStartStateToCurrentState();
  ASSERT_TRUE(arm.plan());
  ASSERT_TRUE(arm.execute(false));
  const auto execution = cpp->getTrajectoryExecutionManagerNonConst();
  for (int i = 0; i < 500 && cpp->getCurrentState(0.0)->getVariablePosition("joint_1") > 1.15; ++i)
    ros::WallDuration(0.01).sleep();
  execution->stopExecution();
  EXPECT_EQ(execution->getLastExecutionStatus(), moveit_controller_manager::ExecutionStatus::PREEMPTED);
  EXPECT_GT(cpp->getCurrentState(2.0)->getVariablePosition("joint_1"), 0.05);

  moveit_msgs::RobotTrajectory wrong;
  wrong.joint_trajectory.joint_names = { "joint_1" };
  wrong.joint_trajectory.points.resize(1);
  EXPECT_FALSE(execution->push(wrong));
  wrong.joint_trajectory.points[0].positions = { 0.5 };
  wrong.joint_trajectory.points[0].time_from_start = ros::Duration(1.0);
  EXPECT_FALSE(execution->push(wrong, "no_controller"));
  EXPECT_TRUE(execution->push(wrong));
  execution->clear();
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "pipeline");
  ros::AsyncSpinner spinner(4);
  spinner.start();
  return RUN_ALL_TESTS();
}
