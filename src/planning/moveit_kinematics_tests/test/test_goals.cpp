// A C++ program plans with the OMPL plugin: the vendor's kinematics plugin of the group says how its pose goals are reached.
#include <gtest/gtest.h>
#include <moveit/kinematic_constraints/utils.h>
#include <moveit/planning_pipeline/planning_pipeline.h>
#include <moveit/planning_scene/planning_scene.h>
#include <moveit/robot_model_loader/robot_model_loader.h>
#include <ros/ros.h>

namespace
{
constexpr double ELBOW = 0.9;

// The elbow at the end of a plan to where the tool is with an elbow of +0.9 rad, starting beside it.
double elbowAtTheEnd(const std::string& group)
{
  const robot_model_loader::RobotModelLoader loader("robot_description");
  const moveit::core::RobotModelPtr model = loader.getModel();
  const auto scene = std::make_shared<planning_scene::PlanningScene>(model);
  moveit::core::RobotState& state = scene->getCurrentStateNonConst();
  const moveit::core::JointModelGroup* joints = model->getJointModelGroup(group);
  state.setToDefaultValues();
  state.setJointGroupPositions(joints, std::vector<double>{ 0.4, ELBOW, -0.1, 0.3 });
  state.update();
  geometry_msgs::PoseStamped target;
  target.header.frame_id = "base";
  const Eigen::Isometry3d tool = state.getGlobalLinkTransform("tool");
  const Eigen::Quaterniond turn(tool.linear());
  target.pose.position.x = tool.translation().x();
  target.pose.position.y = tool.translation().y();
  target.pose.position.z = tool.translation().z();
  target.pose.orientation.z = turn.z();
  target.pose.orientation.w = turn.w();
  state.setJointGroupPositions(joints, std::vector<double>{ 0.2, ELBOW + 0.1, -0.1, 0.3 });
  state.update();
  planning_interface::MotionPlanRequest request;
  request.group_name = group;
  request.allowed_planning_time = 5.0;
  request.goal_constraints = { kinematic_constraints::constructGoalConstraints("tool", target, 1e-4, 1e-3) };
  planning_pipeline::PlanningPipeline pipeline(model, ros::NodeHandle("/move_group"));
  planning_interface::MotionPlanResponse response;
  EXPECT_TRUE(pipeline.generatePlan(scene, request, response));
  return response.trajectory_ ? response.trajectory_->getLastWayPoint().getVariablePosition("elbow") : 0.0;
}
}  // namespace

TEST(PoseGoals, areReachedAsThePluginSays)
{
  EXPECT_NEAR(elbowAtTheEnd("one"), -ELBOW, 0.01);  // its parameter wants the elbow on the right
}

TEST(PoseGoals, areTheLibrarysWhereThePluginIsOfAnotherRobot) { EXPECT_NEAR(std::abs(elbowAtTheEnd("three")), ELBOW, 0.01); }

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "goals_test");
  return RUN_ALL_TESTS();
}
