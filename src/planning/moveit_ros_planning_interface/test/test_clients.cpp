// Against move_group with pretended controllers. There is no spinner: none is needed.
#include <moveit/common_planning_interface_objects/common_objects.h>
#include <moveit/move_group_interface/move_group_interface.h>
#include <moveit/planning_scene_interface/planning_scene_interface.h>

#include <gtest/gtest.h>
#include <moveit_msgs/PlanningSceneComponents.h>

using moveit::planning_interface::MoveGroupInterface;
using moveit::planning_interface::PlanningSceneInterface;
using Codes = moveit_msgs::MoveItErrorCodes;
using Names = std::vector<std::string>;
using Values = std::vector<double>;

namespace {

const Values HOME = {0, -0.6, 1.6, 0, 1.0, 0};
const double PATIENCE = 30;  // s

template <class Condition>
bool comesTrue(Condition condition) {
  for (const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(PATIENCE); ros::WallTime::now() < end;
       ros::WallDuration(0.02).sleep())
    if (condition()) return true;
  return false;
}

class Clients : public testing::Test {
 protected:
  Clients() : arm_("manipulator", nullptr, ros::WallDuration(60)) {
    arm_.setMaxVelocityScalingFactor(1);
    arm_.setMaxAccelerationScalingFactor(1);
    EXPECT_TRUE(scene_.clear());
  }

  void goHome() {
    arm_.setNamedTarget("home");
    ASSERT_EQ(arm_.move(), Codes::SUCCESS);
  }

  void expectAt(const Values& expected, double tolerance) {
    const Values values = arm_.getCurrentJointValues();
    ASSERT_EQ(values.size(), expected.size());
    for (std::size_t i = 0; i < values.size(); ++i) EXPECT_NEAR(values[i], expected[i], tolerance) << "joint " << i;
  }

  MoveGroupInterface arm_;
  PlanningSceneInterface scene_ = sharedScene();

 private:
  // One for all tests: a publisher that comes and goes within a second is not always connected again.
  static PlanningSceneInterface& sharedScene() {
    static PlanningSceneInterface* const scene = new PlanningSceneInterface;
    return *scene;
  }
};

moveit_msgs::CollisionObject box(const std::string& name, double x, double y, double z, double edge) {
  moveit_msgs::CollisionObject object;
  object.header.frame_id = "world";
  object.id = name;
  object.operation = object.ADD;
  object.primitives.resize(1);
  object.primitives[0].type = shape_msgs::SolidPrimitive::BOX;
  object.primitives[0].dimensions = {edge, edge, edge};
  object.primitive_poses.resize(1);
  object.primitive_poses[0].position.x = x;
  object.primitive_poses[0].position.y = y;
  object.primitive_poses[0].position.z = z;
  object.primitive_poses[0].orientation.w = 1;
  return object;
}

TEST_F(Clients, KnowTheirGroup) {
  EXPECT_EQ(arm_.getName(), "manipulator");
  EXPECT_EQ(arm_.getPlanningFrame(), "world");
  EXPECT_EQ(arm_.getPoseReferenceFrame(), "world");
  EXPECT_EQ(arm_.getEndEffectorLink(), "hand");
  EXPECT_EQ(arm_.getVariableCount(), 6u);
  EXPECT_EQ(arm_.getVariableNames(), (Names{"joint_1", "joint_2", "joint_3", "joint_4", "joint_5", "joint_6"}));
  EXPECT_EQ(arm_.getActiveJoints(), arm_.getVariableNames());
  EXPECT_EQ(arm_.getLinkNames().back(), "hand");
  const Names& groups = arm_.getJointModelGroupNames();
  EXPECT_NE(std::find(groups.begin(), groups.end(), "hand"), groups.end());
  const Names& targets = arm_.getNamedTargets();
  EXPECT_NE(std::find(targets.begin(), targets.end(), "home"), targets.end());
  EXPECT_EQ(arm_.getNamedTargetValues("home").at("joint_3"), 1.6);
  EXPECT_TRUE(arm_.getNamedTargetValues("nowhere").empty());
  EXPECT_EQ(arm_.getRobotModel()->getName(), "arm");
  EXPECT_EQ(moveit::planning_interface::getSharedRobotModel("robot_description"), arm_.getRobotModel());
}

TEST_F(Clients, SayWhatIsMissing) {
  try {
    MoveGroupInterface legs("legs");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "Group 'legs' was not found.");
  }
  MoveGroupInterface::Options elsewhere("manipulator", "robot_description", ros::NodeHandle("/nowhere"));
  elsewhere.robot_model_ = arm_.getRobotModel();
  try {
    MoveGroupInterface lost(elsewhere, nullptr, ros::WallDuration(0.2));
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "Unable to connect to move_group action server 'move_group' within allotted time (0.2s)");
  }
  EXPECT_THROW(PlanningSceneInterface("/nowhere", false), std::runtime_error);
  EXPECT_FALSE(arm_.setNamedTarget("nowhere"));
  EXPECT_FALSE(arm_.setPoseTargets(std::vector<geometry_msgs::Pose>()));
}

