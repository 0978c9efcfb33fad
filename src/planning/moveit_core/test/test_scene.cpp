#include <geometric_shapes/shapes.h>
#include <gtest/gtest.h>
#include <octomap/octomap.h>
#include <ros/time.h>

#include <moveit/kinematic_constraints/utils.h>
#include <moveit/planning_scene/scene_difference.h>
#include <moveit/robot_state/conversions.h>
#include <moveit/trajectory_processing/iterative_time_parameterization.h>
#include <moveit/trajectory_processing/time_optimal_trajectory_generation.h>

#include "scenes.hpp"

// The arm stands upright: the fingers' lower edges are at 1.32 m, upper's end at 0.85 m; the box's face is at 1.95 m, lower's at 0.02 m.
// FCL's distance of two boxes whose faces are parallel is some millimetres off.
TEST(Scene, distancesAreOfWhatWasAskedFor)
{
  const auto scene = std::make_shared<PlanningScene>(makeArm());
  scene->getCurrentStateNonConst().setToDefaultValues();
  ASSERT_TRUE(scene->processCollisionObjectMsg(box("far", 2.0, 0.0, 1.1, 0.1)));
  const auto env = scene->getCollisionEnv();
  const moveit::core::RobotState& state = scene->getCurrentState();
  const auto& allowed = scene->getAllowedCollisionMatrix();
  collision_detection::CollisionRequest request;
  request.distance = true;
  collision_detection::CollisionResult self, world, both;
  env->checkSelfCollision(request, self, state, allowed);
  env->checkRobotCollision(request, world, state, allowed);
  scene->checkCollision(request, both);
  EXPECT_NEAR(self.distance, 0.47, 0.005);
  EXPECT_NEAR(world.distance, 1.93, 1e-6);
  EXPECT_NEAR(both.distance, 0.47, 0.005);
  EXPECT_NEAR(env->distanceSelf(state, allowed), 0.47, 0.005);
  EXPECT_NEAR(env->distanceRobot(state, allowed), 1.93, 1e-6);
}

// The figures are those of the test before.
TEST(Scene, distancesOfPairsAreToldByNames)
{
  const auto scene = std::make_shared<PlanningScene>(makeArm());
  scene->getCurrentStateNonConst().setToDefaultValues();
  ASSERT_TRUE(scene->processCollisionObjectMsg(box("far", 2.0, 0.0, 1.1, 0.1)));
  ASSERT_TRUE(scene->processCollisionObjectMsg(box("farther", 3.0, 0.0, 1.1, 0.1)));
  collision_detection::DistanceRequest request;
  request.acm = &scene->getAllowedCollisionMatrix();
  request.group_name = "manipulator";
  request.enableGroup(scene->getRobotModel());
  collision_detection::DistanceResult result;
  scene->getCollisionEnv()->distanceRobot(request, result, scene->getCurrentState());
  EXPECT_NEAR(result.minimum_distance.distance, 1.93, 1e-6);
  EXPECT_EQ(result.minimum_distance.link_names[1] == "far" ? result.minimum_distance.link_names[0]
                                                           : result.minimum_distance.link_names[1],
            "lower");
  EXPECT_TRUE(result.distances.empty());
  EXPECT_FALSE(result.collision);

  result.clear();
  request.type = collision_detection::DistanceRequestType::SINGLE;
  scene->getCollisionEnv()->distanceRobot(request, result, scene->getCurrentState());
  EXPECT_EQ(result.distances.size(), 10u);  // each of the five links that have a shape with each of both boxes
  const auto& pair = result.distances.at({ "farther", "lower" });
  ASSERT_EQ(pair.size(), 1u);
  EXPECT_NEAR(pair[0].distance, 2.93, 1e-6);

  result.clear();
  request.distance_threshold = 1.0;
  scene->getCollisionEnv()->distanceRobot(request, result, scene->getCurrentState());
  EXPECT_TRUE(result.distances.empty());

  result.clear();
  request.type = collision_detection::DistanceRequestType::GLOBAL;
  scene->getCollisionEnv()->distanceSelf(request, result, scene->getCurrentState());
  EXPECT_NEAR(result.minimum_distance.distance, 0.47, 0.005);
}

