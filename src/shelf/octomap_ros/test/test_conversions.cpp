#include <octomap_ros/conversions.h>

#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <sensor_msgs/point_cloud2_iterator.h>

using namespace octomap;

TEST(Clouds, GoThereAndBackWithoutWhatIsNoPoint)
{
  const float nan = std::numeric_limits<float>::quiet_NaN();
  sensor_msgs::PointCloud2 cloud;
  cloud.header.frame_id = "map";
  pointsOctomapToPointCloud2({ { 1, 2, 3 }, { nan, 0, 0 }, { 4, 5, INFINITY }, { -6, 7.5f, 8 } }, cloud);
  EXPECT_EQ(cloud.header.frame_id, "map");
  EXPECT_EQ(cloud.width, 4u);
  EXPECT_EQ(cloud.height, 1u);
  ASSERT_EQ(cloud.fields.size(), 3u);
  Pointcloud points;
  points.push_back(9, 9, 9);
  pointCloud2ToOctomap(cloud, points);
  ASSERT_EQ(points.size(), 3u);
  EXPECT_EQ(points[0], point3d(9, 9, 9));
  EXPECT_EQ(points[1], point3d(1, 2, 3));
  EXPECT_EQ(points[2], point3d(-6, 7.5f, 8));
}

TEST(Clouds, WithoutCoordinatesAreRefused)
{
  sensor_msgs::PointCloud2 cloud;
  sensor_msgs::PointCloud2Modifier(cloud).setPointCloud2Fields(1, "intensity", 1, sensor_msgs::PointField::FLOAT32);
  Pointcloud points;
  EXPECT_THROW(pointCloud2ToOctomap(cloud, points), std::runtime_error);
}

TEST(Poses, GoThereAndBack)
{
  const tf::Pose X(tf::Quaternion(tf::Vector3(1, 2, 3).normalized(), 0.7), tf::Vector3(0.5, -0.25, 2));
  const pose6d there = poseTfToOctomap(X);
  EXPECT_NEAR(there.rot().u(), std::cos(0.35), 1e-6);  // the real part
  const tf::Vector3 p(0.3, 0.4, -0.5), moved = X * p;
  const point3d same = there.transform(pointTfToOctomap(p));
  EXPECT_NEAR(same.x(), moved.x(), 1e-6);
  EXPECT_NEAR(same.y(), moved.y(), 1e-6);
  EXPECT_NEAR(same.z(), moved.z(), 1e-6);
  const tf::Pose back = poseOctomapToTf(there);
  EXPECT_NEAR(back.getRotation().angleShortestPath(X.getRotation()), 0, 1e-3);
  EXPECT_NEAR((back.getOrigin() - X.getOrigin()).length(), 0, 1e-6);
}

TEST(Points, OfMessages)
{
  const geometry_msgs::Point p = pointOctomapToMsg({ 1, -2, 0.5f });
  EXPECT_EQ(p.y, -2);
  EXPECT_EQ(pointMsgToOctomap(p), point3d(1, -2, 0.5f));
}
