#include <geometric_shapes/shapes.h>
#include <gtest/gtest.h>
#include <ros/time.h>

#include <moveit/background_processing/background_processing.h>
#include <moveit/collision_detection/collision_tools.h>
#include <moveit/collision_detection/world_diff.h>
#include <moveit/planning_request_adapter/planning_request_adapter.h>
#include <moveit/trajectory_processing/iterative_time_parameterization.h>
#include <moveit/trajectory_processing/limit_cartesian_speed.h>

#include "arm.hpp"

using planning_interface::MotionPlanRequest;
using planning_interface::MotionPlanResponse;
using planning_scene::PlanningScene;
using planning_scene::PlanningSceneConstPtr;
using planning_scene::PlanningScenePtr;

namespace
{
PlanningScenePtr readyScene()
{
  const auto scene = std::make_shared<PlanningScene>(makeArm());
  scene->getCurrentStateNonConst().setToDefaultValues("manipulator", "ready");
  return scene;
}

// Answers with the start alone, and remembers how it was asked.
class Standing : public planning_interface::PlanningContext
{
public:
  using PlanningContext::PlanningContext;
  bool solve(MotionPlanResponse& res) override
  {
    res.trajectory_ = std::make_shared<robot_trajectory::RobotTrajectory>(planning_scene_->getRobotModel(), group_);
    res.trajectory_->addSuffixWayPoint(planning_scene_->getCurrentState(), 0.0);
    res.error_code_.val = 1;
    return true;
  }
  bool solve(planning_interface::MotionPlanDetailedResponse& /*res*/) override { return false; }
  bool terminate() override { return terminated = true; }
  void clear() override {}
  bool terminated = false;
};

class StandingManager : public planning_interface::PlannerManager
{
public:
  using PlannerManager::getPlanningContext;
  planning_interface::PlanningContextPtr getPlanningContext(const PlanningSceneConstPtr& scene, const MotionPlanRequest& req,
                                                            moveit_msgs::MoveItErrorCodes& /*code*/) const override
  {
    const auto context = std::make_shared<Standing>("standing", req.group_name);
    context->setPlanningScene(scene);
    context->setMotionPlanRequest(req);
    return context;
  }
  bool canServiceRequest(const MotionPlanRequest& /*req*/) const override { return true; }
};

// Puts a way point in front, or throws.
class Adapter : public planning_request_adapter::PlanningRequestAdapter
{
public:
  explicit Adapter(bool throws = false) : throws_(throws) {}
  void initialize(const ros::NodeHandle& /*nh*/) override {}
  bool adaptAndPlan(const PlannerFn& planner, const PlanningSceneConstPtr& scene, const MotionPlanRequest& req,
                    MotionPlanResponse& res, std::vector<std::size_t>& added) const override
  {
    if (throws_)
      throw std::runtime_error("on purpose");
    const bool solved = planner(scene, req, res);
    res.trajectory_->addPrefixWayPoint(scene->getCurrentState(), 0.1);
    added.push_back(0);
    return solved;
  }

private:
  bool throws_;
};
}  // namespace

TEST(PlanningInterface, adaptersAreNestedAndTellWhatTheyAdded)
{
  const planning_interface::PlannerManagerPtr manager = std::make_shared<StandingManager>();
  planning_request_adapter::PlanningRequestAdapterChain chain;
  chain.addAdapter(std::make_shared<Adapter>());
  chain.addAdapter(std::make_shared<Adapter>(true));
  chain.addAdapter(std::make_shared<Adapter>());
  MotionPlanRequest request;
  request.group_name = "manipulator";
  MotionPlanResponse response;
  std::vector<std::size_t> added;
  ASSERT_TRUE(chain.adaptAndPlan(manager, readyScene(), request, response, added));
  EXPECT_EQ(response.trajectory_->getWayPointCount(), 3u);
  EXPECT_EQ(added, (std::vector<std::size_t>{ 0, 1 }));
  moveit_msgs::MotionPlanResponse message;
  response.getMessage(message);
  EXPECT_EQ(message.trajectory.joint_trajectory.points.size(), 3u);
  EXPECT_EQ(message.group_name, "manipulator");
}

TEST(PlanningInterface, terminateReachesContextsAndTimesAreMended)
{
  StandingManager manager;
  MotionPlanRequest request;
  request.num_planning_attempts = -3;
  moveit_msgs::MoveItErrorCodes code;
  const auto context = std::static_pointer_cast<Standing>(manager.getPlanningContext(readyScene(), request, code));
  EXPECT_EQ(context->getMotionPlanRequest().allowed_planning_time, 1.0);
  EXPECT_EQ(context->getMotionPlanRequest().num_planning_attempts, 1);
  manager.terminate();
  EXPECT_TRUE(context->terminated);
}