TEST(Scene, objectsCollideUntilTheyAreAllowedToOrGone)
{
  const PlanningScenePtr scene = readyScene();
  EXPECT_FALSE(scene->isStateColliding());
  const Eigen::Vector3d elbow = scene->getCurrentState().getGlobalLinkTransform("lower").translation();
  ASSERT_TRUE(scene->processCollisionObjectMsg(box("post", elbow.x(), elbow.y(), elbow.z(), 0.1)));
  collision_detection::CollisionRequest request;
  request.contacts = true;
  request.max_contacts = 100;
  collision_detection::CollisionResult result;
  scene->checkCollision(request, result);
  EXPECT_TRUE(result.collision);
  EXPECT_EQ(result.contacts.count({ "lower", "post" }), 1u);
  EXPECT_EQ(result.contacts.count({ "post", "upper" }), 1u);
  std::vector<std::string> links;
  scene->getCollidingLinks(links);
  EXPECT_EQ(links, (std::vector<std::string>{ "lower", "upper" }));
  result.clear();
  scene->checkSelfCollision(request, result);
  EXPECT_FALSE(result.collision);

  collision_detection::AllowedCollisionMatrix allowed = scene->getAllowedCollisionMatrix();
  allowed.setEntry("post", std::vector<std::string>{ "lower", "upper" }, true);
  result.clear();
  scene->checkCollision(request, result, scene->getCurrentState(), allowed);
  EXPECT_FALSE(result.collision);
  EXPECT_TRUE(scene->isStateColliding());                             // the scene's own matrix is as it was
  scene->getAllowedCollisionMatrixNonConst().setEntry("post", true);  // with all that have a row
  EXPECT_FALSE(scene->isStateColliding());

  scene->getAllowedCollisionMatrixNonConst().removeEntry("post");
  EXPECT_TRUE(scene->isStateColliding());
  scene->getWorldNonConst()->setObjectPose("post", Eigen::Isometry3d(Eigen::Translation3d(3, 0, 0)));
  EXPECT_FALSE(scene->isStateColliding());
}

TEST(Scene, permissionsAndColoursEndWithTheirObject)
{
  const PlanningScenePtr scene = readyScene();
  const Eigen::Vector3d elbow = scene->getCurrentState().getGlobalLinkTransform("lower").translation();
  for (const char* removed : { "post", "" })
  {
    ASSERT_TRUE(scene->processCollisionObjectMsg(box("post", elbow.x(), elbow.y(), elbow.z(), 0.1)));
    EXPECT_TRUE(scene->isStateColliding());
    scene->getAllowedCollisionMatrixNonConst().setEntry("post", std::vector<std::string>{ "lower", "upper" }, true);
    scene->getAllowedCollisionMatrixNonConst().setEntry("lower", "upper", true);
    scene->setObjectColor("post", std_msgs::ColorRGBA());
    EXPECT_FALSE(scene->isStateColliding());

    moveit_msgs::AttachedCollisionObject held;  // in the hand it is still there
    held.link_name = "hand";
    held.object.id = "post";
    ASSERT_TRUE(scene->processAttachedCollisionObjectMsg(held));
    EXPECT_TRUE(scene->hasObjectColor("post"));
    held.object.operation = moveit_msgs::CollisionObject::REMOVE;
    ASSERT_TRUE(scene->processAttachedCollisionObjectMsg(held));
    EXPECT_FALSE(scene->isStateColliding());

    moveit_msgs::CollisionObject removal;
    removal.id = removed;
    removal.operation = moveit_msgs::CollisionObject::REMOVE;
    ASSERT_TRUE(scene->processCollisionObjectMsg(removal));
    EXPECT_FALSE(scene->hasObjectColor("post"));
    collision_detection::AllowedCollision::Type type;
    EXPECT_FALSE(scene->getAllowedCollisionMatrix().getEntry("post", "lower", type));
    EXPECT_TRUE(scene->getAllowedCollisionMatrix().getEntry("lower", "upper", type));
  }
}

