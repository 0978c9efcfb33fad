// Torques of a rod that hangs on one joint.
#include <gtest/gtest.h>
#include <moveit/dynamics_solver/dynamics_solver.h>
#include <moveit/robot_model/robot_model.h>
// Headers of what does not exist here may be included; naming what they declare is the error.
#include <moveit/ompl_interface/ompl_interface.h>
#include <moveit/plan_execution/plan_execution.h>
#include <moveit/profiler/profiler.h>

namespace
{
const char* URDF = R"(<robot name="rod">
  <link name="base"/>
  <link name="rod"><inertial><origin xyz="0.5 0 0"/><mass value="2"/>
    <inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="tip"/>
  <joint name="turn" type="revolute"><parent link="base"/><child link="rod"/><axis xyz="0 1 0"/>
    <limit lower="-3" upper="3" effort="30" velocity="1"/></joint>
  <joint name="end" type="fixed"><parent link="rod"/><child link="tip"/><origin xyz="1 0 0"/></joint>
</robot>)";
const char* SRDF = R"(<robot name="rod"><group name="arm"><chain base_link="base" tip_link="tip"/></group>
  <group name="no_chain"><link name="rod"/><link name="base"/></group></robot>)";

dynamics_solver::DynamicsSolver makeSolver(const std::string& group)
{
  const auto urdf = std::make_shared<urdf::Model>();
  const auto srdf = std::make_shared<srdf::Model>();
  EXPECT_TRUE(urdf->initString(URDF) && srdf->initString(*urdf, SRDF));
  geometry_msgs::Vector3 gravity;
  gravity.z = -9.81;
  return { std::make_shared<moveit::core::RobotModel>(urdf, srdf), group, gravity };
}
}  // namespace

TEST(DynamicsSolver, holdsARodAndWhatHangsOnIt)
{
  const dynamics_solver::DynamicsSolver solver = makeSolver("arm");
  ASSERT_TRUE(solver.getGroup());
  EXPECT_EQ(solver.getMaxTorques(), std::vector<double>{ 30.0 });
  std::vector<double> torques(1);
  const std::vector<geometry_msgs::Wrench> none(2);
  ASSERT_TRUE(solver.getTorques({ 0.0 }, { 0.0 }, { 0.0 }, none, torques));
  EXPECT_NEAR(torques[0], -9.81, 1e-9);  // about +y, which would turn the rod's end down
  ASSERT_TRUE(solver.getTorques({ M_PI_2 }, { 0.0 }, { 2.0 }, none, torques));
  EXPECT_NEAR(torques[0], 2.0 * (0.1 + 2 * 0.25), 1e-9);  // hangs straight down: its inertia alone
  ASSERT_TRUE(solver.getPayloadTorques({ M_PI / 3 }, 1.5, torques));
  EXPECT_NEAR(torques[0], -9.81 * (1.0 + 1.5) * 0.5, 1e-9);
  double payload = 0;
  unsigned int joint = 7;
  ASSERT_TRUE(solver.getMaxPayload({ 0.0 }, payload, joint));
  EXPECT_NEAR(payload, (30 - 9.81) / 9.81, 1e-9);
  EXPECT_EQ(joint, 0u);
}

TEST(DynamicsSolver, refusesWhatItCannotAnswer)
{
  const dynamics_solver::DynamicsSolver solver = makeSolver("arm");
  std::vector<double> torques(1), two(2);
  EXPECT_FALSE(solver.getTorques({ 0.0, 0.0 }, { 0.0 }, { 0.0 }, std::vector<geometry_msgs::Wrench>(2), torques));
  EXPECT_FALSE(solver.getTorques({ 0.0 }, { 0.0 }, { 0.0 }, std::vector<geometry_msgs::Wrench>(1), torques));
  EXPECT_FALSE(solver.getPayloadTorques({ 0.0 }, 1.0, two));
  const dynamics_solver::DynamicsSolver without = makeSolver("no_chain");
  EXPECT_FALSE(without.getGroup());
  EXPECT_FALSE(without.getPayloadTorques({ 0.0 }, 1.0, torques));
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
