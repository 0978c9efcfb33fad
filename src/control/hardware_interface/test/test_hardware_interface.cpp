// Handles, interfaces, claims, and robots made of others, in C++.
#include <gtest/gtest.h>

#include <type_traits>

#include <hardware_interface/actuator_command_interface.h>
#include <hardware_interface/force_torque_sensor_interface.h>
#include <hardware_interface/imu_sensor_interface.h>
#include <hardware_interface/joint_command_interface.h>
#include <hardware_interface/joint_mode_interface.h>
#include <hardware_interface/joint_state_interface.h>
#include <hardware_interface/position_velocity_torque_gains_command_interface.h>
#include <hardware_interface/posvelacc_command_interface.h>
#include <hardware_interface/robot_hw.h>

using namespace hardware_interface;

namespace
{

struct Numbers
{
  double position = 1.0, velocity = 2.0, effort = 3.0, absolute = 4.0, torque = 5.0, command = 0.0;

  JointStateHandle state(const std::string& name) { return JointStateHandle(name, &position, &velocity, &effort); }
  JointHandle joint(const std::string& name) { return JointHandle(state(name), &command); }
};

template <class Call>
std::string message_of(Call call)
{
  try
  {
    call();
  }
  catch (const std::exception& error)
  {
    return error.what();
  }
  return "";
}

ControllerInfo info(const std::string& name, const std::vector<InterfaceResources>& claimed)
{
  return ControllerInfo(name, "type", claimed);
}

}  // namespace

TEST(Handles, ShowAndCommand)
{
  Numbers numbers;
  JointHandle handle = numbers.joint("j");
  handle.setCommand(7.0);
  numbers.position = 8.0;
  EXPECT_EQ("j", handle.getName());
  EXPECT_EQ(8.0, handle.getPosition());
  EXPECT_EQ(2.0, handle.getVelocity());
  EXPECT_EQ(3.0, handle.getEffort());
  EXPECT_EQ(7.0, numbers.command);
  EXPECT_EQ(&numbers.command, handle.getCommandPtr());
}

TEST(Handles, OptionalSensorsAreTold)
{
  Numbers n;
  const JointStateHandle none = n.state("j");
  EXPECT_FALSE(none.hasAbsolutePosition());
  EXPECT_THROW(none.getAbsolutePosition(), std::runtime_error);
  EXPECT_THROW(none.getTorqueSensor(), std::runtime_error);
  const JointStateHandle both("j", &n.position, &n.velocity, &n.effort, &n.absolute, &n.torque);
  EXPECT_EQ(4.0, both.getAbsolutePosition());
  EXPECT_EQ(5.0, both.getTorqueSensor());
  const JointStateHandle torque("j", &n.position, &n.velocity, &n.effort, &n.torque, true);
  EXPECT_FALSE(torque.hasAbsolutePosition());
  EXPECT_TRUE(torque.hasTorqueSensor());
}

TEST(Handles, NullPointersAreNamed)
{
  Numbers n;
  EXPECT_EQ("Cannot create handle 'elbow'. Velocity data pointer is null.",
            message_of([&] { JointStateHandle("elbow", &n.position, nullptr, &n.effort); }));
  EXPECT_EQ("Cannot create handle 'elbow'. Command data pointer is null.",
            message_of([&] { JointHandle(n.state("elbow"), nullptr); }));
  EXPECT_THROW(JointModeHandle("m", nullptr), HardwareInterfaceException);
  EXPECT_THROW(PosVelAccJointHandle(n.state("j"), &n.command, &n.command, nullptr), HardwareInterfaceException);
}

TEST(Handles, AnEmptyOneThrowsInsteadOfCrashing)
{
  JointHandle handle;
  EXPECT_THROW(handle.setCommand(1.0), HardwareInterfaceException);
  EXPECT_THROW(handle.getPosition(), HardwareInterfaceException);
  EXPECT_THROW(JointModeHandle().getMode(), HardwareInterfaceException);
}

TEST(Handles, OfSeveralCommands)
{
  Numbers n;
  double p, v, e, kp, kd;
  PositionVelocityTorqueGainsJointHandle handle(n.state("j"), &p, &v, &e, &kp, &kd);
  handle.setCommand(1.0, 2.0, 3.0, 4.0, 5.0);
  EXPECT_EQ(15.0, p + v + e + kp + kd);
  EXPECT_EQ(4.0, handle.getCommandKp());
}

TEST(Handles, SensorsMayLackMeasurements)
{
  EXPECT_EQ(nullptr, ImuSensorHandle().getOrientation());
  ImuSensorHandle::Data data;
  double acceleration[3] = { 1.0, 2.0, 3.0 };
  data.name = "imu";
  data.linear_acceleration = acceleration;
  EXPECT_EQ(acceleration, ImuSensorHandle(data).getLinearAcceleration());
  EXPECT_EQ(nullptr, ForceTorqueSensorHandle("wrist", "link", acceleration, nullptr).getTorque());
}