TEST_F(Clients, MoveToNamedTargetsAndKnowWhereTheyAre) {
  goHome();
  expectAt(HOME, 1e-3);
  const moveit::core::RobotStatePtr state = arm_.getCurrentState(5);
  ASSERT_TRUE(state);
  const geometry_msgs::PoseStamped pose = arm_.getCurrentPose();
  EXPECT_EQ(pose.header.frame_id, "world");
  const Eigen::Vector3d p_WH = state->getGlobalLinkTransform("hand").translation();
  EXPECT_NEAR(pose.pose.position.x, p_WH.x(), 1e-6);
  EXPECT_NEAR(pose.pose.position.z, p_WH.z(), 1e-6);
  EXPECT_GT(p_WH.x(), 0.1);
  ASSERT_EQ(arm_.getCurrentRPY().size(), 3u);
  EXPECT_EQ(arm_.getRandomJointValues().size(), 6u);
  arm_.rememberJointValues("here");
  EXPECT_NEAR(arm_.getRememberedJointValues().at("here")[2], 1.6, 1e-3);
  EXPECT_TRUE(arm_.setNamedTarget("here"));
  arm_.forgetJointValues("here");
  EXPECT_FALSE(arm_.setNamedTarget("here"));
}

TEST_F(Clients, TakeJointTargetsInEveryForm) {
  Values values;
  EXPECT_TRUE(arm_.setJointValueTarget({0.1, 0.2, 0.3, 0.4, 0.5, 0.6}));
  arm_.getJointValueTarget(values);
  EXPECT_EQ(values, (Values{0.1, 0.2, 0.3, 0.4, 0.5, 0.6}));
  EXPECT_TRUE(arm_.setJointValueTarget(std::map<std::string, double>{{"joint_2", -0.5}}));
  EXPECT_TRUE(arm_.setJointValueTarget("joint_6", 0.9));
  EXPECT_TRUE(arm_.setJointValueTarget(Names{"joint_1", "joint_3"}, Values{0.7, 0.8}));
  sensor_msgs::JointState message;
  message.name = {"joint_4"};
  message.position = {0.25};
  EXPECT_TRUE(arm_.setJointValueTarget(message));
  arm_.getJointValueTarget(values);
  EXPECT_EQ(values, (Values{0.7, -0.5, 0.8, 0.25, 0.5, 0.9}));
  EXPECT_FALSE(arm_.setJointValueTarget(Values{1, 2}));
  EXPECT_FALSE(arm_.setJointValueTarget("finger_joint", 0.01));
  EXPECT_FALSE(arm_.setJointValueTarget(Names{"joint_1", "joint_7"}, Values{0, 0}));
  EXPECT_FALSE(arm_.setJointValueTarget(Values(6, 9.0)));  // out of bounds, and yet taken
  arm_.getJointValueTarget(values);
  EXPECT_EQ(values, Values(6, 9.0));
  moveit::core::RobotState state(arm_.getRobotModel());
  state.setToDefaultValues();
  EXPECT_TRUE(arm_.setJointValueTarget(state));
  EXPECT_EQ(arm_.getJointValueTarget().getVariablePosition("joint_3"), 0);
}

TEST_F(Clients, PlanThenExecute) {
  goHome();
  MoveGroupInterface::Plan plan;
  arm_.setJointValueTarget({1.0, -0.6, 1.6, 0, 1.0, 0});
  ASSERT_EQ(arm_.plan(plan), Codes::SUCCESS);
  EXPECT_GT(plan.trajectory_.joint_trajectory.points.size(), 1u);
  EXPECT_GT(plan.planning_time_, 0);
  EXPECT_FALSE(plan.start_state_.joint_state.name.empty());
  expectAt(HOME, 1e-3);  // a plan moves nothing
  ASSERT_EQ(arm_.execute(plan), Codes::SUCCESS);
  expectAt({1.0, -0.6, 1.6, 0, 1.0, 0}, 1e-3);
  EXPECT_EQ(arm_.execute(plan), Codes::CONTROL_FAILED);  // it begins elsewhere
  goHome();
  ASSERT_EQ(arm_.asyncExecute(plan), Codes::SUCCESS);
  EXPECT_TRUE(comesTrue([&] { return std::abs(arm_.getCurrentJointValues().at(0) - 1.0) < 1e-3; }));
}

