// A robot from parameters, and scenes that follow topics and each other.
#include <gtest/gtest.h>
#include <moveit/planning_scene_monitor/planning_scene_monitor.h>
#include <moveit/robot_state/cartesian_interpolator.h>
#include <ros/ros.h>

#include <cmath>
#include <condition_variable>
#include <mutex>

using planning_scene_monitor::LockedPlanningSceneRO;
using planning_scene_monitor::PlanningSceneMonitor;

namespace
{
robot_model_loader::RobotModelLoaderPtr loader()
{
  static const auto made = std::make_shared<robot_model_loader::RobotModelLoader>("robot_description");
  return made;
}

// Waits until `good`, asked after each update of the scene.
template <typename Good>
bool waitFor(const planning_scene_monitor::PlanningSceneMonitorPtr& monitor, const Good& good)
{
  std::mutex mutex;
  std::condition_variable updated;
  bool done = false;
  monitor->addUpdateCallback([&](PlanningSceneMonitor::SceneUpdateType) {
    const std::lock_guard<std::mutex> lock(mutex);
    done = done || good(*LockedPlanningSceneRO(monitor).operator->());
    updated.notify_all();
  });
  const bool already = good(*LockedPlanningSceneRO(monitor).operator->());
  std::unique_lock<std::mutex> lock(mutex);
  done = done || already;
  const bool met = updated.wait_for(lock, std::chrono::seconds(20), [&]() { return done; });
  lock.unlock();
  monitor->clearUpdateCallbacks();
  return met;
}
}  // namespace

// As upstream: a limit sets its flag, a flag that is given wins; limits of variables go by their own names.
TEST(Loader, limitsWithoutFlagsAndOfAPlanarJointCount)
{
  robot_model_loader::RobotModelLoader mobile("mobile_description", false);
  const moveit::core::RobotModelPtr model = mobile.getModel();
  ASSERT_TRUE(model);
  const moveit::core::VariableBounds& x = model->getVariableBounds("base/x");
  EXPECT_TRUE(x.velocity_bounded_ && x.position_bounded_);
  EXPECT_EQ(x.max_velocity_, 0.2);
  EXPECT_EQ(x.min_position_, -1.0);
  EXPECT_EQ(x.max_position_, 2.0);
  const moveit::core::VariableBounds& theta = model->getVariableBounds("base/theta");
  EXPECT_TRUE(theta.acceleration_bounded_);
  EXPECT_FALSE(theta.velocity_bounded_);
  EXPECT_NE(theta.max_position_, 1.0);  // an angle without end has none
  EXPECT_FALSE(model->getVariableBounds("base/y").velocity_bounded_);
  const moveit::core::VariableBounds& first = model->getVariableBounds("joint_1");
  EXPECT_TRUE(first.velocity_bounded_ && first.acceleration_bounded_);
  EXPECT_EQ(first.max_velocity_, 1.5);
  EXPECT_EQ(first.max_acceleration_, 0.5);
  const moveit::core::VariableBounds& second = model->getVariableBounds("joint_2");
  EXPECT_FALSE(second.velocity_bounded_ || second.acceleration_bounded_);
  const moveit::core::VariableBounds& third = model->getVariableBounds("joint_3");  // flags without a number
  EXPECT_FALSE(third.acceleration_bounded_);
  EXPECT_TRUE(third.velocity_bounded_);  // the URDF's
  EXPECT_GT(third.max_velocity_, 0.0);
}

TEST(Loader, aLineEndsAtAJointsLimitAndNoJointSpinsBack)
{
  robot_model_loader::RobotModelLoader mobile("mobile_description");
  const moveit::core::RobotModelPtr model = mobile.getModel();
  ASSERT_TRUE(model);
  moveit::core::JointModelGroup* group = model->getJointModelGroup("manipulator");
  const moveit::core::LinkModel* hand = model->getLinkModel("hand");
  for (const double turn : { 0.6, -0.6 })
  {
    moveit::core::RobotState state(model);
    state.setToDefaultValues();
    state.setJointGroupPositions(group, std::vector<double>{ 0.0, -0.6, 1.6, 0.0, 1.0, 6.1 });  // 0.18 rad before the limit
    const Eigen::Isometry3d goal = state.getGlobalLinkTransform(hand) * Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ());
    std::vector<moveit::core::RobotStatePtr> path;
    const double share = moveit::core::CartesianInterpolator::computeCartesianPath(
        &state, group, path, hand, goal, true, moveit::core::MaxEEFStep(0.01), moveit::core::JumpThreshold());
    for (std::size_t i = 1; i < path.size(); ++i)
      EXPECT_LT(path[i]->distance(*path[i - 1], group), 0.2);
    if (turn > 0)
      EXPECT_NEAR(share, 0.3, 0.06);
    else
      EXPECT_EQ(share, 1.0);
  }
}