TEST(Scene, attachedObjectsAreChangedAndLetGoAsTheMessageSays)
{
  const PlanningScenePtr scene = readyScene();
  moveit_msgs::AttachedCollisionObject held;
  held.link_name = "hand";
  held.touch_links = { "hand", "left" };
  held.object = box("post", 0, 0, 0.1, 0.02);
  held.object.header.frame_id = "hand";
  ASSERT_TRUE(scene->processAttachedCollisionObjectMsg(held));
  held.object.operation = moveit_msgs::CollisionObject::APPEND;
  held.touch_links = { "right" };
  ASSERT_TRUE(scene->processAttachedCollisionObjectMsg(held));
  const auto* body = scene->getCurrentState().getAttachedBody("post");
  EXPECT_EQ(body->getShapes().size(), 2u);
  EXPECT_EQ(body->getTouchLinks().count("left") + body->getTouchLinks().count("right"), 2u);
  for (const Eigen::Isometry3d& pose : body->getShapePosesInLinkFrame())
    EXPECT_TRUE(pose.translation().isApprox(Eigen::Vector3d(0, 0, 0.1), 1e-9));

  moveit_msgs::AttachedCollisionObject map = held;
  map.object.operation = moveit_msgs::CollisionObject::ADD;
  map.object.id = PlanningScene::OCTOMAP_NS;
  EXPECT_FALSE(scene->processAttachedCollisionObjectMsg(map));

  moveit_msgs::AttachedCollisionObject away;
  away.object.operation = moveit_msgs::CollisionObject::REMOVE;
  for (const auto& [link, id] : { std::pair<std::string, std::string>("upper", "post"), { "claw", "" }, { "", "ghost" } })
  {
    away.link_name = link;
    away.object.id = id;
    EXPECT_FALSE(scene->processAttachedCollisionObjectMsg(away)) << link << " " << id;
    EXPECT_TRUE(scene->getCurrentState().hasAttachedBody("post"));
  }
  away.link_name = away.object.id = "";
  EXPECT_TRUE(scene->processAttachedCollisionObjectMsg(away));
  EXPECT_TRUE(scene->getWorld()->hasObject("post"));
}

TEST(Scene, whatVanishesWithAWholeStateIsForgotten)
{
  const PlanningScenePtr scene = readyScene();
  moveit_msgs::AttachedCollisionObject held;
  held.link_name = "hand";
  held.object = box("post", 0, 0, 0.1, 0.02);
  held.object.header.frame_id = "hand";
  ASSERT_TRUE(scene->processAttachedCollisionObjectMsg(held));
  scene->setObjectColor("post", std_msgs::ColorRGBA());
  moveit_msgs::RobotState whole;
  moveit::core::robotStateToRobotStateMsg(scene->getCurrentState(), whole, false);
  whole.is_diff = false;
  scene->setCurrentState(whole);
  EXPECT_FALSE(scene->getCurrentState().hasAttachedBody("post"));
  EXPECT_FALSE(scene->hasObjectColor("post"));
}

// The column's bounds are 0.1 m wide about the origin and reach from 0.05 to 0.35 m: those of the posts share known boxes with it.
TEST(Scene, costsAreTheBoxesThatShapesShare)
{
  const auto scene = std::make_shared<PlanningScene>(makeArm());
  ASSERT_TRUE(scene->processCollisionObjectMsg(box("near", 0.08, 0, 0.2, 0.1)));
  ASSERT_TRUE(scene->processCollisionObjectMsg(box("nearer", -0.06, 0, 0.2, 0.06)));
  collision_detection::CollisionRequest request;
  request.cost = true;
  request.max_cost_sources = 10;
  collision_detection::CollisionResult result;
  scene->checkCollision(request, result);
  ASSERT_TRUE(result.collision);
  ASSERT_EQ(result.cost_sources.size(), 2u);
  const auto &first = *result.cost_sources.begin(), &second = *std::next(result.cost_sources.begin());
  EXPECT_NEAR(first.getVolume(), 0.02 * 0.1 * 0.1, 1e-9);
  EXPECT_NEAR(first.aabb_min[0], 0.03, 1e-9);
  EXPECT_NEAR(first.aabb_max[0], 0.05, 1e-9);
  EXPECT_NEAR(second.getVolume(), 0.02 * 0.06 * 0.06, 1e-9);
  EXPECT_EQ(first.cost, 1.0);
  request.max_cost_sources = 1;
  collision_detection::CollisionResult one;
  scene->checkCollision(request, one);
  ASSERT_EQ(one.cost_sources.size(), 1u);
  EXPECT_NEAR(one.cost_sources.begin()->getVolume(), first.getVolume(), 1e-12);
  std::set<collision_detection::CostSource> costs;
  scene->getCostSources(scene->getCurrentState(), 10, "manipulator", costs);
  ASSERT_EQ(costs.size(), 2u);
  EXPECT_NEAR(costs.begin()->getVolume(), first.getVolume(), 1e-12);
  robot_trajectory::RobotTrajectory still(scene->getRobotModel(), "manipulator");
  still.addSuffixWayPoint(scene->getCurrentState(), 0.0);
  scene->getCostSources(still, 10, costs);
  EXPECT_TRUE(costs.empty());  // those of the first state are left out, as upstream
  request.cost = false;
  collision_detection::CollisionResult none;
  scene->checkCollision(request, none);
  EXPECT_TRUE(none.cost_sources.empty());
}