TEST_F(Clients, StopEndsAMotion) {
  goHome();
  arm_.setMaxVelocityScalingFactor(0.05);
  arm_.setJointValueTarget({2.5, -0.6, 1.6, 0, 1.0, 0});
  ASSERT_EQ(arm_.asyncMove(), Codes::SUCCESS);
  ASSERT_TRUE(comesTrue([&] { return arm_.getCurrentJointValues().at(0) > 0.05; }));
  arm_.stop();
  ASSERT_TRUE(arm_.getMoveGroupClient().waitForResult(ros::Duration(PATIENCE)));
  EXPECT_NE(arm_.getMoveGroupClient().getState(), actionlib::SimpleClientGoalState::SUCCEEDED);
  EXPECT_LT(arm_.getCurrentJointValues().at(0), 2.4);
}

TEST_F(Clients, StopWhatTheyHaveJustAskedForAndNothingLater) {
  goHome();
  const std::vector<double> home = arm_.getCurrentJointValues();
  for (int count = 0; count < 5; ++count) {
    arm_.setJointValueTarget({1.5, -0.6, 1.6, 0, 1.0, 0});
    ASSERT_EQ(arm_.asyncMove(), Codes::SUCCESS);
    arm_.stop();
    ASSERT_TRUE(arm_.getMoveGroupClient().waitForResult(ros::Duration(PATIENCE)));
    EXPECT_NE(arm_.getMoveGroupClient().getState(), actionlib::SimpleClientGoalState::SUCCEEDED);
    EXPECT_NEAR(arm_.getCurrentJointValues().at(0), home.at(0), 0.02);
    arm_.stop();
    arm_.setJointValueTarget(home);
    EXPECT_EQ(arm_.move(), Codes::SUCCESS);
  }
}

TEST_F(Clients, ReachPosesAndFollowLines) {
  goHome();
  geometry_msgs::Pose target = arm_.getCurrentPose().pose;
  target.position.y += 0.1;
  target.position.z -= 0.05;
  ASSERT_TRUE(arm_.setPoseTarget(target));
  EXPECT_EQ(arm_.getPoseTarget().pose.position.y, target.position.y);
  ASSERT_EQ(arm_.move(), Codes::SUCCESS);
  geometry_msgs::Pose reached = arm_.getCurrentPose().pose;
  EXPECT_NEAR(reached.position.y, target.position.y, 1e-3);
  EXPECT_NEAR(reached.position.z, target.position.z, 1e-3);
  EXPECT_NEAR(std::abs(reached.orientation.w * target.orientation.w + reached.orientation.x * target.orientation.x +
                       reached.orientation.y * target.orientation.y + reached.orientation.z * target.orientation.z),
              1, 1e-3);

  std::vector<geometry_msgs::Pose> waypoints(2, reached);
  waypoints[0].position.z += 0.05;
  waypoints[1].position.z += 0.05;
  waypoints[1].position.y -= 0.05;
  moveit_msgs::RobotTrajectory line;
  moveit_msgs::MoveItErrorCodes code;
  EXPECT_EQ(arm_.computeCartesianPath(waypoints, 0.01, 0.0, line), 1.0);
  EXPECT_EQ(arm_.computeCartesianPath(waypoints, 0.01, line, true, &code), 1.0);
  EXPECT_EQ(code.val, Codes::SUCCESS);
  ASSERT_EQ(arm_.execute(line), Codes::SUCCESS);
  reached = arm_.getCurrentPose().pose;
  EXPECT_NEAR(reached.position.y, waypoints[1].position.y, 1e-3);
  EXPECT_NEAR(reached.position.z, waypoints[1].position.z, 1e-3);
  EXPECT_EQ(arm_.computeCartesianPath(waypoints, 0, 0.0, line, true, &code), -1.0);
  EXPECT_NE(code.val, Codes::SUCCESS);
}

