#include <moveit_visual_tools/moveit_visual_tools.h>

#include <gtest/gtest.h>

#include <fstream>

namespace rvt = rviz_visual_tools;
using moveit_msgs::CollisionObject;

namespace {

// Hears what the tools send on one topic.
template <class Message>
struct Listener {
  explicit Listener(const std::string& topic) {
    subscriber = ros::NodeHandle().subscribe<Message>(
        topic, 10, [this](const boost::shared_ptr<const Message>& message) { heard.push_back(*message); });
  }

  Message next() {
    for (const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(20); heard.empty() && ros::WallTime::now() < end;
         ros::WallDuration(0.01).sleep())
      ros::spinOnce();
    EXPECT_FALSE(heard.empty());
    const Message message = heard.empty() ? Message() : heard.front();
    if (!heard.empty()) heard.erase(heard.begin());
    return message;
  }

  ros::Subscriber subscriber;
  std::vector<Message> heard;
};

class Tools : public testing::Test {
 protected:
  Tools() : tools_("world", "/test_markers") { group_ = tools_.getRobotModel()->getJointModelGroup("manipulator"); }

  moveit_msgs::RobotTrajectory trajectory() const {
    moveit_msgs::RobotTrajectory result;
    result.joint_trajectory.joint_names = group_->getVariableNames();
    result.joint_trajectory.points.resize(3);
    for (int i = 0; i < 3; ++i) {
      result.joint_trajectory.points[i].positions = {0.5 * i, -0.6, 1.6, 0, 1.0, 0};
      result.joint_trajectory.points[i].time_from_start = ros::Duration(0.1 * i);
    }
    return result;
  }

  moveit_visual_tools::MoveItVisualTools tools_;
  const moveit::core::JointModelGroup* group_;
};

TEST_F(Tools, DrawTheWayOfTheHand) {
  Listener<visualization_msgs::MarkerArray> markers("/test_markers");
  EXPECT_TRUE(tools_.publishTrajectoryLine(trajectory(), group_));
  EXPECT_TRUE(tools_.trigger());
  const auto drawn = markers.next().markers;
  ASSERT_EQ(drawn.size(), 5u);  // three spheres, two cylinders
  moveit::core::RobotState state(tools_.getRobotModel());
  state.setToDefaultValues();
  state.setJointGroupPositions(group_, std::vector<double>{1.0, -0.6, 1.6, 0, 1.0, 0});
  state.update();
  const Eigen::Vector3d last = state.getGlobalLinkTransform("hand").translation();
  EXPECT_NEAR(drawn[2].pose.position.x, last.x(), 1e-9);
  EXPECT_NEAR(drawn[2].pose.position.y, last.y(), 1e-9);
  EXPECT_FALSE(tools_.publishTrajectoryLine(trajectory(), static_cast<const moveit::core::JointModelGroup*>(nullptr)));
}

TEST_F(Tools, ShowTrajectoriesAndStates) {
  Listener<moveit_msgs::DisplayTrajectory> paths("/test_path");
  Listener<moveit_msgs::DisplayRobotState> states("/test_state");
  tools_.loadTrajectoryPub("/test_path");
  tools_.loadRobotStatePub("/test_state");
  EXPECT_TRUE(tools_.publishTrajectoryPath(trajectory(), *tools_.getSharedRobotState()));
  const moveit_msgs::DisplayTrajectory path = paths.next();
  EXPECT_EQ(path.model_id, "arm");
  ASSERT_EQ(path.trajectory.size(), 1u);
  EXPECT_EQ(path.trajectory[0].joint_trajectory.points.size(), 3u);
  EXPECT_FALSE(path.trajectory_start.joint_state.name.empty());
  EXPECT_FALSE(tools_.publishTrajectoryPath(moveit_msgs::RobotTrajectory(), *tools_.getSharedRobotState()));
  EXPECT_TRUE(tools_.publishRobotState({0.3, 0, 0, 0, 0, 0}, group_, rvt::GREEN));
  const moveit_msgs::DisplayRobotState state = states.next();
  EXPECT_FALSE(state.highlight_links.empty());
  const auto& names = state.state.joint_state.name;
  const auto joint = std::find(names.begin(), names.end(), "joint_1");
  ASSERT_NE(joint, names.end());
  EXPECT_EQ(state.state.joint_state.position.at(joint - names.begin()), 0.3);
  EXPECT_TRUE(tools_.hideRobot());
  EXPECT_TRUE(states.next().hide);
  tools_.showJointLimits(tools_.getSharedRobotState());
}

TEST_F(Tools, SendObjectsToTheScene) {
  Listener<moveit_msgs::PlanningScene> scenes("/planning_scene");
  EXPECT_TRUE(tools_.publishCollisionWall(1, 2, 0.5, 0, 2.0, 1.5, "wall", rvt::RED));
  moveit_msgs::PlanningScene scene = scenes.next();
  EXPECT_TRUE(scene.is_diff);
  ASSERT_EQ(scene.world.collision_objects.size(), 1u);
  EXPECT_EQ(scene.world.collision_objects[0].id, "wall");
  EXPECT_EQ(scene.world.collision_objects[0].header.frame_id, "world");
  EXPECT_EQ(scene.world.collision_objects[0].primitives.at(0).dimensions.at(1), 2.0);
  EXPECT_EQ(scene.world.collision_objects[0].primitive_poses.at(0).position.z, 0.5 + 0.75);
  EXPECT_EQ(scene.object_colors.at(0).id, "wall");
  tools_.setManualSceneUpdating();
  tools_.publishCollisionCuboid(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 2, 0), "plate");
  tools_.publishCollisionCylinder(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0, 0, 2), "post", 0.1);
  tools_.attachCO("tool", "hand");
  tools_.cleanupCO("wall");
  EXPECT_TRUE(tools_.triggerPlanningSceneUpdate());
  scene = scenes.next();
  ASSERT_EQ(scene.world.collision_objects.size(), 3u);
  EXPECT_EQ(scene.world.collision_objects[0].primitives.at(0).dimensions.at(2), rvt::SMALL_SCALE);
  EXPECT_EQ(scene.world.collision_objects[1].primitives.at(0).dimensions.at(0), 2);
  EXPECT_EQ(scene.world.collision_objects[1].primitive_poses.at(0).position.z, 1);
  EXPECT_EQ(scene.world.collision_objects[2].operation, CollisionObject::REMOVE);
  EXPECT_EQ(scene.robot_state.attached_collision_objects.at(0).link_name, "hand");
}

