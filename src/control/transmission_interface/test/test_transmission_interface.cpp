// Transmissions in C++: their descriptions, and a robot whose joints come from them; their mathematics: test_transmission_law.py.
#include <gtest/gtest.h>

#include <transmission_interface/simple_transmission.h>
#include <transmission_interface/transmission_interface_loader.h>

using namespace transmission_interface;
namespace hwi = hardware_interface;

namespace
{

const char* const description = R"(
<robot name="r">
  <transmission name="lift"><type>transmission_interface/SimpleTransmission</type>
    <joint name="lift"><hardwareInterface>hardware_interface/EffortJointInterface</hardwareInterface><offset>0.5</offset></joint>
    <actuator name="motor"><mechanicalReduction>10</mechanicalReduction></actuator></transmission>
  <transmission name="no joint"><type>transmission_interface/SimpleTransmission</type><actuator name="x"/></transmission>
</robot>)";

struct Robot : hwi::RobotHW
{
  Robot()
  {
    const hwi::ActuatorStateHandle state("motor", &position, &velocity, &effort);
    states.registerHandle(state);
    efforts.registerHandle(hwi::ActuatorHandle(state, &command));
    registerInterface(&states);
    registerInterface(&efforts);
  }

  double position = 20.0, velocity = 30.0, effort = 0.4, command = 0.0;
  hwi::ActuatorStateInterface states;
  hwi::EffortActuatorInterface efforts;
};

}  // namespace

TEST(Handles, CheckWhatTheyAreGiven)
{
  SimpleTransmission transmission(1.0);
  double number = 0.0;
  ActuatorData actuators;
  JointData joints;
  EXPECT_THROW(ActuatorToJointStateHandle("t", nullptr, actuators, joints), TransmissionInterfaceException);
  EXPECT_THROW(ActuatorToJointStateHandle("t", &transmission, actuators, joints), TransmissionInterfaceException);
  actuators.position = { &number, &number };
  EXPECT_THROW(ActuatorToJointStateHandle("t", &transmission, actuators, joints), TransmissionInterfaceException);
  actuators.position = { nullptr };
  EXPECT_THROW(ActuatorToJointStateHandle("t", &transmission, actuators, joints), TransmissionInterfaceException);
}

TEST(Parser, LeavesOutWhatCannotBeUsed)
{
  std::vector<TransmissionInfo> infos;
  ASSERT_TRUE(TransmissionParser::parse(description, infos));
  ASSERT_EQ(1u, infos.size());
  EXPECT_EQ("lift", infos[0].name_);
  EXPECT_EQ("transmission_interface/SimpleTransmission", infos[0].type_);
  EXPECT_EQ("hardware_interface/EffortJointInterface", infos[0].joints_.at(0).hardware_interfaces_.at(0));
  EXPECT_EQ("motor", infos[0].actuators_.at(0).name_);
  infos.clear();
  EXPECT_FALSE(TransmissionParser::parse("<robot", infos));
  EXPECT_TRUE(TransmissionParser::parse("<robot/>", infos));  // as upstream's
  EXPECT_TRUE(infos.empty());
}

TEST(Loader, JointsOfARobot)
{
  Robot robot;
  RobotTransmissions transmissions;
  TransmissionInterfaceLoader loader(&robot, &transmissions);
  ASSERT_TRUE(loader.load(description));
  auto* states = transmissions.get<ActuatorToJointStateInterface>();
  auto* commands = transmissions.get<JointToActuatorEffortInterface>();
  ASSERT_TRUE(states && commands);
  states->propagate();
  EXPECT_DOUBLE_EQ(2.5, robot.get<hwi::JointStateInterface>()->getHandle("lift").getPosition());
  EXPECT_DOUBLE_EQ(3.0, robot.get<hwi::JointStateInterface>()->getHandle("lift").getVelocity());
  EXPECT_DOUBLE_EQ(4.0, robot.get<hwi::JointStateInterface>()->getHandle("lift").getEffort());
  robot.get<hwi::EffortJointInterface>()->getHandle("lift").setCommand(7.0);
  commands->propagate();
  EXPECT_DOUBLE_EQ(0.7, robot.command);
}

TEST(Loader, SaysWhatIsMissing)
{
  hwi::RobotHW bare;
  RobotTransmissions transmissions;
  EXPECT_FALSE(TransmissionInterfaceLoader(&bare, &transmissions).load(description));
  EXPECT_THROW(TransmissionInterfaceLoader(nullptr, &transmissions), std::invalid_argument);
}