TEST_F(Clients, FindJointsForAPose) {
  goHome();
  geometry_msgs::PoseStamped target = arm_.getCurrentPose();
  target.pose.position.x -= 0.05;
  ASSERT_TRUE(arm_.setJointValueTarget(target));
  const Eigen::Isometry3d X_WH = arm_.getJointValueTarget().getGlobalLinkTransform("hand");
  EXPECT_NEAR(X_WH.translation().x(), target.pose.position.x, 1e-4);
  geometry_msgs::PoseStamped in_hand;  // frames of the robot, too
  in_hand.header.frame_id = "hand";
  in_hand.pose.orientation.w = 1;
  in_hand.pose.position.z = -0.02;
  EXPECT_TRUE(arm_.setJointValueTarget(in_hand));
  target.pose.position.x = 9;
  EXPECT_FALSE(arm_.setJointValueTarget(target.pose));
  target.header.frame_id = "moon";
  EXPECT_FALSE(arm_.setJointValueTarget(target));
  ASSERT_TRUE(arm_.setEndEffector("gripper"));
  EXPECT_EQ(arm_.getEndEffectorLink(), "hand");
  EXPECT_FALSE(arm_.setEndEffector("claw"));
}

TEST_F(Clients, RequestsSayWhatWasSet) {
  arm_.setPlanningTime(7);
  arm_.setPlanningTime(-1);
  arm_.setNumPlanningAttempts(4);
  arm_.setPlanningPipelineId("ompl");
  arm_.setPlannerId("RRT");
  arm_.setMaxVelocityScalingFactor(3);
  arm_.setMaxAccelerationScalingFactor(0.25);
  arm_.limitMaxCartesianLinkSpeed(0.2, "hand");
  arm_.setWorkspace(-1, -2, 0, 1, 2, 3);
  arm_.setGoalPositionTolerance(0.02);
  arm_.setGoalOrientationTolerance(0.03);
  arm_.setGoalJointTolerance(0.04);
  moveit_msgs::Constraints upright;
  upright.orientation_constraints.resize(1);
  upright.orientation_constraints[0].link_name = "hand";
  arm_.setPathConstraints(upright);
  EXPECT_FALSE(arm_.setPathConstraints("upright"));
  moveit_msgs::MotionPlanRequest request;
  arm_.setJointValueTarget(HOME);
  arm_.constructMotionPlanRequest(request);
  EXPECT_EQ(request.group_name, "manipulator");
  EXPECT_EQ(request.allowed_planning_time, 7);
  EXPECT_EQ(request.num_planning_attempts, 4);
  EXPECT_EQ(request.pipeline_id, "ompl");
  EXPECT_EQ(request.planner_id, "RRT");
  EXPECT_EQ(request.max_velocity_scaling_factor, 1);
  EXPECT_EQ(request.max_acceleration_scaling_factor, 0.25);
  EXPECT_EQ(request.cartesian_speed_limited_link, "hand");
  EXPECT_EQ(request.workspace_parameters.min_corner.y, -2);
  EXPECT_EQ(request.workspace_parameters.header.frame_id, "world");
  EXPECT_TRUE(request.start_state.is_diff);
  ASSERT_EQ(request.goal_constraints.size(), 1u);
  ASSERT_EQ(request.goal_constraints[0].joint_constraints.size(), 6u);
  EXPECT_EQ(request.goal_constraints[0].joint_constraints[2].position, 1.6);
  EXPECT_EQ(request.goal_constraints[0].joint_constraints[2].tolerance_below, 0.04);
  EXPECT_EQ(request.path_constraints.orientation_constraints.size(), 1u);
  arm_.setPlanningPipelineId("chomp");
  EXPECT_EQ(arm_.getPlannerId(), "");
  arm_.clearPathConstraints();
  arm_.constructMotionPlanRequest(request);
  EXPECT_TRUE(request.path_constraints.orientation_constraints.empty());
}

