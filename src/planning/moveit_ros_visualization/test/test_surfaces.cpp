// Tops of objects that something can stand on, and the places on them.
#include <gtest/gtest.h>

#include "../displays/support_surfaces.hpp"

namespace moveit_rviz_plugin {
namespace {
Eigen::Isometry3d at(double x, double y, double z, double tilt = 0.0) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Eigen::Vector3d(x, y, z);
  pose.linear() = Eigen::AngleAxisd(tilt, Eigen::Vector3d::UnitX()).toRotationMatrix();
  return pose;
}

// A table with a block, a ball, a tilted board and a lying can.
collision_detection::World world() {
  collision_detection::World world;
  world.addToObject("table", at(0.5, 0.0, 0.2), std::make_shared<shapes::Box>(0.4, 0.8, 0.04), Eigen::Isometry3d::Identity());
  world.addToObject("block", at(0.45, 0.1, 0.25), std::make_shared<shapes::Box>(0.04, 0.04, 0.06),
                    Eigen::Isometry3d::Identity());
  world.addToObject("ball", at(0.5, 0.3, 0.25), std::make_shared<shapes::Sphere>(0.03), Eigen::Isometry3d::Identity());
  world.addToObject("board", at(2.0, 0.0, 0.5, 0.5), std::make_shared<shapes::Box>(1.0, 1.0, 0.02),
                    Eigen::Isometry3d::Identity());
  world.addToObject("can", at(3.0, 0.0, 0.1, M_PI_2), std::make_shared<shapes::Cylinder>(0.1, 0.3),
                    Eigen::Isometry3d::Identity());
  return world;
}

TEST(Surfaces, LevelTopsAreFoundTheLargestFirst) {
  const std::vector<Surface> found = surfacesOf(world());
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].id, "table");
  EXPECT_EQ(found[1].id, "block");
  EXPECT_NEAR(found[0].height, 0.22, 1e-9);
  EXPECT_NEAR(found[0].area(), 0.32, 1e-9);
  EXPECT_TRUE(found[0].centre().isApprox(Eigen::Vector2d(0.5, 0.0), 1e-9));
}

TEST(Surfaces, AnUprightCylinderHasARoundTop) {
  collision_detection::World can;
  can.addToObject("can", at(0.0, 0.0, 0.1), std::make_shared<shapes::Cylinder>(0.1, 0.3), Eigen::Isometry3d::Identity());
  const std::vector<Surface> found = surfacesOf(can);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].area(), M_PI * 0.01, 3e-3);
}

TEST(Surfaces, WhatAnObjectStandsOnIsFound) {
  const collision_detection::World all = world();
  const std::vector<Surface> found = surfacesOf(all);
  EXPECT_EQ(surfaceBelow(found, *all.getObject("block")), "table");
  EXPECT_EQ(surfaceBelow(found, *all.getObject("ball")), "table");
  EXPECT_EQ(surfaceBelow(found, *all.getObject("table")), "");
  EXPECT_EQ(surfaceBelow(found, *all.getObject("can")), "");
}

TEST(Surfaces, PlacesKeepOffTheEdgeAndBeginWithTheNearest) {
  const Surface table = surfacesOf(world())[0];
  Bounds block;  // its frame is at its bottom, beside its middle
  block.low = Eigen::Vector3d(0.0, -0.05, 0.0);
  block.high = Eigen::Vector3d(0.1, 0.05, 0.2);
  const Eigen::Vector3d from(0.4, 0.4, 0.6);
  const std::vector<Eigen::Vector3d> places = placesOn(table, block, from);
  ASSERT_GT(places.size(), 10u);
  double before = 0.0;
  for (const Eigen::Vector3d& place : places) {
    EXPECT_NEAR(place.z(), 0.22, 1e-9);
    EXPECT_GE(table.inside(Eigen::Vector2d(place.x() + 0.05, place.y())), 0.05 - 1e-6);
    EXPECT_GE((place - from).norm(), before - 1e-9);
    before = (place - from).norm();
  }
}

TEST(Surfaces, WhatIsLargerThanTheSurfaceGoesOnItsMiddle) {
  const Surface block = surfacesOf(world())[1];
  Bounds plate;
  plate.low = Eigen::Vector3d(-0.2, -0.2, -0.01);
  plate.high = -plate.low;
  const std::vector<Eigen::Vector3d> places = placesOn(block, plate, Eigen::Vector3d::Zero());
  ASSERT_EQ(places.size(), 1u);
  EXPECT_TRUE(places[0].isApprox(Eigen::Vector3d(0.45, 0.1, 0.29), 1e-9));
}

TEST(Surfaces, ADetectedTableBecomesABoardBelowItsOutline) {
  object_recognition_msgs::Table table;
  EXPECT_EQ(boardOf(table), nullptr);
  for (const auto& corner : {std::pair{0.0, 0.0}, {1.0, 0.5}, {1.0, 0.0}, {0.0, 0.5}, {0.5, 0.2}}) {
    geometry_msgs::Point point;
    point.x = corner.first;
    point.y = corner.second;
    table.convex_hull.push_back(point);
  }
  collision_detection::World all;
  all.addToObject("table_0", at(0.0, 0.0, 1.0), boardOf(table), Eigen::Isometry3d::Identity());
  const std::vector<Surface> found = surfacesOf(all);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].height, 1.0, 1e-9);
  EXPECT_NEAR(found[0].area(), 0.5, 1e-9);
  EXPECT_EQ(found[0].outline.size(), 4u);
}
}  // namespace
}  // namespace moveit_rviz_plugin

int main(int count, char** arguments) {
  testing::InitGoogleTest(&count, arguments);
  return RUN_ALL_TESTS();
}