TEST_F(Tools, SendObjectsToTheMonitorThatIsThere) {
  const auto monitor = std::make_shared<planning_scene_monitor::PlanningSceneMonitor>("robot_description");
  moveit_visual_tools::MoveItVisualTools tools("world", "/test_markers", monitor);
  EXPECT_EQ(tools.getRobotModel(), monitor->getRobotModel());
  EXPECT_FALSE(tools.loadPlanningSceneMonitor());
  EXPECT_TRUE(tools.publishCollisionBlock(tools.getIdentityPose(), "block", 0.2));
  const planning_scene_monitor::LockedPlanningSceneRO scene(monitor);
  std::vector<CollisionObject> objects;
  scene->getCollisionObjectMsgs(objects);
  ASSERT_EQ(objects.size(), 1u);
  EXPECT_EQ(objects[0].id, "block");
}

// The format is that of upstream's PlanningScene::saveGeometryToStream().
TEST_F(Tools, LoadTextFilesOfScenes) {
  const std::string path = testing::TempDir() + "kitchen.scene";
  std::ofstream(path) << "kitchen\n* crate\n0.5 0 0.25\n0 0 0 1\n1\nbox\n0.1 0.2 0.5\n0 0 0\n0 0 0 1\n0 1 0 1\n0\n.\n";
  const auto monitor = std::make_shared<planning_scene_monitor::PlanningSceneMonitor>("robot_description");
  tools_.setPlanningSceneMonitor(monitor);
  ASSERT_TRUE(tools_.loadCollisionSceneFromFile(path, Eigen::Isometry3d(Eigen::Translation3d(0, 1.0, 0))));
  const planning_scene_monitor::LockedPlanningSceneRO scene(monitor);
  ASSERT_TRUE(scene->getWorld()->hasObject("crate"));
  EXPECT_TRUE(scene->getFrameTransform("crate").translation().isApprox(Eigen::Vector3d(0.5, 1.0, 0.25)));
  EXPECT_EQ(scene->getObjectColor("crate").g, 1.0f);
  EXPECT_FALSE(tools_.loadCollisionSceneFromFile(path + ".absent"));
}

TEST_F(Tools, ShowEndEffectors) {
  Listener<visualization_msgs::MarkerArray> markers("/test_markers");
  const moveit::core::JointModelGroup* hand = tools_.getRobotModel()->getEndEffector("gripper");
  ASSERT_TRUE(hand);
  const Eigen::Isometry3d pose(Eigen::Translation3d(1, 0, 0.5));
  EXPECT_TRUE(tools_.publishEEMarkers(pose, hand, rvt::ORANGE));
  const auto shown = markers.next().markers;
  ASSERT_FALSE(shown.empty());
  EXPECT_EQ(shown[0].ns, "end_effector");
  EXPECT_NEAR(shown[0].pose.position.x, 1, 0.2);
  EXPECT_NEAR(shown[0].color.g, 0.5, 1e-6);
  EXPECT_FALSE(tools_.publishEEMarkers(pose, hand, {0.01, 0.01, 0.01}));
}

TEST_F(Tools, MarkContacts) {
  Listener<visualization_msgs::MarkerArray> markers("/test_markers");
  Listener<moveit_msgs::DisplayRobotState> states("/test_state");
  tools_.loadRobotStatePub("/test_state");
  planning_scene::PlanningScene scene(tools_.getRobotModel());
  moveit::core::RobotState& state = scene.getCurrentStateNonConst();
  state.setToDefaultValues(group_, "home");
  state.update();
  EXPECT_FALSE(tools_.checkAndPublishCollision(state, &scene));
  EXPECT_TRUE(states.next().highlight_links.size() > 0);
  CollisionObject box;
  box.header.frame_id = "world";
  box.id = "box";
  box.primitives.resize(1);
  box.primitives[0].type = shape_msgs::SolidPrimitive::BOX;
  box.primitives[0].dimensions = {0.1, 0.1, 0.1};
  box.primitive_poses.push_back(tools_.convertPose(state.getGlobalLinkTransform("hand")));
  ASSERT_TRUE(scene.processCollisionObjectMsg(box));
  EXPECT_TRUE(tools_.checkAndPublishCollision(state, &scene, rvt::RED, rvt::PURPLE));
  const auto points = markers.next().markers;
  ASSERT_FALSE(points.empty());
  EXPECT_EQ(points[0].ns, "Collision");
  const Eigen::Vector3d p_WH = state.getGlobalLinkTransform("hand").translation();
  EXPECT_LT((tools_.convertPoint(points[0].pose.position) - p_WH).norm(), 0.2);
  const auto links = states.next().highlight_links;
  EXPECT_TRUE(std::any_of(links.begin(), links.end(), [](const auto& link) { return link.id == "hand"; }));
}

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "test_moveit_visual_tools");
  const ros::NodeHandle nh;
  return RUN_ALL_TESTS();
}