TEST_F(Clients, GoalsOfPosesSayTheirTolerances) {
  arm_.setGoalPositionTolerance(0.02);
  arm_.setGoalOrientationTolerance(0.03);
  arm_.setPoseReferenceFrame("base_link");
  moveit_msgs::MotionPlanRequest request;
  arm_.setPositionTarget(0.3, 0.1, 0.4);
  arm_.constructMotionPlanRequest(request);
  ASSERT_EQ(request.goal_constraints.size(), 1u);
  EXPECT_TRUE(request.goal_constraints[0].orientation_constraints.empty());
  ASSERT_EQ(request.goal_constraints[0].position_constraints.size(), 1u);
  const moveit_msgs::PositionConstraint& position = request.goal_constraints[0].position_constraints[0];
  EXPECT_EQ(position.header.frame_id, "base_link");
  EXPECT_EQ(position.link_name, "hand");
  EXPECT_EQ(position.constraint_region.primitives.at(0).dimensions.at(0), 0.02);
  EXPECT_EQ(position.constraint_region.primitive_poses.at(0).position.z, 0.4);
  arm_.setRPYTarget(0, M_PI / 2, 0);
  arm_.constructMotionPlanRequest(request);
  ASSERT_EQ(request.goal_constraints[0].orientation_constraints.size(), 1u);
  EXPECT_TRUE(request.goal_constraints[0].position_constraints.empty());
  EXPECT_NEAR(request.goal_constraints[0].orientation_constraints[0].orientation.y, std::sqrt(0.5), 1e-9);
  EXPECT_EQ(request.goal_constraints[0].orientation_constraints[0].absolute_z_axis_tolerance, 0.03);
  EXPECT_EQ(arm_.getPoseTarget().pose.position.x, 0.3);  // the other part stays
  arm_.clearPoseTargets();
  arm_.constructMotionPlanRequest(request);
  EXPECT_TRUE(request.goal_constraints.empty());
}

TEST_F(Clients, StartStatesStickUntilReset) {
  goHome();
  const moveit::core::RobotStatePtr now = arm_.getCurrentState(PATIENCE);
  ASSERT_TRUE(now);
  moveit::core::RobotState start(*now);
  start.setVariablePosition("joint_1", -1.0);
  arm_.setStartState(start);
  arm_.setNamedTarget("left");
  for (int i = 0; i < 2; ++i) {
    MoveGroupInterface::Plan plan;
    ASSERT_EQ(arm_.plan(plan), Codes::SUCCESS);
    EXPECT_NEAR(plan.trajectory_.joint_trajectory.points.at(0).positions.at(0), i == 0 ? -1.0 : 0.0, 1e-3);
    arm_.setStartStateToCurrentState();
  }
}

TEST_F(Clients, AskMoveGroupForItsPlanners) {
  moveit_msgs::PlannerInterfaceDescription description;
  ASSERT_TRUE(arm_.getInterfaceDescription(description));
  EXPECT_EQ(description.name, "OMPL");
  EXPECT_EQ(arm_.getDefaultPlanningPipelineId(), "ompl");
  EXPECT_EQ(arm_.getDefaultPlannerId("manipulator"), "RRTConnect");
  arm_.setPlannerParams("RRT", "manipulator", {{"goal_bias", "0.25"}});
  EXPECT_EQ(arm_.getPlannerParams("RRT", "manipulator").at("goal_bias"), "0.25");
}

TEST_F(Clients, PutObjectsIntoTheScene) {
  std_msgs::ColorRGBA red;
  red.r = red.a = 1;
  ASSERT_TRUE(scene_.applyCollisionObject(box("near", 0.5, 0, 0.1, 0.1), red));
  ASSERT_TRUE(scene_.applyCollisionObjects({box("far", 3, 0, 0.1, 0.1), box("high", 0.5, 0, 2, 0.1)}));
  EXPECT_EQ(scene_.getKnownObjectNames().size(), 3u);
  EXPECT_TRUE(scene_.getKnownObjectNames(true).empty());
  EXPECT_EQ(scene_.getKnownObjectNamesInROI(0, -1, 0, 1, 1, 1), Names{"near"});
  EXPECT_EQ(scene_.getObjectPoses({"far"}).at("far").position.x, 3);
  EXPECT_EQ(scene_.getObjects().size(), 3u);
  EXPECT_EQ(scene_.getObjects({"high"}).count("high"), 1u);
  const auto colors = scene_.getPlanningSceneMsg(moveit_msgs::PlanningSceneComponents::OBJECT_COLORS).object_colors;
  ASSERT_EQ(colors.size(), 1u);
  EXPECT_EQ(colors[0].id, "near");
  scene_.removeCollisionObjects({"far", "high"});
  EXPECT_TRUE(comesTrue([&] { return scene_.getKnownObjectNames() == Names{"near"}; }));
  scene_.addCollisionObjects({box("late", 2, 0, 0, 0.1)});
  EXPECT_TRUE(comesTrue([&] { return scene_.getKnownObjectNames().size() == 2; }));
  ASSERT_TRUE(scene_.clear());
  EXPECT_TRUE(scene_.getKnownObjectNames().empty());
}

