#include <rviz_visual_tools/imarker_simple.h>
#include <rviz_visual_tools/remote_reciever.h>
#include <rviz_visual_tools/rviz_visual_tools.h>

#include <thread>

#include <gtest/gtest.h>

namespace rvt = rviz_visual_tools;
using visualization_msgs::Marker;

namespace {

// Takes what the tools send on a topic of the test's own.
class VisualTools : public testing::Test {
 protected:
  VisualTools() : tools_("base", "/test_markers") {
    subscriber_ = nh_.subscribe<visualization_msgs::MarkerArray>(
        "/test_markers", 10, [this](const visualization_msgs::MarkerArrayConstPtr& got) { sent_.push_back(*got); });
    tools_.loadMarkerPub(true);
  }

  std::vector<Marker> taken() {
    EXPECT_TRUE(tools_.trigger());
    for (const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(20); sent_.empty() && ros::WallTime::now() < end;
         ros::WallDuration(0.01).sleep())
      ros::spinOnce();
    EXPECT_EQ(sent_.size(), 1u);
    const std::vector<Marker> markers = sent_.empty() ? std::vector<Marker>() : sent_.front().markers;
    sent_.clear();
    return markers;
  }

  ros::NodeHandle nh_;
  ros::Subscriber subscriber_;
  std::vector<visualization_msgs::MarkerArray> sent_;
  rvt::RvizVisualTools tools_;
};

TEST_F(VisualTools, MarkersAreSentTogether) {
  EXPECT_FALSE(tools_.trigger());
  tools_.deleteAllMarkers();
  tools_.publishText(Eigen::Isometry3d(Eigen::Translation3d(0, 0, 1.75)), "MoveGroupInterface Demo", rvt::WHITE, rvt::XLARGE);
  tools_.publishAxisLabeled(Eigen::Isometry3d::Identity(), "goal");
  const std::vector<Marker> markers = taken();
  ASSERT_EQ(markers.size(), 6u);
  EXPECT_EQ(markers[0].action, Marker::DELETEALL);
  EXPECT_EQ(markers[1].type, Marker::TEXT_VIEW_FACING);
  EXPECT_EQ(markers[1].text, "MoveGroupInterface Demo");
  EXPECT_EQ(markers[1].header.frame_id, "base");
  EXPECT_EQ(markers[1].pose.position.z, 1.75);
  EXPECT_EQ(markers[1].scale.z, 0.05);
  EXPECT_EQ(markers[2].ns, "goal");
  EXPECT_EQ(markers[5].text, "goal");
  EXPECT_NE(markers[5].id, markers[1].id);
}

// Kinetic's programs have no Isometry3d.
TEST_F(VisualTools, AnAffinePoseIsTakenAsWell) {
  Eigen::Affine3d pose = Eigen::Affine3d::Identity();
  pose.translation().z() = 4.0;
  EXPECT_TRUE(tools_.publishText(pose, "Welcome", rvt::WHITE, rvt::XXXXLARGE));
  EXPECT_TRUE(tools_.publishSphere(pose, rvt::RED));
  EXPECT_TRUE(tools_.publishCuboid(pose, 0.1, 0.2, 0.3));
  EXPECT_TRUE(tools_.publishAxisLabeled(pose, "here"));
  const Eigen::Affine3d turned = pose * Eigen::AngleAxisd(1.0, Eigen::Vector3d::UnitX());
  EXPECT_TRUE(tools_.publishArrow(turned));
  const std::vector<Marker> markers = taken();
  ASSERT_EQ(markers.size(), 8u);
  for (const Marker& marker : {markers[0], markers[1], markers[2], markers.back()}) EXPECT_EQ(marker.pose.position.z, 4.0);
  EXPECT_EQ(markers[0].text, "Welcome");
  EXPECT_EQ(markers[2].scale.z, 0.3);
  EXPECT_TRUE(rvt::RvizVisualTools::convertPose(markers.back().pose).linear().isApprox(turned.linear()));
}

TEST_F(VisualTools, AxesPointWhereTheyShould) {
  tools_.publishAxis(Eigen::Isometry3d::Identity(), 0.2, 0.01);
  tools_.publishZArrow(Eigen::Isometry3d::Identity());
  const std::vector<Marker> markers = taken();
  ASSERT_EQ(markers.size(), 4u);
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Isometry3d pose = rvt::RvizVisualTools::convertPose(markers[axis].pose);
    EXPECT_NEAR(std::abs((pose.linear() * Eigen::Vector3d::UnitZ())[axis]), 1, 1e-9);  // a cylinder lies along its z axis
    EXPECT_NEAR(pose.translation()[axis], 0.1, 1e-12);
    EXPECT_EQ(markers[axis].scale.z, 0.2);
  }
  EXPECT_GT(markers[0].color.r, markers[0].color.g);
  const Eigen::Isometry3d arrow = rvt::RvizVisualTools::convertPose(markers[3].pose);
  EXPECT_NEAR((arrow.linear() * Eigen::Vector3d::UnitX()).z(), 1, 1e-9);
  EXPECT_NEAR(markers[3].scale.x, 0.1, 1e-12);
}

