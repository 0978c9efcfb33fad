// Upstream's classes, driven from standard input; what comes out goes to standard output, a line each.
//   law kind sizes crosswise n... m... o...        sizes: how many numbers n, m and o are; "made" or "refused"
//   WAY numbers
//   robot URDF                                     parsed transmissions | "none" or the joints
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <transmission_interface/differential_transmission.h>
#include <transmission_interface/four_bar_linkage_transmission.h>
#include <transmission_interface/simple_transmission.h>
#include <transmission_interface/transmission_interface_loader.h>

using namespace transmission_interface;
namespace hwi = hardware_interface;

namespace
{

TransmissionSharedPtr make(const std::string& kind, const std::vector<double>& n, const std::vector<double>& m,
                           const std::vector<double>& o, bool crosswise)
{
  if (kind == "simple")
    return std::make_shared<SimpleTransmission>(n[0], o[0]);
  if (kind == "four_bar")
    return std::make_shared<FourBarLinkageTransmission>(n, m, o);
  if (crosswise)
    return std::make_shared<DifferentialTransmission>(n, m, true, o);
  return std::make_shared<DifferentialTransmission>(n, m, o);
}

void bring(Transmission& transmission, const std::string& way, std::vector<double> from)
{
  std::vector<double> to(2, 0.0);
  ActuatorData a;
  JointData j;
  const bool forward = way.find("_to_joint") != std::string::npos;
  for (std::size_t i = 0; i < transmission.numJoints(); ++i)
    for (int field = 0; field < 4; ++field)
    {
      (field == 0   ? a.position
       : field == 1 ? a.velocity
       : field == 2 ? a.effort
                    : a.absolute_position)
          .push_back(forward ? &from[i] : &to[i]);
      (field == 0   ? j.position
       : field == 1 ? j.velocity
       : field == 2 ? j.effort
                    : j.absolute_position)
          .push_back(forward ? &to[i] : &from[i]);
    }
  if (way == "position_to_joint")
    transmission.actuatorToJointPosition(a, j);
  else if (way == "velocity_to_joint")
    transmission.actuatorToJointVelocity(a, j);
  else if (way == "effort_to_joint")
    transmission.actuatorToJointEffort(a, j);
  else if (way == "absolute_to_joint")
    transmission.actuatorToJointAbsolutePosition(a, j);
  else if (way == "position_to_actuator")
    transmission.jointToActuatorPosition(j, a);
  else if (way == "velocity_to_actuator")
    transmission.jointToActuatorVelocity(j, a);
  else
    transmission.jointToActuatorEffort(j, a);
  for (std::size_t i = 0; i < transmission.numJoints(); ++i)
    std::printf("%a ", to[i]);
  std::puts("");
}

struct Robot : hwi::RobotHW
{
  Robot()
  {
    const char* const names[] = { "a", "b", "c" };
    for (int i = 0; i < 3; ++i)
    {
      const hwi::ActuatorStateHandle state(names[i], &numbers[i], &numbers[i], &numbers[i]);
      states.registerHandle(state);
      positions.registerHandle(hwi::ActuatorHandle(state, &commands[i]));
      if (i == 2)
        continue;
      velocities.registerHandle(hwi::ActuatorHandle(state, &commands[i]));
      efforts.registerHandle(hwi::ActuatorHandle(state, &commands[i]));
    }
    registerInterface(&states);
    registerInterface(&positions);
    registerInterface(&velocities);
    registerInterface(&efforts);
  }
  double numbers[3] = { 8.0, 16.0, 4.0 }, commands[3];
  hwi::ActuatorStateInterface states;
  hwi::PositionActuatorInterface positions;
  hwi::VelocityActuatorInterface velocities;
  hwi::EffortActuatorInterface efforts;
};

template <class Interface>
bool has(hwi::RobotHW& robot, const std::string& name)
{
  Interface* const interface = robot.get<Interface>();
  for (const std::string& one : interface ? interface->getNames() : std::vector<std::string>())
    if (one == name)
      return true;
  return false;
}

void describe(const std::string& urdf)
{
  std::vector<TransmissionInfo> infos;
  TransmissionParser::parse(urdf, infos);
  for (const TransmissionInfo& info : infos)
  {
    std::printf("%s%s:", &info == &infos[0] ? "" : " ", info.name_.c_str());
    for (const JointInfo& joint : info.joints_)
      std::printf("%s", joint.name_.c_str());
    std::printf("/");
    for (const ActuatorInfo& actuator : info.actuators_)
      std::printf("%s", actuator.name_.c_str());
  }
  Robot robot;
  RobotTransmissions transmissions;
  TransmissionInterfaceLoader loader(&robot, &transmissions);
  if (!loader.load(urdf))
  {
    std::puts("|none");
    return;
  }
  transmissions.get<ActuatorToJointStateInterface>()->propagate();
  std::string separator = "|";
  for (const std::string& name : robot.get<hwi::JointStateInterface>()->getNames())
  {
    std::printf("%s%s %g ", separator.c_str(), name.c_str(),
                robot.get<hwi::JointStateInterface>()->getHandle(name).getPosition());
    std::printf("%s%s%s", has<hwi::PositionJointInterface>(robot, name) ? "p" : "",
                has<hwi::VelocityJointInterface>(robot, name) ? "v" : "",
                has<hwi::EffortJointInterface>(robot, name) ? "e" : "");
    separator = ", ";
  }
  std::puts("");
}

}  // namespace

int main()
{
  TransmissionSharedPtr transmission;
  for (std::string line; std::getline(std::cin, line);)
  {
    std::istringstream in(line);
    std::string word, kind, text;
    in >> word;
    if (word == "robot")
    {
      describe(line.substr(6));
      continue;
    }
    if (word == "law")
      in >> kind;
    std::vector<double> numbers;
    while (in >> text)
      numbers.push_back(std::strtod(text.c_str(), nullptr));  // also inf and nan
    if (word != "law" && transmission)
      bring(*transmission, word, numbers);
    if (word != "law")
      continue;
    transmission.reset();
    const auto part = [&numbers](std::size_t i, std::size_t size) {
      return std::vector<double>(numbers.begin() + i, numbers.begin() + i + size);
    };
    const std::size_t n = numbers[0], m = numbers[1], o = numbers[2];
    try
    {
      transmission = make(kind, part(4, n), part(4 + n, m), part(4 + n + m, o), numbers[3] != 0.0);
      std::puts("made");
    }
    catch (const TransmissionInterfaceException&)
    {
      std::puts("refused");
    }
  }
}
