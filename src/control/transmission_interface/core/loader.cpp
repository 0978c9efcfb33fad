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

struct Loader : TransmissionLoader
{
  /// The three types of this package; in the order of the roles.
  TransmissionSharedPtr load(const TransmissionInfo& info) override
  {
    if (info.type_ == "transmission_interface/SimpleTransmission")
      return simple(info);
    return checkActuatorDimension(info, 2) && checkJointDimension(info, 2) ? of_two(info) : nullptr;
  }

  static TransmissionSharedPtr simple(const TransmissionInfo& info)
  {
    double reduction = 1.0, offset = 0.0;
    if (!checkActuatorDimension(info, 1) || !checkJointDimension(info, 1) ||
        getActuatorReduction(loadXmlElement(info.actuators_[0].xml_element_), info.actuators_[0].name_, info.name_, true,
                             reduction) != SUCCESS ||
        getJointOffset(loadXmlElement(info.joints_[0].xml_element_), info.joints_[0].name_, info.name_, false, offset) ==
            BAD_TYPE)
      return nullptr;
    return std::make_shared<SimpleTransmission>(reduction, offset);
  }

  static TransmissionSharedPtr of_two(const TransmissionInfo& info)
  {
    std::vector<double> actuators(2), joints(2, 1.0), offsets(2, 0.0);
    bool ignore = false;
    for (const ActuatorInfo& actuator : info.actuators_)
    {
      const TiXmlElement element = loadXmlElement(actuator.xml_element_);
      std::string role;
      double value = 0.0;
      if (getActuatorRole(element, actuator.name_, info.name_, true, role) != SUCCESS ||
          getActuatorReduction(element, actuator.name_, info.name_, true, value) != SUCCESS)
        return nullptr;
      actuators[role == "actuator2"] = value;
    }
    for (const JointInfo& joint : info.joints_)
    {
      const TiXmlElement element = loadXmlElement(joint.xml_element_);
      const bool second = joint.role_ == "joint2";
      if (getJointReduction(element, joint.name_, info.name_, false, joints[second]) == BAD_TYPE ||
          getJointOffset(element, joint.name_, info.name_, false, offsets[second]) == BAD_TYPE)
        return nullptr;
      ignore = ignore || element.FirstChildElement("ignoreTransmissionAbsoluteEncoder");
    }
    if (info.type_ == "transmission_interface/DifferentialTransmission")
      return std::make_shared<DifferentialTransmission>(actuators, joints, offsets, ignore);
    return std::make_shared<FourBarLinkageTransmission>(actuators, joints, offsets);
  }
};

bool is_ours(const std::string& type)
{
  return type == "transmission_interface/SimpleTransmission" || type == "transmission_interface/DifferentialTransmission" ||
         type == "transmission_interface/FourBarLinkageTransmission";
}

/// Actuators and joints in the order of their roles.
template <class Infos, class Role>
Infos ordered(Infos infos, Role role)
{
  std::stable_sort(infos.begin(), infos.end(),
                   [&](const typename Infos::value_type& a, const typename Infos::value_type& b) { return role(a) < role(b); });
  return infos;
}

std::string role_of(const ActuatorInfo& actuator)
{
  const std::string& xml = actuator.xml_element_;
  const std::size_t at = xml.find("<role>");
  return at == std::string::npos ? "" : xml.substr(at + 6, xml.find("</role>") - at - 6);
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

/// The transmission is asked for as `written` in the joint's <hardwareInterface>.
bool asks_for(const std::string& written, const char* kind)
{
  return written.find(std::string(kind) + "JointInterface") != std::string::npos;
}

/// \param both: commands also go from actuators to joints
void offer_commands(TransmissionLoaderData& data, const TransmissionInfo& info, Transmission& transmission,
                    const std::string& written, const std::vector<ActuatorInfo>& actuators,
                    const std::vector<JointInfo>& joints, bool both)
{
  ForwardTransmissionInterfaces& forward = data.transmission_interfaces;
  InverseTransmissionInterfaces& inverse = data.inverse_transmission_interfaces;
  const Command position = { &RawJointData::position_cmd, &JointData::position, &ActuatorData::position };
  const Command velocity = { &RawJointData::velocity_cmd, &JointData::velocity, &ActuatorData::velocity };
  const Command effort = { &RawJointData::effort_cmd, &JointData::effort, &ActuatorData::effort };
  JointInterfaces& interfaces = data.joint_interfaces;
  if (asks_for(written, "Position"))
    connect<hwi::PositionActuatorInterface>(data, info, transmission, position, actuators, joints,
                                            interfaces.position_joint_interface, forward.jnt_to_act_pos_cmd,
                                            inverse.act_to_jnt_pos_cmd, both);
  else if (asks_for(written, "Velocity"))
    connect<hwi::VelocityActuatorInterface>(data, info, transmission, velocity, actuators, joints,
                                            interfaces.velocity_joint_interface, forward.jnt_to_act_vel_cmd,
                                            inverse.act_to_jnt_vel_cmd, both);
  else if (asks_for(written, "Effort"))
    connect<hwi::EffortActuatorInterface>(data, info, transmission, effort, actuators, joints,
                                          interfaces.effort_joint_interface, forward.jnt_to_act_eff_cmd,
                                          inverse.act_to_jnt_eff_cmd, both);
  else if (!asks_for(written, "State"))
    ROS_WARN("transmission '%s': hardware interface '%s' is unknown and left out", info.name_.c_str(), written.c_str());
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
  if (!TransmissionParser::parse(urdf, infos))
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

TransmissionSharedPtr TransmissionInterfaceLoader::make(const TransmissionInfo& info)
{
  if (is_ours(info.type_))
    return Loader().load(info);
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
    const TransmissionSharedPtr transmission = make(info);
    if (!transmission)
      return false;
    const auto actuators = is_ours(info.type_) ? ordered(info.actuators_, role_of) : info.actuators_;
    const auto joints =
        is_ours(info.type_) ? ordered(info.joints_, [](const JointInfo& joint) { return joint.role_; }) : info.joints_;
    const ActuatorData measured = measurements(*data.robot_hw, info, actuators);
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
    ForwardTransmissionInterfaces& forward = data.transmission_interfaces;
    InverseTransmissionInterfaces& inverse = data.inverse_transmission_interfaces;
    offer(*data.robot_hw, data.joint_interfaces.joint_state_interface);
    forward.act_to_jnt_state.registerHandle(ActuatorToJointStateHandle(info.name_, transmission.get(), measured, states));
    offer(*data.robot_transmissions, forward.act_to_jnt_state);

    for (const std::string& written : joints.front().hardware_interfaces_)
    {
      const bool both = written.find("BiDirectional") != std::string::npos;
      if (both)
      {
        inverse.jnt_to_act_state.registerHandle(JointToActuatorStateHandle(info.name_, transmission.get(), measured, states));
        offer(*data.robot_transmissions, inverse.jnt_to_act_state);
      }
      offer_commands(data, info, *transmission, written, actuators, joints, both);
    }
    data.transmission_data.push_back(transmission);
    return true;
  }
  catch (const std::exception& error)
  {
    ROS_ERROR("Loading transmission '%s': %s", info.name_.c_str(), error.what());
    return false;
  }
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