TEST(Scene, aFunctionMayDecideAboutContacts)
{
  const PlanningScenePtr scene = readyScene();
  const Eigen::Vector3d elbow = scene->getCurrentState().getGlobalLinkTransform("lower").translation();
  scene->processCollisionObjectMsg(box("post", elbow.x(), elbow.y(), elbow.z(), 0.1));
  int asked = 0;
  bool answer = true;
  const collision_detection::DecideContactFn decide = [&](collision_detection::Contact&) { return ++asked, answer; };
  scene->getAllowedCollisionMatrixNonConst().setEntry("post", "lower", decide);
  scene->getAllowedCollisionMatrixNonConst().setEntry("post", "upper", decide);
  EXPECT_FALSE(scene->isStateColliding());
  EXPECT_GT(asked, 0);
  answer = false;
  EXPECT_TRUE(scene->isStateColliding());
}

TEST(Scene, diffsLeaveTheirParentAlone)
{
  const PlanningScenePtr scene = readyScene();
  scene->processCollisionObjectMsg(box("far", 3, 0, 0, 0.1));
  const PlanningScenePtr child = scene->diff();
  const Eigen::Vector3d elbow = scene->getCurrentState().getGlobalLinkTransform("lower").translation();
  child->processCollisionObjectMsg(box("post", elbow.x(), elbow.y(), elbow.z(), 0.1));
  child->getWorldNonConst()->removeObject("far");
  EXPECT_TRUE(child->isStateColliding());
  EXPECT_FALSE(scene->isStateColliding());
  EXPECT_TRUE(scene->knowsFrameTransform("far"));
  moveit_msgs::PlanningScene message;
  child->getPlanningSceneDiffMsg(message);
  ASSERT_EQ(message.world.collision_objects.size(), 2u);
  ASSERT_TRUE(scene->usePlanningSceneMsg(message));
  EXPECT_TRUE(scene->isStateColliding());
  EXPECT_FALSE(scene->knowsFrameTransform("far"));
}

// A gripper takes, lets go, takes with another link, and an object vanishes out of it: each step as a message makes the same scene.
TEST(Scene, theDifferenceOfTwoScenesMakesOneOfTheOther)
{
  const PlanningScenePtr scene = readyScene(), copy = readyScene();
  const auto attach = [](const std::string& link, int operation) {
    moveit_msgs::AttachedCollisionObject cup;
    cup.link_name = link, cup.object.id = "cup", cup.object.operation = operation;
    return cup;
  };
  const auto names = [](const PlanningScene& which) {
    std::vector<const moveit::core::AttachedBody*> bodies;
    which.getCurrentState().getAttachedBodies(bodies);
    std::string text;
    for (const std::string& id : which.getWorld()->getObjectIds())
      text += id + " ";
    for (const moveit::core::AttachedBody* body : bodies)
      text += body->getName() + "@" + body->getAttachedLinkName();
    return text;
  };
  using Object = moveit_msgs::CollisionObject;
  const std::vector<std::pair<std::string, std::function<void(PlanningScene&)>>> steps = {
    { "cup ", [](PlanningScene& s) { s.processCollisionObjectMsg(box("cup", 3, 0, 0, 0.1)); } },
    { "cup@hand", [&](PlanningScene& s) { s.processAttachedCollisionObjectMsg(attach("hand", Object::ADD)); } },
    { "cup ", [&](PlanningScene& s) { s.processAttachedCollisionObjectMsg(attach("hand", Object::REMOVE)); } },
    { "cup@lower", [&](PlanningScene& s) { s.processAttachedCollisionObjectMsg(attach("lower", Object::ADD)); } },
    { "", [](PlanningScene& s) { s.getCurrentStateNonConst().clearAttachedBodies(); } },
    { "", [](PlanningScene& s) { s.getAllowedCollisionMatrixNonConst().setEntry("hand", "lower", true); } },
  };
  for (const auto& [wanted, step] : steps)
  {
    const PlanningScenePtr child = scene->diff();
    step(*child);
    moveit_msgs::PlanningScene message;
    child->getPlanningSceneDiffMsg(message);
    EXPECT_TRUE(copy->usePlanningSceneMsg(message)) << wanted;
    EXPECT_EQ(names(*copy), wanted);
    EXPECT_EQ(names(*child), wanted);
    step(*scene);
  }
  collision_detection::AllowedCollision::Type allowed;
  ASSERT_TRUE(copy->getAllowedCollisionMatrix().getEntry("hand", "lower", allowed));
  EXPECT_TRUE(planning_scene::difference(*scene, *copy).allowed_collision_matrix.entry_names.empty());
}