TEST(Loader, limitsAndSolversAreThoseOfTheParameters)
{
  const moveit::core::RobotModelPtr model = loader()->getModel();
  ASSERT_TRUE(model);
  EXPECT_EQ(model->getVariableBounds("joint_1").max_acceleration_, 4.0);
  moveit::core::JointModelGroup* group = model->getJointModelGroup("manipulator");
  ASSERT_TRUE(group->getSolverInstance());
  EXPECT_EQ(group->getDefaultIKTimeout(), 0.05);
  EXPECT_FALSE(model->getJointModelGroup("hand")->getSolverInstance());

  moveit::core::RobotState state(model);
  state.setToDefaultValues(group, "left");
  const Eigen::Isometry3d tcp = state.getGlobalLinkTransform("tcp");
  state.setToDefaultValues(group, "home");
  ASSERT_TRUE(state.setFromIK(group, tcp, "tcp", 0.5));  // bolted to the tip that the solver knows
  EXPECT_TRUE(state.getGlobalLinkTransform("tcp").isApprox(tcp, 1e-4));
  Eigen::Isometry3d far = tcp;
  far.translation().x() = 9.0;
  EXPECT_FALSE(state.setFromIK(group, far, "tcp", 0.05));
  int asked = 0;
  EXPECT_FALSE(state.setFromIK(
      group, tcp, "tcp", 0.05,
      [&](moveit::core::RobotState*, const moveit::core::JointModelGroup*, const double*) { return ++asked < 0; }));
  EXPECT_GT(asked, 0);
}

TEST(Monitor, followsJointStatesAndObjectsAndHandsItsSceneOn)
{
  const auto monitor = std::make_shared<PlanningSceneMonitor>(loader());
  ros::NodeHandle nh;
  ros::Publisher objects = nh.advertise<moveit_msgs::CollisionObject>("collision_object", 1, true);
  moveit_msgs::CollisionObject post;
  post.id = "post";
  post.header.frame_id = "world";
  post.primitives.resize(1);
  post.primitives[0].type = shape_msgs::SolidPrimitive::BOX;
  post.primitives[0].dimensions.assign(3, 0.2);
  post.primitive_poses.resize(1);
  post.primitive_poses[0].position.x = 0.1;
  post.primitive_poses[0].position.z = 0.5;
  post.primitive_poses[0].orientation.w = post.pose.orientation.w = 1.0;
  objects.publish(post);
  monitor->startWorldGeometryMonitor();
  EXPECT_TRUE(waitFor(monitor, [](const planning_scene::PlanningScene& scene) { return scene.getWorld()->hasObject("post"); }));
  EXPECT_TRUE(LockedPlanningSceneRO(monitor)->isStateColliding());

  ros::Publisher joints = nh.advertise<sensor_msgs::JointState>("joint_states", 1, true);
  sensor_msgs::JointState state;
  state.name = { "joint_1", "joint_2", "joint_3", "joint_4", "joint_5", "joint_6", "finger_joint" };
  state.position = { 1.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.01 };
  monitor->startStateMonitor();
  const ros::WallTime since = ros::WallTime::now();
  while (!joints.getNumSubscribers() && ros::WallTime::now() - since < ros::WallDuration(20))
    ros::WallDuration(0.01).sleep();
  state.header.stamp = ros::Time::now();
  joints.publish(state);
  ASSERT_TRUE(monitor->waitForCurrentRobotState(state.header.stamp, 10.0));
  EXPECT_EQ(LockedPlanningSceneRO(monitor)->getCurrentState().getVariablePosition("joint_1"), 1.0);
  EXPECT_EQ(LockedPlanningSceneRO(monitor)->getCurrentState().getVariablePosition("finger_mirror"), 0.01);

  monitor->providePlanningSceneService("scene_of_the_test");
  const auto other = std::make_shared<PlanningSceneMonitor>(loader());
  ASSERT_TRUE(other->requestPlanningSceneState("scene_of_the_test"));
  EXPECT_TRUE(LockedPlanningSceneRO(other)->getWorld()->hasObject("post"));
  EXPECT_EQ(LockedPlanningSceneRO(other)->getCurrentState().getVariablePosition("joint_6"), 0.5);
}

