#include <gazebo_ros_control/default_robot_hw_sim.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gazebo_ros_control
{
namespace
{

using joint_limits_interface::JointLimits;
using joint_limits_interface::SoftJointLimits;

const std::string kPrefix = "hardware_interface/";

/// Without "hardware_interface/".
std::string interface_of(const std::string& written)
{
  return written.compare(0, kPrefix.size(), kPrefix) == 0 ? written.substr(kPrefix.size()) : written;
}

/// That of the joint, else of the actuator; the first where there are several.
std::string interface_of(const transmission_interface::TransmissionInfo& transmission)
{
  const transmission_interface::JointInfo& joint = transmission.joints_[0];
  std::vector<std::string> interfaces = joint.hardware_interfaces_;
  if (interfaces.empty() && !transmission.actuators_.empty())
    interfaces = transmission.actuators_[0].hardware_interfaces_;
  const std::string interface = interfaces.empty() ? "" : interface_of(interfaces[0]);
  if (interfaces.size() > 1)
    ROS_WARN("transmission '%s' names several hardware interfaces for joint '%s'; the first, %s, is taken",
             transmission.name_.c_str(), joint.name_.c_str(), interface.c_str());
  return interface;
}

bool drives_one(const transmission_interface::TransmissionInfo& transmission)
{
  if (transmission.joints_.size() == 1)
    return true;
  ROS_WARN("Transmission '%s' has %zu joints; it is left out: the simulation drives joints directly",
           transmission.name_.c_str(), transmission.joints_.size());
  return false;
}

bool possible(const std::string& interface, const transmission_interface::TransmissionInfo& transmission)
{
  if (interface == "EffortJointInterface" || interface == "PositionJointInterface" || interface == "VelocityJointInterface")
    return true;
  ROS_ERROR(
      "transmission '%s', joint '%s': hardware interface '%s' cannot be simulated; possible are "
      "hardware_interface/EffortJointInterface, PositionJointInterface and VelocityJointInterface",
      transmission.name_.c_str(), transmission.joints_[0].name_.c_str(), interface.c_str());
  return false;
}

}  // namespace

bool DefaultRobotHWSim::initSim(const std::string& robot_namespace, ros::NodeHandle model_nh,
                                gazebo::physics::ModelPtr parent_model, const urdf::Model* const urdf_model,
                                std::vector<transmission_interface::TransmissionInfo> transmissions)
{
  const std::size_t most = transmissions.size();
  for (auto* numbers :
       { &joint_lower_limits_, &joint_upper_limits_, &joint_effort_limits_, &joint_position_, &joint_velocity_, &joint_effort_,
         &joint_effort_command_, &joint_position_command_, &last_joint_position_command_, &joint_velocity_command_ })
    numbers->reserve(most);
  physics_type_ = parent_model->GetWorld()->Physics()->GetType();
  registerInterface(&js_interface_);
  registerInterface(&ej_interface_);
  registerInterface(&pj_interface_);
  registerInterface(&vj_interface_);
  const ros::NodeHandle nh(robot_namespace.empty() ? model_nh.getNamespace() : robot_namespace);
  for (const auto& transmission : transmissions)
    if (!addJoint(transmission, nh, parent_model, urdf_model))
      return false;
  if (sim_joints_.empty())
    ROS_WARN("model '%s': no joint has a transmission that can be used, so controllers find no joints",
             parent_model->GetName().c_str());
  return true;
}

/// \return false where the robot cannot be controlled at all
bool DefaultRobotHWSim::addJoint(const transmission_interface::TransmissionInfo& transmission, const ros::NodeHandle& nh,
                                 const gazebo::physics::ModelPtr& model, const urdf::Model* urdf_model)
{
  const char* const name = transmission.name_.c_str();
  if (!drives_one(transmission))
    return true;
  const transmission_interface::JointInfo& info = transmission.joints_[0];
  const std::string interface = interface_of(transmission);
  const gazebo::physics::JointPtr joint = model->GetJoint(info.name_);
  if (!joint)
  {
    ROS_ERROR("transmission '%s': the model '%s' has no joint '%s' (a fixed joint is merged into its parent link)", name,
              model->GetName().c_str(), info.name_.c_str());
    return false;
  }
  if (!possible(interface, transmission))
    return false;

  const std::size_t j = n_dof_++;
  joint_names_.push_back(info.name_);
  joint_types_.push_back(urdf::Joint::UNKNOWN);
  joint_control_methods_.push_back(EFFORT);
  pid_controllers_.emplace_back();
  sim_joints_.push_back(joint);
  joint_position_.push_back(joint->Position(0));
  joint_velocity_.push_back(0.0);
  joint_position_command_.push_back(joint_position_[j]);
  last_joint_position_command_.push_back(joint_position_[j]);
  for (auto* numbers :
       { &joint_lower_limits_, &joint_upper_limits_, &joint_effort_, &joint_effort_command_, &joint_velocity_command_ })
    numbers->push_back(0.0);
  joint_effort_limits_.push_back(std::numeric_limits<double>::max());

  const hardware_interface::JointStateHandle state(info.name_, &joint_position_[j], &joint_velocity_[j], &joint_effort_[j]);
  js_interface_.registerHandle(state);
  hardware_interface::JointHandle handle;
  if (interface == "EffortJointInterface")
  {
    handle = hardware_interface::JointHandle(state, &joint_effort_command_[j]);
    ej_interface_.registerHandle(handle);
  }
  else
  {
    const bool positions = interface == "PositionJointInterface";
    const ros::NodeHandle gains(nh, "gazebo_ros_control/pid_gains/" + info.name_);
    const bool pid = gains.hasParam("p") && pid_controllers_[j].init(gains);
    joint_control_methods_[j] = positions ? (pid ? POSITION_PID : POSITION) : (pid ? VELOCITY_PID : VELOCITY);
    handle = hardware_interface::JointHandle(state, positions ? &joint_position_command_[j] : &joint_velocity_command_[j]);
    if (positions)
      pj_interface_.registerHandle(handle);
    else
      vj_interface_.registerHandle(handle);
  }
  registerJointLimits(info.name_, handle, joint_control_methods_[j], nh, urdf_model, &joint_types_[j], &joint_lower_limits_[j],
                      &joint_upper_limits_[j], &joint_effort_limits_[j]);
  if (joint_control_methods_[j] == VELOCITY)
    joint->SetParam("fmax", 0, joint_effort_limits_[j]);
  return true;
}

void DefaultRobotHWSim::registerJointLimits(const std::string& joint_name, const hardware_interface::JointHandle& joint_handle,
                                            const ControlMethod ctrl_method, const ros::NodeHandle& joint_limit_nh,
                                            const urdf::Model* const urdf_model, int* const joint_type,
                                            double* const lower_limit, double* const upper_limit, double* const effort_limit)
{
  *joint_type = urdf::Joint::UNKNOWN;
  *lower_limit = -std::numeric_limits<double>::max();
  *upper_limit = *effort_limit = std::numeric_limits<double>::max();
  JointLimits limits;
  SoftJointLimits soft;
  bool has_limits = false, has_soft = false;
  if (const urdf::JointConstSharedPtr joint = urdf_model ? urdf_model->getJoint(joint_name) : nullptr)
  {
    *joint_type = joint->type;
    has_limits = joint_limits_interface::getJointLimits(joint, limits);
    has_soft = joint_limits_interface::getSoftJointLimits(joint, soft);
  }
  has_limits = joint_limits_interface::getJointLimits(joint_name, joint_limit_nh, limits) || has_limits;
  if (!has_limits)
    return;
  if (*joint_type == urdf::Joint::UNKNOWN)
    *joint_type = limits.has_position_limits ? urdf::Joint::REVOLUTE
                  : limits.angle_wraparound  ? urdf::Joint::CONTINUOUS
                                             : urdf::Joint::PRISMATIC;
  if (limits.has_position_limits)
    *lower_limit = limits.min_position, *upper_limit = limits.max_position;
  if (limits.has_effort_limits)
    *effort_limit = limits.max_effort;
  using namespace joint_limits_interface;
  try
  {
    switch (ctrl_method)
    {
      case EFFORT:
        if (has_soft)
          ej_limits_interface_.registerHandle(EffortJointSoftLimitsHandle(joint_handle, limits, soft));
        else
          ej_sat_interface_.registerHandle(EffortJointSaturationHandle(joint_handle, limits));
        break;
      case POSITION:
      case POSITION_PID:
        if (has_soft)
          pj_limits_interface_.registerHandle(PositionJointSoftLimitsHandle(joint_handle, limits, soft));
        else
          pj_sat_interface_.registerHandle(PositionJointSaturationHandle(joint_handle, limits));
        break;
      case VELOCITY:
      case VELOCITY_PID:
        if (has_soft)
          vj_limits_interface_.registerHandle(VelocityJointSoftLimitsHandle(joint_handle, limits, soft));
        else
          vj_sat_interface_.registerHandle(VelocityJointSaturationHandle(joint_handle, limits));
    }
  }
  catch (const std::exception& error)
  {
    ROS_WARN("joint '%s' is not limited: %s", joint_name.c_str(), error.what());
  }
}

void DefaultRobotHWSim::readSim(ros::Time, ros::Duration)
{
  for (std::size_t j = 0; j < sim_joints_.size(); ++j)
  {
    const double position = sim_joints_[j]->Position(0);
    // Of an endless joint without jumps, whatever turn the simulation counts it in.
    if (joint_types_[j] == urdf::Joint::PRISMATIC || joint_types_[j] == urdf::Joint::REVOLUTE)
      joint_position_[j] = position;
    else
      joint_position_[j] += std::remainder(position - joint_position_[j], 2 * M_PI);
    joint_velocity_[j] = sim_joints_[j]->GetVelocity(0);
    joint_effort_[j] = sim_joints_[j]->GetForce(0);
  }
}

double DefaultRobotHWSim::positionError(unsigned int j) const
{
  const double error = joint_position_command_[j] - joint_position_[j];
  return joint_types_[j] == urdf::Joint::CONTINUOUS ? std::remainder(error, 2 * M_PI) : error;
}

void DefaultRobotHWSim::writeSim(ros::Time, ros::Duration period)
{
  if (e_stop_active_)
  {
    if (!last_e_stop_active_)
      last_joint_position_command_ = joint_position_;
    joint_position_command_ = last_joint_position_command_;
  }
  last_e_stop_active_ = e_stop_active_;

  ej_sat_interface_.enforceLimits(period);
  ej_limits_interface_.enforceLimits(period);
  pj_sat_interface_.enforceLimits(period);
  pj_limits_interface_.enforceLimits(period);
  vj_sat_interface_.enforceLimits(period);
  vj_limits_interface_.enforceLimits(period);

  for (std::size_t j = 0; j < sim_joints_.size(); ++j)
  {
    const double limit = joint_effort_limits_[j], speed = e_stop_active_ ? 0.0 : joint_velocity_command_[j];
    const auto push = [&](double error) {
      const double effort = pid_controllers_[j].computeCommand(error, period);
      sim_joints_[j]->SetForce(0, std::max(-limit, std::min(effort, limit)));
    };
    switch (joint_control_methods_[j])
    {
      case EFFORT:
        sim_joints_[j]->SetForce(0, e_stop_active_ ? 0.0 : joint_effort_command_[j]);
        break;
      case POSITION:
        gazebo::internal::Drive(sim_joints_[j], joint_position_command_[j]);
        break;
      case POSITION_PID:
        push(positionError(j));
        break;
      case VELOCITY:
        sim_joints_[j]->SetParam("vel", 0, speed);
        break;
      case VELOCITY_PID:
        push(speed - joint_velocity_[j]);
        break;
    }
  }
}

void DefaultRobotHWSim::eStopActive(const bool active) { e_stop_active_ = active; }

}  // namespace gazebo_ros_control