TEST(Scene, octomapsGoByMessageAndGoAway)
{
  const PlanningScenePtr scene = readyScene();
  const auto tree = std::make_shared<octomap::OcTree>(0.1);
  tree->updateNode(octomap::point3d(3, 0, 0), true);
  scene->processOctomapPtr(tree, Eigen::Isometry3d::Identity());
  const auto there = [](const PlanningScenePtr& which) { return which->getWorld()->hasObject(PlanningScene::OCTOMAP_NS); };
  moveit_msgs::PlanningScene message;
  scene->getPlanningSceneMsg(message);
  const PlanningScenePtr other = readyScene();
  ASSERT_TRUE(other->usePlanningSceneMsg(message));
  EXPECT_TRUE(there(other));
  moveit_msgs::PlanningScene nothing;
  nothing.is_diff = true;
  ASSERT_TRUE(other->usePlanningSceneMsg(nothing));
  EXPECT_TRUE(there(other));
  const PlanningScenePtr child = scene->diff();
  child->getWorldNonConst()->removeObject(PlanningScene::OCTOMAP_NS);
  child->getPlanningSceneDiffMsg(message);
  EXPECT_TRUE(message.world.collision_objects.empty());
  ASSERT_TRUE(other->usePlanningSceneMsg(message));
  EXPECT_FALSE(there(other));
  other->processOctomapPtr(tree, Eigen::Isometry3d::Identity());
  ASSERT_TRUE(other->processPlanningSceneWorldMsg(moveit_msgs::PlanningSceneWorld()));
  EXPECT_FALSE(there(other));
}

TEST(Scene, messageAndBack)
{
  const PlanningScenePtr scene = readyScene();
  scene->processCollisionObjectMsg(box("far", 3, 0, 1, 0.1));
  scene->getCollisionEnvNonConst()->setLinkPadding("lower", 0.02);
  moveit_msgs::AttachedCollisionObject attach;
  attach.link_name = "hand";
  attach.object.id = "far";
  ASSERT_TRUE(scene->processAttachedCollisionObjectMsg(attach));
  EXPECT_FALSE(scene->getWorld()->hasObject("far"));
  EXPECT_TRUE(scene->getFrameTransform("far").translation().isApprox(Eigen::Vector3d(3, 0, 1), 1e-9));
  moveit_msgs::PlanningScene message;
  scene->getPlanningSceneMsg(message);
  PlanningScene other(scene->getRobotModel());
  ASSERT_TRUE(other.usePlanningSceneMsg(message));
  EXPECT_TRUE(haveSameAttachedObjects(scene->getCurrentState(), other.getCurrentState()));
  EXPECT_EQ(other.getCollisionEnv()->getLinkPadding("lower"), 0.02);
  EXPECT_NEAR(other.getCurrentState().distance(scene->getCurrentState()), 0.0, 1e-9);
  collision_detection::AllowedCollision::Type type;
  EXPECT_TRUE(other.getAllowedCollisionMatrix().getEntry("left", "right", type));
  attach.object.operation = moveit_msgs::CollisionObject::REMOVE;
  ASSERT_TRUE(other.processAttachedCollisionObjectMsg(attach));
  EXPECT_TRUE(other.getWorld()->hasObject("far"));
}

