#include <transmission_interface/transmission_interface_loader.h>

#include <algorithm>
#include <stdexcept>

#include <transmission_interface/differential_transmission.h>
#include <transmission_interface/four_bar_linkage_transmission.h>
#include <transmission_interface/simple_transmission.h>

namespace transmission_interface
{
namespace
{

namespace hwi = hardware_interface;

/// What makes a transmission of this package.
typedef TransmissionSharedPtr (*Make)(const TransmissionLaw& law);

template <class T>
TransmissionSharedPtr made(const TransmissionLaw& law)
{
  return std::make_shared<T>(law);
}

/// \return whether the type is one of this package
bool ours(const std::string& type, Coupling& coupling, Make& make)
{
  if (type == "transmission_interface/SimpleTransmission")
    coupling = Coupling::Simple, make = made<SimpleTransmission>;
  else if (type == "transmission_interface/DifferentialTransmission")
    coupling = Coupling::Differential, make = made<DifferentialTransmission>;
  else if (type == "transmission_interface/FourBarLinkageTransmission")
    coupling = Coupling::FourBar, make = made<FourBarLinkageTransmission>;
  else
    return false;
  return true;
}

template <class Infos>
std::vector<Part> parts(const Infos& infos)
{
  std::vector<Part> result;
  for (const auto& info : infos)
  {
    TiXmlElement element("");
    std::stringstream(info.xml_element_) >> element;
    const auto text = [&element](const char* tag) {
      const TiXmlElement* child = element.FirstChildElement(tag);
      return Text{ child != nullptr, child && child->GetText() ? child->GetText() : "" };
    };
    result.push_back(Part{ info.name_, text("role").text, text("mechanicalReduction"), text("offset"),
                           element.FirstChildElement("ignoreTransmissionAbsoluteEncoder") != nullptr });
  }
  return result;
}

template <class Infos>
Infos ordered(const Infos& infos, const std::vector<std::size_t>& order)
{
  Infos result;
  for (std::size_t i : order)
    result.push_back(infos[i]);
  return result;
}

double* mutable_address(const double* number)
{
  return const_cast<double*>(number);  // the robot's own number; handles only show it as one that is read
}

/// \throws TransmissionInterfaceException the robot lacks the interface or the actuator
template <class Interface>
Interface& interface_of(hwi::RobotHW& robot, const TransmissionInfo& info)
{
  if (Interface* interface = robot.get<Interface>())
    return *interface;
  throw TransmissionInterfaceException("transmission '" + info.name_ + "' needs actuators with " +
                                       hwi::internal::demangledTypeName<Interface>() + ", which this robot does not have");
}

template <class T>
void offer(hwi::InterfaceManager& manager, T& interface)
{
  if (!manager.get<T>())
    manager.registerInterface(&interface);
}

template <class Interface, class Handle>
void add(Interface& interface, const Handle& handle)
{
  const std::vector<std::string> names = interface.getNames();
  if (std::find(names.begin(), names.end(), handle.getName()) == names.end())
    interface.registerHandle(handle);
}

/// One kind of command: where it is at a joint, and what transmits it.
struct Command
{
  double RawJointData::*number;
  std::vector<double*> JointData::*joint;
  std::vector<double*> ActuatorData::*actuator;
};

template <class ActuatorInterface, class JointInterface, class Forward, class Inverse>
void connect(TransmissionLoaderData& data, const TransmissionInfo& info, Transmission& transmission, const Command& command,
             const std::vector<ActuatorInfo>& actuators, const std::vector<JointInfo>& joints, JointInterface& interface,
             Forward& forward, Inverse& inverse, bool bidirectional)
{
  ActuatorInterface& actuator_interface = interface_of<ActuatorInterface>(*data.robot_hw, info);
  ActuatorData at_actuators;
  JointData at_joints;
  for (const ActuatorInfo& actuator : actuators)
    (at_actuators.*command.actuator).push_back(mutable_address(actuator_interface.getHandle(actuator.name_).getCommandPtr()));
  for (const JointInfo& joint : joints)
  {
    RawJointData& raw = data.raw_joint_data_map[joint.name_];
    add(interface,
        hwi::JointHandle(data.joint_interfaces.joint_state_interface.getHandle(joint.name_), &(raw.*command.number)));
    (at_joints.*command.joint).push_back(&(raw.*command.number));
  }
  offer(*data.robot_hw, interface);
  using ForwardHandle = typename std::decay<decltype(forward.getHandle(""))>::type;
  forward.registerHandle(ForwardHandle(info.name_, &transmission, at_actuators, at_joints));
  offer(*data.robot_transmissions, forward);
  if (!bidirectional)
    return;
  using InverseHandle = typename std::decay<decltype(inverse.getHandle(""))>::type;
  inverse.registerHandle(InverseHandle(info.name_, &transmission, at_actuators, at_joints));
  offer(*data.robot_transmissions, inverse);
}

/// Where the robot keeps what its actuators measure.
ActuatorData measurements(hwi::RobotHW& robot, const TransmissionInfo& info, const std::vector<ActuatorInfo>& actuators)
{
  ActuatorData measured;
  for (const ActuatorInfo& actuator : actuators)
  {
    const hwi::ActuatorStateHandle handle = interface_of<hwi::ActuatorStateInterface>(robot, info).getHandle(actuator.name_);
    measured.position.push_back(mutable_address(handle.getPositionPtr()));
    measured.velocity.push_back(mutable_address(handle.getVelocityPtr()));
    measured.effort.push_back(mutable_address(handle.getEffortPtr()));
    if (handle.hasAbsolutePosition())
      measured.absolute_position.push_back(mutable_address(handle.getAbsolutePositionPtr()));
    if (handle.hasTorqueSensor())
      measured.torque_sensor.push_back(mutable_address(handle.getTorqueSensorPtr()));
  }
  if (measured.absolute_position.size() != actuators.size())
    measured.absolute_position.clear();  // all or none
  if (measured.torque_sensor.size() != actuators.size())
    measured.torque_sensor.clear();
  return measured;
}

void offer_commands(TransmissionLoaderData& data, const TransmissionInfo& info, Transmission& transmission, const Asked& asked,
                    const std::vector<ActuatorInfo>& actuators, const std::vector<JointInfo>& joints)
{
  ForwardTransmissionInterfaces& forward = data.transmission_interfaces;
  InverseTransmissionInterfaces& inverse = data.inverse_transmission_interfaces;
  const Command position = { &RawJointData::position_cmd, &JointData::position, &ActuatorData::position };
  const Command velocity = { &RawJointData::velocity_cmd, &JointData::velocity, &ActuatorData::velocity };
  const Command effort = { &RawJointData::effort_cmd, &JointData::effort, &ActuatorData::effort };
  JointInterfaces& interfaces = data.joint_interfaces;
  if (asked.kind == "position")
    connect<hwi::PositionActuatorInterface>(data, info, transmission, position, actuators, joints,
                                            interfaces.position_joint_interface, forward.jnt_to_act_pos_cmd,
                                            inverse.act_to_jnt_pos_cmd, asked.both_ways);
  else if (asked.kind == "velocity")
    connect<hwi::VelocityActuatorInterface>(data, info, transmission, velocity, actuators, joints,
                                            interfaces.velocity_joint_interface, forward.jnt_to_act_vel_cmd,
                                            inverse.act_to_jnt_vel_cmd, asked.both_ways);
  else if (asked.kind == "effort")
    connect<hwi::EffortActuatorInterface>(data, info, transmission, effort, actuators, joints,
                                          interfaces.effort_joint_interface, forward.jnt_to_act_eff_cmd,
                                          inverse.act_to_jnt_eff_cmd, asked.both_ways);
}

/// Interfaces of all joints that are known; the log names the others.
std::vector<std::string> usable(const TransmissionInfo& info)
{
  std::vector<std::vector<std::string>> listed;
  for (const JointInfo& joint : info.joints_)
    listed.push_back(joint.hardware_interfaces_);
  for (const std::string& written : listed.at(0))
    if (asked_for(written).kind.empty())
      ROS_WARN("transmission '%s': hardware interface '%s' is unknown and left out", info.name_.c_str(), written.c_str());
  return known_interfaces(info.name_, listed);
}

}  // namespace

TransmissionInterfaceLoader::TransmissionInterfaceLoader(hwi::RobotHW* robot_hw, RobotTransmissions* robot_transmissions)
{
  if (!robot_hw || !robot_transmissions)
    throw std::invalid_argument(robot_hw ? "Invalid robot transmissions instance pointer." : "Invalid robot hardware pointer.");
  loader_data_.robot_hw = robot_hw;
  loader_data_.robot_transmissions = robot_transmissions;
}

bool TransmissionInterfaceLoader::load(const std::string& urdf)
{
  std::vector<TransmissionInfo> infos;
  if (!TransmissionParser::parse(urdf, infos) || infos.empty())
  {
    ROS_ERROR("Loading transmissions: the robot description has no usable <transmission>");
    return false;
  }
  return load(infos);
}

bool TransmissionInterfaceLoader::load(const std::vector<TransmissionInfo>& infos)
{
  return std::all_of(infos.begin(), infos.end(), [this](const TransmissionInfo& info) { return load(info); });
}

TransmissionSharedPtr TransmissionInterfaceLoader::make(const TransmissionInfo& info, std::vector<ActuatorInfo>& actuators,
                                                        std::vector<JointInfo>& joints)
{
  Coupling coupling;
  Make make;
  if (ours(info.type_, coupling, make))
  {
    const Plan plan = plan_transmission(coupling, info.name_, info.type_, parts(info.actuators_), parts(info.joints_));
    actuators = ordered(info.actuators_, plan.actuators);
    joints = ordered(info.joints_, plan.joints);
    return make(plan.law);
  }
  actuators = info.actuators_;
  joints = info.joints_;
  if (!types_)
    types_ = std::make_shared<pluginlib::ClassLoader<TransmissionLoader>>("transmission_interface",
                                                                          "transmission_interface::TransmissionLoader");
  return std::shared_ptr<TransmissionLoader>(types_->createUnmanagedInstance(info.type_))->load(info);
}

bool TransmissionInterfaceLoader::load(const TransmissionInfo& info)
{
  TransmissionLoaderData& data = loader_data_;
  try
  {
    std::vector<ActuatorInfo> actuators;
    std::vector<JointInfo> joints;
    const TransmissionSharedPtr transmission = make(info, actuators, joints);
    if (!transmission)
      return false;
    const std::vector<std::string> interfaces = usable(info);
    const ActuatorData measured = measurements(*data.robot_hw, info, actuators);
    const JointData states = this->states(joints, measured);
    ForwardTransmissionInterfaces& forward = data.transmission_interfaces;
    InverseTransmissionInterfaces& inverse = data.inverse_transmission_interfaces;
    offer(*data.robot_hw, data.joint_interfaces.joint_state_interface);
    forward.act_to_jnt_state.registerHandle(ActuatorToJointStateHandle(info.name_, transmission.get(), measured, states));
    offer(*data.robot_transmissions, forward.act_to_jnt_state);

    data.transmission_data.push_back(transmission);  // once more for each interface, as upstream's

    std::size_t failed = 0;
    for (const std::string& written : interfaces)
    {
      const Asked asked = asked_for(written);
      try
      {
        offer_commands(data, info, *transmission, asked, actuators, joints);
      }
      catch (const std::exception& error)
      {
        ROS_ERROR("Loading transmission '%s': %s", info.name_.c_str(), error.what());
        ++failed;
        continue;
      }
      if (!asked.both_ways)
        continue;
      inverse.jnt_to_act_state.registerHandle(JointToActuatorStateHandle(info.name_, transmission.get(), measured, states));
      offer(*data.robot_transmissions, inverse.jnt_to_act_state);
    }
    data.transmission_data.resize(data.transmission_data.size() + interfaces.size() - failed - (failed < interfaces.size()),
                                  transmission);
    return failed < interfaces.size();
  }
  catch (const std::exception& error)
  {
    ROS_ERROR("Loading transmission '%s': %s", info.name_.c_str(), error.what());
    return false;
  }
}

JointData TransmissionInterfaceLoader::states(const std::vector<JointInfo>& joints, const ActuatorData& measured)
{
  JointData states;
  for (const JointInfo& one : joints)
  {
    RawJointData& raw = joint(one.name_, measured);
    states.position.push_back(&raw.position);
    states.velocity.push_back(&raw.velocity);
    states.effort.push_back(&raw.effort);
    if (!measured.absolute_position.empty())
      states.absolute_position.push_back(&raw.absolute_position);
    if (!measured.torque_sensor.empty())
      states.torque_sensor.push_back(&raw.torque_sensor);
  }
  return states;
}

RawJointData& TransmissionInterfaceLoader::joint(const std::string& name, const ActuatorData& actuators)
{
  RawJointData& raw = loader_data_.raw_joint_data_map[name];
  raw.hasAbsolutePosition = !actuators.absolute_position.empty();
  raw.hasTorqueSensor = !actuators.torque_sensor.empty();
  if (raw.hasAbsolutePosition && raw.hasTorqueSensor)
    add(loader_data_.joint_interfaces.joint_state_interface,
        hwi::JointStateHandle(name, &raw.position, &raw.velocity, &raw.effort, &raw.absolute_position, &raw.torque_sensor));
  else if (raw.hasAbsolutePosition)
    add(loader_data_.joint_interfaces.joint_state_interface,
        hwi::JointStateHandle(name, &raw.position, &raw.velocity, &raw.effort, &raw.absolute_position));
  else if (raw.hasTorqueSensor)
    add(loader_data_.joint_interfaces.joint_state_interface,
        hwi::JointStateHandle(name, &raw.position, &raw.velocity, &raw.effort, &raw.torque_sensor, true));
  else
    add(loader_data_.joint_interfaces.joint_state_interface,
        hwi::JointStateHandle(name, &raw.position, &raw.velocity, &raw.effort));
  return raw;
}

}  // namespace transmission_interface