TEST(CollisionTools, costsAreCountedAndOverlapsTakenAway)
{
  collision_detection::CostSource one, inside;
  one.cost = inside.cost = 1.0;
  one.aabb_min = { 0.0, 0.0, 0.0 };
  one.aabb_max = { 1.0, 1.0, 1.0 };
  inside.aabb_min = { 0.5, 0.0, 0.0 };
  inside.aabb_max = { 0.9, 1.0, 1.0 };
  std::set<collision_detection::CostSource> costs{ one, inside };
  EXPECT_NEAR(collision_detection::getTotalCost(costs), 1.4, 1e-9);
  geometry_msgs::Point where;
  ASSERT_TRUE(collision_detection::getSensorPositioning(where, costs));
  EXPECT_NEAR(where.x, (0.5 + 0.4 * 0.7) / 1.4, 1e-9);
  collision_detection::removeOverlapping(costs, 0.9);
  EXPECT_EQ(costs.size(), 1u);
  EXPECT_FALSE(collision_detection::getSensorPositioning(where, {}));
  collision_detection::CollisionResult::ContactMap contacts;
  collision_detection::Contact contact;
  contact.body_name_1 = "a";
  contact.body_name_2 = "b";
  contact.pos = Eigen::Vector3d(1.0, 2.0, 3.0);
  contacts[{ "a", "b" }] = { contact, contact };
  visualization_msgs::MarkerArray markers;
  collision_detection::getCollisionMarkersFromContacts(markers, "world", contacts);
  ASSERT_EQ(markers.markers.size(), 2u);
  EXPECT_NE(markers.markers[0].id, markers.markers[1].id);
  EXPECT_EQ(markers.markers[0].pose.position.z, 3.0);
}

TEST(WorldDiff, tellsWhatChanged)
{
  const auto world = std::make_shared<collision_detection::World>();
  collision_detection::WorldDiff diff(world);
  const shapes::ShapeConstPtr box = std::make_shared<shapes::Box>(1.0, 1.0, 1.0);
  world->addToObject("a", Eigen::Isometry3d::Identity(), box, Eigen::Isometry3d::Identity());
  ASSERT_EQ(diff.size(), 1u);
  EXPECT_TRUE(diff.getChanges().at("a") & collision_detection::World::CREATE);
  world->removeObject("a");
  EXPECT_EQ(diff.getChanges().at("a"), collision_detection::World::DESTROY);
}

TEST(Trajectory, linkKeepsToItsSpeed)
{
  const moveit::core::RobotModelPtr model = makeArm();
  robot_trajectory::RobotTrajectory trajectory(model, "manipulator");
  moveit::core::RobotState state(model);
  for (int i = 0; i <= 10; ++i)
  {
    state.setVariablePosition("lift", 0.5);
    state.setVariablePosition("turn", 0.1 * i);
    trajectory.addSuffixWayPoint(state, 0.0);
  }
  ASSERT_TRUE(trajectory_processing::IterativeParabolicTimeParameterization().computeTimeStamps(trajectory));
  ASSERT_TRUE(trajectory_processing::limitMaxCartesianLinkSpeed(trajectory, 0.05, "hand"));
  for (std::size_t i = 1; i < trajectory.getWayPointCount(); ++i)
  {
    const Eigen::Vector3d way = trajectory.getWayPoint(i).getGlobalLinkTransform("hand").translation() -
                                trajectory.getWayPoint(i - 1).getGlobalLinkTransform("hand").translation();
    EXPECT_LE(way.norm() / trajectory.getWayPointDurationFromPrevious(i), 0.05 + 1e-9);
  }
  EXPECT_FALSE(trajectory_processing::limitMaxCartesianLinkSpeed(trajectory, 0.05, "no_link"));
  EXPECT_FALSE(trajectory_processing::limitMaxCartesianLinkSpeed(trajectory, 0.0, "hand"));
}

TEST(BackgroundProcessing, jobsAreDoneInOrder)
{
  std::vector<int> done;
  moveit::tools::BackgroundProcessing background;
  for (int i = 0; i < 20; ++i)
    background.addJob([&done, i]() { done.push_back(i); }, "job");
  background.addJob([]() { throw std::runtime_error("on purpose"); }, "bad");
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(20.0);
  while (background.getJobCount() && ros::WallTime::now() < end)
    ros::WallDuration(0.005).sleep();
  EXPECT_EQ(done.size(), 20u);
  EXPECT_TRUE(std::is_sorted(done.begin(), done.end()));
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::Time::init();
  return RUN_ALL_TESTS();
}