TEST(Scene, distanceToTheWorldIsNotThatToItself)
{
  const PlanningScenePtr scene = readyScene();
  scene->processCollisionObjectMsg(box("far", 3, 0, 0.2, 0.2));
  const double distance = scene->distanceToCollision(scene->getCurrentState());
  EXPECT_GT(distance, 1.0);
  EXPECT_LT(distance, 2.9);
}

// As upstream, and as move_group sends them: the header names the frame, the child is the planning frame.
TEST(Transforms, aMessageNamesItsFrameInTheHeader)
{
  moveit::core::Transforms transforms("world");
  geometry_msgs::TransformStamped camera;
  camera.header.frame_id = "camera";
  camera.child_frame_id = "/world";
  camera.transform.translation.x = 1.5;
  camera.transform.rotation.w = 1.0;
  geometry_msgs::TransformStamped lamp = camera;  // in TF's notation
  lamp.header.frame_id = "world";
  lamp.child_frame_id = "lamp";
  transforms.setTransforms({ camera, lamp });
  EXPECT_EQ(transforms.getTransform("camera").translation().x(), 1.5);
  EXPECT_EQ(transforms.getTransform("world").translation().x(), 0.0);
  std::vector<geometry_msgs::TransformStamped> messages;
  transforms.copyTransforms(messages);
  ASSERT_EQ(messages.size(), 2u);  // the lamp's is left out
  EXPECT_EQ(messages[0].header.frame_id, "camera");
  EXPECT_EQ(messages[0].child_frame_id, "world");
  EXPECT_EQ(messages[0].transform.translation.x, 1.5);
}

TEST(Trajectory, timedWithinTheLimitsAndSentAsAMessage)
{
  const auto model = makeArm();
  moveit::core::RobotState state(model);
  for (const bool optimal : { false, true })
  {
    robot_trajectory::RobotTrajectory path(model, "manipulator");
    for (int i = 0; i <= 10; ++i)
    {
      state.setVariablePosition("lift", -0.5 + 0.1 * i);
      state.setVariablePosition("bend", 0.2 * i);
      path.addSuffixWayPoint(state, 0.0);
    }
    const trajectory_processing::TimeOptimalTrajectoryGeneration time_optimal;
    const trajectory_processing::IterativeParabolicTimeParameterization parabolic;
    const trajectory_processing::TimeParameterization& timing =
        optimal ? static_cast<const trajectory_processing::TimeParameterization&>(time_optimal) : parabolic;
    ASSERT_TRUE(timing.computeTimeStamps(path, 0.5, 1.0));
    EXPECT_GT(path.getDuration(), 2.0 / (0.5 * 2.0));  // bend goes 2 rad at no more than half of 2 rad/s
    for (std::size_t i = 0; i < path.getWayPointCount(); ++i)
    {
      EXPECT_LE(std::abs(path.getWayPoint(i).getVariableVelocity("bend")), 1.0 + 1e-3);
      EXPECT_LE(std::abs(path.getWayPoint(i).getVariableAcceleration("bend")), 1.0 + 1e-2);
    }
    moveit_msgs::RobotTrajectory message;
    path.getRobotTrajectoryMsg(message);
    EXPECT_EQ(message.joint_trajectory.joint_names, (std::vector<std::string>{ "turn", "lift", "bend" }));
    EXPECT_NEAR(message.joint_trajectory.points.back().time_from_start.toSec(), path.getDuration(), 1e-6);
    robot_trajectory::RobotTrajectory again(model, "manipulator");
    again.setRobotTrajectoryMsg(state, message);
    EXPECT_EQ(again.getWayPointCount(), path.getWayPointCount());
    auto between = std::make_shared<moveit::core::RobotState>(model);
    ASSERT_TRUE(again.getStateAtDurationFromStart(path.getDuration() / 2.0, between));
    EXPECT_GT(between->getVariablePosition("bend"), 0.5);
    EXPECT_LT(between->getVariablePosition("bend"), 1.5);
  }
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::Time::init();
  return RUN_ALL_TESTS();
}