TEST_F(Clients, TakeObjectsInHand) {
  ASSERT_TRUE(scene_.applyCollisionObject(box("block", 3, 0, 0.1, 0.02)));
  ASSERT_TRUE(arm_.attachObject("block", "hand", {"finger_left", "finger_right"}));
  ASSERT_TRUE(comesTrue([&] { return scene_.getAttachedObjects().count("block") == 1; }));
  const Names touching = scene_.getAttachedObjects({"block"}).at("block").touch_links;
  EXPECT_NE(std::find(touching.begin(), touching.end(), "finger_left"), touching.end());
  EXPECT_TRUE(scene_.getKnownObjectNames().empty());
  ASSERT_TRUE(arm_.detachObject("block"));
  EXPECT_TRUE(comesTrue([&] { return scene_.getKnownObjectNames() == Names{"block"}; }));
}

TEST_F(Clients, PickAndPlaceGoalsAndTheirFailure) {
  arm_.setSupportSurfaceName("table");
  const moveit_msgs::PickupGoal goal = arm_.constructPickupGoal("block", {}, true);
  EXPECT_EQ(goal.target_name, "block");
  EXPECT_EQ(goal.group_name, "manipulator");
  EXPECT_TRUE(goal.planning_options.plan_only);
  EXPECT_TRUE(goal.allow_gripper_support_collision);
  geometry_msgs::PoseStamped pose;
  pose.header.frame_id = "world";
  const auto locations = arm_.posesToPlaceLocations({pose, pose});
  ASSERT_EQ(locations.size(), 2u);
  EXPECT_EQ(locations[0].pre_place_approach.direction.vector.z, -1);
  EXPECT_EQ(locations[0].post_place_retreat.direction.header.frame_id, "hand");
  EXPECT_NE(arm_.pick("no such block"), Codes::SUCCESS);
  EXPECT_NE(arm_.place("no such block", pose), Codes::SUCCESS);
  EXPECT_EQ(arm_.planGraspsAndPick("no such block"), Codes::INVALID_OBJECT_NAME);
}

// The same arm on a base whose place only a static transform tells, which came before anybody asked: 1 m ahead, 0.5 m to the right,
// turned by 0.3 rad.
TEST_F(Clients, SeeABaseThatAStaticTransformPlaced) {
  goHome();
  const Eigen::Isometry3d X_OW =
      Eigen::Translation3d(1.0, -0.5, 0.0) * Eigen::Isometry3d(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()));
  const Eigen::Vector3d p_WH = arm_.getCurrentState(5)->getGlobalLinkTransform("hand").translation(), p_OH = X_OW * p_WH;
  const std::map<std::string, Values> places{{"planar", {1.0, -0.5, 0.3}},
                                             {"floating", {1.0, -0.5, 0.0, 0.0, 0.0, std::sin(0.15), std::cos(0.15)}}};
  for (const auto& [kind, place] : places) {
    MoveGroupInterface arm(MoveGroupInterface::Options("manipulator", kind + "_description"));
    const geometry_msgs::PoseStamped pose = arm.getCurrentPose("hand");
    EXPECT_EQ(pose.header.frame_id, "odom");
    EXPECT_NEAR(pose.pose.position.x, p_OH.x(), 1e-3) << kind;
    EXPECT_NEAR(pose.pose.position.y, p_OH.y(), 1e-3) << kind;
    EXPECT_NEAR(pose.pose.position.z, p_OH.z(), 1e-3) << kind;
    const Values values =
        MoveGroupInterface(MoveGroupInterface::Options("base", kind + "_description")).getCurrentJointValues();
    ASSERT_EQ(values.size(), place.size());
    for (std::size_t i = 0; i < place.size(); ++i) EXPECT_NEAR(values[i], place[i], 1e-6) << kind << i;
  }
}

TEST_F(Clients, CanBeMoved) {
  MoveGroupInterface other(std::move(arm_));
  EXPECT_EQ(other.getName(), "manipulator");
  arm_ = std::move(other);
  EXPECT_EQ(arm_.getCurrentJointValues().size(), 6u);
}

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "test_clients");
  const ros::NodeHandle nh;
  return RUN_ALL_TESTS();
}