TEST(Interfaces, CommandingOnesClaim)
{
  Numbers n;
  EffortJointInterface interface;
  interface.registerHandle(n.joint("b"));
  interface.registerHandle(n.joint("a"));
  EXPECT_EQ((std::vector<std::string>{ "a", "b" }), interface.getNames());
  interface.getHandle("a");
  EXPECT_EQ(std::set<std::string>{ "a" }, interface.getClaims());
  interface.clearClaims();
  EXPECT_TRUE(interface.getClaims().empty());
}

TEST(Interfaces, OthersDoNot)
{
  Numbers n;
  JointStateInterface states;
  states.registerHandle(n.state("a"));
  states.getHandle("a");
  EXPECT_TRUE(states.getClaims().empty());
  EffortActuatorInterface actuators;
  actuators.registerHandle(ActuatorHandle(ActuatorStateHandle("m", &n.position, &n.velocity, &n.effort), &n.command));
  actuators.getHandle("m");
  EXPECT_TRUE(actuators.getClaims().empty());
}

TEST(Interfaces, AMissingHandleNamesWhatThereIs)
{
  Numbers n;
  PositionJointInterface interface;
  interface.registerHandle(n.joint("a"));
  EXPECT_THROW(interface.getHandle("x"), HardwareInterfaceException);
  const std::string message = message_of([&] { interface.getHandle("x"); });
  EXPECT_NE(std::string::npos, message.find("Could not find resource 'x' in 'hardware_interface::PositionJointInterface'"))
      << message;
  EXPECT_NE(std::string::npos, message.find("it has: a")) << message;
}

TEST(Interfaces, TheSecondOfANameReplacesTheFirst)
{
  Numbers first, second;
  PositionJointInterface interface;
  interface.registerHandle(first.joint("a"));
  interface.registerHandle(second.joint("a"));
  interface.getHandle("a").setCommand(9.0);
  EXPECT_EQ(9.0, second.command);
  EXPECT_EQ(0.0, first.command);
}

/// Of a third party: no collection of handles.
class Gripper : public HardwareInterface
{
};

TEST(Interfaces, SayWhatTheyHold)
{
  struct Derived : EffortJointInterface
  {
    void registerHandle(const ResourceHandleType& handle) { EffortJointInterface::registerHandle(handle); }
  } interface;
  Numbers numbers;
  interface.registerHandle(numbers.joint("j"));
  EXPECT_TRUE((std::is_same<JointHandle, EffortJointInterface::ResourceHandleType>::value));
  EXPECT_EQ("j", interface.getHandle("j").getName());
}

TEST(Robots, OfferInterfacesByType)
{
  RobotHW robot;
  EffortJointInterface efforts;
  Gripper gripper;
  robot.registerInterface(&efforts);
  robot.registerInterface(&gripper);
  EXPECT_EQ(&efforts, robot.get<EffortJointInterface>());
  EXPECT_EQ(&gripper, robot.get<Gripper>());
  EXPECT_EQ(nullptr, robot.get<PositionJointInterface>());
  EXPECT_EQ(2u, robot.getNames().size());
}

TEST(Robots, MergeThoseOfTheirParts)
{
  Numbers a, b;
  RobotHW parent, left, right;
  EffortJointInterface lefts, rights;
  lefts.registerHandle(a.joint("a"));
  rights.registerHandle(b.joint("b"));
  left.registerInterface(&lefts);
  right.registerInterface(&rights);
  parent.registerInterfaceManager(&left);
  parent.registerInterfaceManager(&right);
  EffortJointInterface* merged = parent.get<EffortJointInterface>();
  ASSERT_NE(nullptr, merged);
  EXPECT_EQ((std::vector<std::string>{ "a", "b" }), merged->getNames());
  EXPECT_EQ(merged, parent.get<EffortJointInterface>()) << "claims must not be lost between two calls";
  merged->getHandle("b").setCommand(4.0);
  EXPECT_EQ(4.0, b.command);
  EXPECT_EQ((std::vector<std::string>{ "a", "b" }), parent.getInterfaceResources("hardware_interface::EffortJointInterface"));
  EXPECT_EQ(1u, parent.getNames().size());
}

TEST(Robots, CannotMergeWhatIsNoCollection)
{
  RobotHW parent, left, right;
  Gripper one, two;
  left.registerInterface(&one);
  right.registerInterface(&two);
  parent.registerInterfaceManager(&left);
  EXPECT_EQ(&one, parent.get<Gripper>());
  parent.registerInterfaceManager(&right);
  EXPECT_EQ(nullptr, parent.get<Gripper>());
}

TEST(Robots, SeeConflicts)
{
  const RobotHW robot;
  const InterfaceResources position("hardware_interface::PositionJointInterface", { "j1" });
  const InterfaceResources effort("hardware_interface::EffortJointInterface", { "j1" });
  const InterfaceResources other("hardware_interface::EffortJointInterface", { "j2" });
  EXPECT_TRUE(robot.checkForConflict({ info("a", { position }), info("b", { effort }) }));
  EXPECT_TRUE(robot.checkForConflict({ info("a", { position, effort }) }));
  EXPECT_FALSE(robot.checkForConflict({ info("a", { position, other }), info("b", {}) }));
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
