// Brings the transmissions of a robot's description to life between its actuators and its joint interfaces.
#pragma once

#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <hardware_interface/actuator_command_interface.h>
#include <hardware_interface/actuator_state_interface.h>
#include <hardware_interface/joint_command_interface.h>
#include <hardware_interface/joint_state_interface.h>
#include <hardware_interface/robot_hw.h>
#include <pluginlib/class_loader.hpp>
#include <transmission_interface/robot_transmissions.h>
#include <transmission_interface/transmission.h>
#include <transmission_interface/transmission_info.h>
#include <transmission_interface/transmission_interface.h>
#include <transmission_interface/transmission_loader.h>
#include <transmission_interface/transmission_parser.h>

namespace transmission_interface
{

/// The numbers of a joint, which its handles point at.
struct RawJointData
{
  double position = std::numeric_limits<double>::quiet_NaN();
  double velocity = std::numeric_limits<double>::quiet_NaN();
  double effort = std::numeric_limits<double>::quiet_NaN();
  double position_cmd = std::numeric_limits<double>::quiet_NaN();
  double velocity_cmd = std::numeric_limits<double>::quiet_NaN();
  double effort_cmd = std::numeric_limits<double>::quiet_NaN();
  double absolute_position = std::numeric_limits<double>::quiet_NaN();
  double torque_sensor = std::numeric_limits<double>::quiet_NaN();
  bool hasAbsolutePosition = true;
  bool hasTorqueSensor = true;
};

typedef std::map<std::string, RawJointData> RawJointDataMap;

struct JointInterfaces
{
  hardware_interface::JointStateInterface joint_state_interface;
  hardware_interface::PositionJointInterface position_joint_interface;
  hardware_interface::VelocityJointInterface velocity_joint_interface;
  hardware_interface::EffortJointInterface effort_joint_interface;
};

struct ForwardTransmissionInterfaces
{
  ActuatorToJointStateInterface act_to_jnt_state;
  JointToActuatorPositionInterface jnt_to_act_pos_cmd;
  JointToActuatorVelocityInterface jnt_to_act_vel_cmd;
  JointToActuatorEffortInterface jnt_to_act_eff_cmd;
};

struct InverseTransmissionInterfaces
{
  JointToActuatorStateInterface jnt_to_act_state;
  ActuatorToJointPositionInterface act_to_jnt_pos_cmd;
  ActuatorToJointVelocityInterface act_to_jnt_vel_cmd;
  ActuatorToJointEffortInterface act_to_jnt_eff_cmd;
};

/// What the loader has made; the two robots belong to its user.
struct TransmissionLoaderData
{
  hardware_interface::RobotHW* robot_hw = nullptr;
  RobotTransmissions* robot_transmissions = nullptr;
  JointInterfaces joint_interfaces;
  RawJointDataMap raw_joint_data_map;
  ForwardTransmissionInterfaces transmission_interfaces;
  InverseTransmissionInterfaces inverse_transmission_interfaces;
  std::vector<TransmissionSharedPtr> transmission_data;
};

class TransmissionInterfaceLoader
{
public:
  /// \param robot_hw has the actuator interfaces; gets the joint interfaces \param robot_transmissions gets what propagates
  /// \throws std::invalid_argument one of them is null
  TransmissionInterfaceLoader(hardware_interface::RobotHW* robot_hw, RobotTransmissions* robot_transmissions);

  // \return false at the first that fails, those before it stay; the log says why.

  bool load(const std::string& urdf);
  bool load(const std::vector<TransmissionInfo>& transmission_info_vec);
  bool load(const TransmissionInfo& transmission_info);

  TransmissionLoaderData* getData() { return &loader_data_; }

private:
  TransmissionSharedPtr make(const TransmissionInfo& info, std::vector<ActuatorInfo>& actuators,
                             std::vector<JointInfo>& joints);
  RawJointData& joint(const std::string& name, const ActuatorData& actuators);
  JointData states(const std::vector<JointInfo>& joints, const ActuatorData& measured);

  std::shared_ptr<pluginlib::ClassLoader<TransmissionLoader>> types_;
  TransmissionLoaderData loader_data_;
};

}  // namespace transmission_interface