TEST(Monitor, knowsTheFramesOfTFAndSendsThemAsUpstreamDoes)
{
  const auto buffer = std::make_shared<tf2_ros::Buffer>();
  PlanningSceneMonitor monitor(loader(), buffer);
  const std::string frame = monitor.getPlanningScene()->getPlanningFrame();
  geometry_msgs::TransformStamped camera;
  camera.header.frame_id = frame;
  camera.child_frame_id = "camera";
  camera.transform.translation.x = 1.5;
  camera.transform.rotation.w = 1.0;
  buffer->setTransform(camera, "test", true);
  monitor.updateFrameTransforms();
  ASSERT_TRUE(monitor.getPlanningScene()->knowsFrameTransform("camera"));
  EXPECT_EQ(monitor.getPlanningScene()->getFrameTransform("camera").translation().x(), 1.5);
  moveit_msgs::PlanningScene message;
  monitor.getPlanningScene()->getPlanningSceneMsg(message);
  bool told = false;
  for (const auto& transform : message.fixed_frame_transforms)
    told = told || (transform.header.frame_id == "camera" && transform.child_frame_id == frame);
  EXPECT_TRUE(told);
  planning_scene::PlanningScene other(loader()->getModel());
  ASSERT_TRUE(other.setPlanningSceneMsg(message));
  EXPECT_EQ(other.getFrameTransform("camera").translation().x(), 1.5);
}

// One face of two: move_group's monitor, which is Python, does the same.
namespace
{
// What strangers' functions take, as MoveIt's own do.
std::size_t objectsOf(const planning_scene::PlanningSceneConstPtr& scene) { return scene->getWorld()->size(); }
void clear(const planning_scene::PlanningScenePtr& scene) { scene->removeAllCollisionObjects(); }
}  // namespace

// Upstream's planning_scene_monitor.h: one to write derives from one to read and becomes either pointer.
TEST(Monitor, aLockedSceneGoesWhereAPointerToOneIsTaken)
{
  const auto monitor = std::make_shared<PlanningSceneMonitor>(loader());
  moveit_msgs::CollisionObject box;
  box.id = "box";
  box.header.frame_id = monitor->getRobotModel()->getModelFrame();
  box.primitives.resize(1);
  box.primitives[0].type = shape_msgs::SolidPrimitive::BOX;
  box.primitives[0].dimensions = { 0.1, 0.1, 0.1 };
  box.primitive_poses.resize(1);
  box.primitive_poses[0].orientation.w = 1.0;
  moveit_msgs::PlanningScene with_box;
  with_box.is_diff = with_box.robot_state.is_diff = true;
  with_box.world.collision_objects = { box };
  const planning_scene::PlanningScenePtr copy = monitor->copyPlanningScene(with_box);
  EXPECT_EQ(objectsOf(copy), 1u);
  EXPECT_FALSE(monitor->updatesScene(copy));
  EXPECT_TRUE(monitor->updatesScene(monitor->getPlanningScene()));
  {
    planning_scene_monitor::LockedPlanningSceneRW scene(monitor);
    ASSERT_TRUE(scene);
    EXPECT_EQ(objectsOf(scene), 0u);
    scene->processCollisionObjectMsg(box);
    EXPECT_EQ(objectsOf(static_cast<const planning_scene::PlanningSceneConstPtr&>(scene)), 1u);
    clear(scene);
    LockedPlanningSceneRO& as_reader = scene;
    EXPECT_EQ(objectsOf(as_reader), 0u);
  }
  EXPECT_FALSE(LockedPlanningSceneRO(planning_scene_monitor::PlanningSceneMonitorPtr()));
}

// Upstream's configureDefaultPadding() and configureCollisionMatrix().
TEST(Monitor, takesPaddingsAndCollisionOperationsFromTheParameters)
{
  const auto monitor = std::make_shared<PlanningSceneMonitor>("padded_description");
  EXPECT_EQ(monitor->getDefaultRobotPadding(), 0.02);
  EXPECT_EQ(monitor->getDefaultRobotScale(), 1.5);
  EXPECT_EQ(monitor->getDefaultObjectPadding(), 0.03);
  EXPECT_EQ(monitor->getDefaultAttachedObjectPadding(), 0.04);
  const LockedPlanningSceneRO scene(monitor);
  EXPECT_EQ(scene->getCollisionEnv()->getLinkPadding("link_4"), 0.1);
  EXPECT_EQ(scene->getCollisionEnv()->getLinkScale("link_4"), 1.0);
  EXPECT_EQ(scene->getCollisionEnv()->getLinkPadding("hand"), 0.02);
  EXPECT_EQ(scene->getCollisionEnv()->getLinkScale("hand"), 1.5);
  collision_detection::AllowedCollision::Type type;
  ASSERT_TRUE(scene->getAllowedCollisionMatrix().getEntry("base_link", "hand", type));
  EXPECT_EQ(type, collision_detection::AllowedCollision::ALWAYS);
}