TEST_F(VisualTools, PathsAreCylindersFromPointToPoint) {
  const EigenSTL::vector_Vector3d path = {{0, 0, 0}, {0, 0, 1}, {0, 2, 1}};
  EXPECT_TRUE(tools_.publishPath(path, rvt::LIME_GREEN, rvt::SMALL));
  EXPECT_FALSE(tools_.publishPath(EigenSTL::vector_Vector3d(1), rvt::RED, 0.01));
  const std::vector<Marker> markers = taken();
  ASSERT_EQ(markers.size(), 2u);
  EXPECT_EQ(markers[0].type, Marker::CYLINDER);
  EXPECT_EQ(markers[0].scale.z, 1);
  EXPECT_EQ(markers[1].scale.z, 2);
  EXPECT_EQ(markers[0].scale.x, 0.0075);
  const Eigen::Isometry3d second = rvt::RvizVisualTools::convertPose(markers[1].pose);
  EXPECT_TRUE(Eigen::Vector3d(second.translation()).isApprox(Eigen::Vector3d(0, 1, 1)));
  EXPECT_NEAR(std::abs((second.linear() * Eigen::Vector3d::UnitZ()).y()), 1, 1e-9);
}

TEST_F(VisualTools, WireFramesHaveTwelveEdges) {
  tools_.publishWireframeCuboid(Eigen::Isometry3d::Identity(), 1, 2, 3);
  const std::vector<Marker> markers = taken();
  ASSERT_EQ(markers.size(), 1u);
  ASSERT_EQ(markers[0].points.size(), 24u);
  double length = 0;
  for (std::size_t i = 0; i < 24; i += 2)
    length += (rvt::RvizVisualTools::convertPoint(markers[0].points[i]) -
               rvt::RvizVisualTools::convertPoint(markers[0].points[i + 1]))
                  .norm();
  EXPECT_NEAR(length, 4 * (1 + 2 + 3), 1e-9);
}

TEST_F(VisualTools, StampedArrowsStayInTheirFrame) {
  geometry_msgs::PoseStamped pose;
  pose.header.frame_id = "camera";
  tools_.publishArrow(pose);
  tools_.publishArrow(geometry_msgs::Pose());
  tools_.publishCuboid(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 2));
  const std::vector<Marker> markers = taken();
  ASSERT_EQ(markers.size(), 3u);
  EXPECT_EQ(markers[0].header.frame_id, "camera");
  EXPECT_EQ(markers[0].pose.orientation.w, 1);
  EXPECT_EQ(markers[1].header.frame_id, "base");
  EXPECT_NE(markers[0].id, markers[1].id);
  EXPECT_EQ(markers[2].scale.y, rvt::SMALL_SCALE);
  EXPECT_EQ(markers[2].pose.position.z, 1);
}

TEST_F(VisualTools, ColorsAndConversions) {
  EXPECT_EQ(tools_.getColorScale(0).g, tools_.getColor(rvt::RED).g);
  EXPECT_EQ(tools_.getColorScale(0.5).r, 1);
  EXPECT_NEAR(tools_.getColorScale(1).r, tools_.getColor(rvt::GREEN).r, 1e-6);
  tools_.setAlpha(0.5);
  EXPECT_EQ(tools_.getColor(rvt::ORANGE).a, 0.5f);
  EXPECT_EQ(tools_.getColor(rvt::TRANSLUCENT_LIGHT).a, 0.1f);
  EXPECT_EQ(tools_.scaleToString(tools_.intToRvizScale(6)), "MEDIUM");
  EXPECT_THROW(tools_.intToRvizScale(12), std::runtime_error);
  const Eigen::Isometry3d pose = tools_.convertFromXYZRPY({1, 2, 3, 0.1, 0.2, 0.3});
  std::vector<double> back;
  tools_.convertToXYZRPY(pose, back);
  EXPECT_NEAR(back[0], 1, 1e-12);
  EXPECT_NEAR(back[5], 0.3, 1e-12);
  EXPECT_THROW(tools_.convertFromXYZRPY({1, 2}), std::invalid_argument);
}

TEST_F(VisualTools, PromptsWaitForTheButton) {
  rvt::RemoteReciever panel;
  std::atomic<bool> waited{false};
  tools_.getRemoteControl()->setDisplayWaitingState([&](bool waiting) { waited = waited || waiting; });
  std::thread presser([&] {
    while (!tools_.getRemoteControl()->isWaiting() && ros::ok()) ros::WallDuration(0.01).sleep();
    while (tools_.getRemoteControl()->isWaiting() && ros::ok()) {  // again, as the first may come before the connection
      panel.publishNext();
      ros::WallDuration(0.05).sleep();
    }
  });
  tools_.prompt("Press 'next' to start the demo");
  presser.join();
  EXPECT_TRUE(waited);
  tools_.getRemoteControl()->setAutonomous();
  tools_.prompt("not asked any more");
  EXPECT_FALSE(tools_.getRemoteControl()->isWaiting());
  sensor_msgs::Joy empty;
  tools_.getRemoteControl()->rvizDashboardCallback(boost::make_shared<sensor_msgs::Joy>(empty));
  EXPECT_TRUE(tools_.getRemoteControl()->getAutonomous());
}

TEST(InteractiveMarker, IsWhereItWasPut) {
  rvt::IMarkerSimple marker("six", 0.3, geometry_msgs::Pose(), "base");
  marker.setPose(Eigen::Isometry3d(Eigen::Translation3d(1, 2, 3)));
  EXPECT_EQ(marker.getPose().position.y, 2);
  bool called = false;
  marker.setIMarkerCallback([&](const visualization_msgs::InteractiveMarkerFeedbackConstPtr&) { called = true; });
  visualization_msgs::InteractiveMarkerFeedback dragged;
  dragged.event_type = dragged.POSE_UPDATE;
  dragged.pose.position.x = 7;
  marker.iMarkerCallback(boost::make_shared<visualization_msgs::InteractiveMarkerFeedback>(dragged));
  EXPECT_TRUE(called);
  EXPECT_EQ(marker.getPose().position.x, 7);
}

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "test_visual_tools");
  return RUN_ALL_TESTS();
}