TEST(StateMonitor, ignoresWhatIsNoNumberAndTakesJointStatesWithoutAStamp)
{
  planning_scene_monitor::CurrentStateMonitor monitor(loader()->getModel(), nullptr);
  ros::NodeHandle nh;
  ros::Publisher joints = nh.advertise<sensor_msgs::JointState>("odd_joint_states", 10, true);
  monitor.startStateMonitor("odd_joint_states");
  sensor_msgs::JointState state;
  state.name = { "joint_1", "joint_2", "joint_3", "joint_4", "joint_5", "joint_6", "finger_joint" };
  state.position = { 0.3, 0.1, 0.2, 0.3, 0.4, 0.5, 0.01 };
  const ros::Time before = ros::Time::now();
  joints.publish(state);  // its stamp is zero
  ASSERT_TRUE(monitor.waitForCurrentState(before, 20.0));
  EXPECT_EQ(monitor.getCurrentState()->getVariablePosition("joint_1"), 0.3);
  for (const double odd : { std::nan(""), HUGE_VAL })
  {
    state.position[0] = odd;
    state.position[1] += 0.1;
    state.header.stamp = ros::Time::now();
    joints.publish(state);
    const ros::WallTime since = ros::WallTime::now();
    while (monitor.getCurrentState()->getVariablePosition("joint_2") != state.position[1] &&
           ros::WallTime::now() - since < ros::WallDuration(20))
      ros::WallDuration(0.01).sleep();
    EXPECT_EQ(monitor.getCurrentState()->getVariablePosition("joint_2"), state.position[1]);
    EXPECT_EQ(monitor.getCurrentState()->getVariablePosition("joint_1"), 0.3);
  }
}

// A stamp of before is another publisher's repetition while the robot is heard of, and a bag that began again when it is not. MoveIt 1
// takes the first for the second.
TEST(StateMonitor, takesABagThatBeginsAgainAndNoRepetition)
{
  planning_scene_monitor::CurrentStateMonitor monitor(loader()->getModel(), nullptr);
  ros::Publisher joints = ros::NodeHandle().advertise<sensor_msgs::JointState>("late_joint_states", 10, true);
  monitor.startStateMonitor("late_joint_states");
  sensor_msgs::JointState state;
  state.name = { "joint_1", "joint_2", "joint_3", "joint_4", "joint_5", "joint_6" };
  state.position = { 0.3, 0.1, 0.2, 0.3, 0.4, 0.5 };
  const auto say = [&](double value, const ros::Time& stamp) {
    sensor_msgs::JointState marker;  // of another joint: when it is in, what came before it is
    marker.name = { "finger_joint" };
    marker.position = { value / 100 };
    marker.header.stamp = ros::Time::now() + ros::Duration(10.0);
    state.position[0] = value;
    state.header.stamp = stamp;
    joints.publish(state);
    joints.publish(marker);
    const ros::WallTime since = ros::WallTime::now();
    while (monitor.getCurrentState()->getVariablePosition("finger_joint") != value / 100 &&
           ros::WallTime::now() - since < ros::WallDuration(20))
      ros::WallDuration(0.01).sleep();
    return monitor.getCurrentState()->getVariablePosition("joint_1");
  };
  const ros::Time now = ros::Time::now();
  EXPECT_EQ(say(0.31, now + ros::Duration(0.2)), 0.31);
  EXPECT_EQ(say(0.32, now - ros::Duration(0.1)), 0.31);
  EXPECT_EQ(say(0.33, now - ros::Duration(60.0)), 0.31);
  EXPECT_EQ(say(0.34, now + ros::Duration(0.3)), 0.34);
  EXPECT_TRUE(monitor.haveCompleteState(now));

  planning_scene_monitor::CurrentStateMonitor bag(loader()->getModel(), nullptr);
  bag.startStateMonitor("bag_joint_states");
  ros::Publisher recorded = ros::NodeHandle().advertise<sensor_msgs::JointState>("bag_joint_states", 10, true);
  const auto play = [&](double value, double stamp) {
    state.name = { "joint_1" };
    state.position = { value };
    state.header.stamp = ros::Time(stamp);
    recorded.publish(state);
    const ros::WallTime since = ros::WallTime::now();
    while (bag.getCurrentState()->getVariablePosition("joint_1") != value &&
           ros::WallTime::now() - since < ros::WallDuration(20))
      ros::WallDuration(0.01).sleep();
    return bag.getCurrentState()->getVariablePosition("joint_1");
  };
  EXPECT_EQ(play(0.5, 1000.0), 0.5);
  EXPECT_EQ(play(0.6, 1009.0), 0.6);
  EXPECT_EQ(play(0.1, 1000.0), 0.1);
  EXPECT_EQ(play(0.2, 1000.1), 0.2);
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "test_monitor");
  ros::NodeHandle node;
  const int result = RUN_ALL_TESTS();
  ros::shutdown();
  return result;
}
