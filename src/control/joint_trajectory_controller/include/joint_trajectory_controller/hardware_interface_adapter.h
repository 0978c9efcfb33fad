// From where joints should be to the commands of one kind of hardware. Whoever has an interface of his own specialises
// HardwareInterfaceAdapter for it.
#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <control_toolbox/pid.h>
#include <hardware_interface/joint_command_interface.h>
#include <hardware_interface/posvel_command_interface.h>
#include <hardware_interface/posvelacc_command_interface.h>
#include <ros/console.h>
#include <ros/node_handle.h>
#include <ros/time.h>

/// Commands nothing: of an interface that no adapter is made for.
/// \tparam State has position, velocity and acceleration, vectors with an entry for each joint
template <class HardwareInterface, class State>
class HardwareInterfaceAdapter
{
public:
  /// \return false: the controller does not load
  bool init(std::vector<typename HardwareInterface::ResourceHandleType>& /*joint_handles*/, ros::NodeHandle& controller_nh)
  {
    ROS_WARN(
        "%s: there is no HardwareInterfaceAdapter for this controller's hardware interface; unless the controller does it "
        "by itself, nothing is commanded",
        controller_nh.getNamespace().c_str());
    return true;
  }

  void starting(const ros::Time& /*time*/) {}
  void stopping(const ros::Time& /*time*/) {}
  void updateCommand(const ros::Time& /*time*/, const ros::Duration& /*period*/, const State& /*desired_state*/,
                     const State& /*state_error*/)
  {
  }
};

/// Desired positions.
template <class State>
class HardwareInterfaceAdapter<hardware_interface::PositionJointInterface, State>
{
public:
  bool init(std::vector<hardware_interface::JointHandle>& joint_handles, ros::NodeHandle& /*controller_nh*/)
  {
    joints_ = &joint_handles;
    return true;
  }

  void starting(const ros::Time& /*time*/)
  {
    for (hardware_interface::JointHandle& joint : *joints_)
      if (std::isfinite(joint.getPosition()))
        joint.setCommand(joint.getPosition());
  }

  void stopping(const ros::Time& /*time*/) {}

  void updateCommand(const ros::Time& /*time*/, const ros::Duration& /*period*/, const State& desired_state,
                     const State& /*state_error*/)
  {
    for (std::size_t i = 0; i < joints_->size(); ++i)
      (*joints_)[i].setCommand(desired_state.position[i]);
  }

private:
  std::vector<hardware_interface::JointHandle>* joints_ = nullptr;
};

/// A PID on the position error (parameters gains/JOINT) plus velocity_ff/JOINT times the desired velocity.
template <class State>
class ClosedLoopHardwareInterfaceAdapter
{
public:
  bool init(std::vector<hardware_interface::JointHandle>& joint_handles, ros::NodeHandle& controller_nh)
  {
    joints_ = &joint_handles;
    pids_.clear();
    velocity_ff_.clear();
    for (const hardware_interface::JointHandle& joint : joint_handles)
    {
      pids_.push_back(std::make_shared<control_toolbox::Pid>());
      if (!pids_.back()->init(ros::NodeHandle(controller_nh, "gains/" + joint.getName())))
        return false;  // the log says why
      velocity_ff_.push_back(controller_nh.param("velocity_ff/" + joint.getName(), 0.0));
      if (std::isfinite(velocity_ff_.back()))
        continue;
      ROS_ERROR("parameter %s must be a finite number, it is %g",
                controller_nh.resolveName("velocity_ff/" + joint.getName()).c_str(), velocity_ff_.back());
      return false;
    }
    return true;
  }

  void starting(const ros::Time& /*time*/)
  {
    for (std::size_t i = 0; i < pids_.size(); ++i)
    {
      pids_[i]->reset();
      (*joints_)[i].setCommand(0.0);
    }
  }

  void stopping(const ros::Time& /*time*/) {}

  void updateCommand(const ros::Time& /*time*/, const ros::Duration& period, const State& desired_state,
                     const State& state_error)
  {
    for (std::size_t i = 0; i < pids_.size(); ++i)
      (*joints_)[i].setCommand(velocity_ff_[i] * desired_state.velocity[i] +
                               pids_[i]->computeCommand(state_error.position[i], state_error.velocity[i], period));
  }

private:
  std::vector<std::shared_ptr<control_toolbox::Pid>> pids_;
  std::vector<double> velocity_ff_;
  std::vector<hardware_interface::JointHandle>* joints_ = nullptr;
};

/// Velocities.
template <class State>
class HardwareInterfaceAdapter<hardware_interface::VelocityJointInterface, State>
  : public ClosedLoopHardwareInterfaceAdapter<State>
{
};

/// Torques or forces.
template <class State>
class HardwareInterfaceAdapter<hardware_interface::EffortJointInterface, State>
  : public ClosedLoopHardwareInterfaceAdapter<State>
{
};

/// Desired positions and velocities.
template <class State>
class HardwareInterfaceAdapter<hardware_interface::PosVelJointInterface, State>
{
public:
  bool init(std::vector<hardware_interface::PosVelJointHandle>& joint_handles, ros::NodeHandle& /*controller_nh*/)
  {
    joints_ = &joint_handles;
    return true;
  }

  void starting(const ros::Time& /*time*/) {}
  void stopping(const ros::Time& /*time*/) {}

  void updateCommand(const ros::Time& /*time*/, const ros::Duration& /*period*/, const State& desired_state,
                     const State& /*state_error*/)
  {
    for (std::size_t i = 0; i < joints_->size(); ++i)
      (*joints_)[i].setCommand(desired_state.position[i], desired_state.velocity[i]);
  }

private:
  std::vector<hardware_interface::PosVelJointHandle>* joints_ = nullptr;
};

/// Desired positions, velocities and accelerations.
template <class State>
class HardwareInterfaceAdapter<hardware_interface::PosVelAccJointInterface, State>
{
public:
  bool init(std::vector<hardware_interface::PosVelAccJointHandle>& joint_handles, ros::NodeHandle& /*controller_nh*/)
  {
    joints_ = &joint_handles;
    return true;
  }

  void starting(const ros::Time& /*time*/) {}
  void stopping(const ros::Time& /*time*/) {}

  void updateCommand(const ros::Time& /*time*/, const ros::Duration& /*period*/, const State& desired_state,
                     const State& /*state_error*/)
  {
    for (std::size_t i = 0; i < joints_->size(); ++i)
      (*joints_)[i].setCommand(desired_state.position[i], desired_state.velocity[i], desired_state.acceleration[i]);
  }

private:
  std::vector<hardware_interface::PosVelAccJointHandle>* joints_ = nullptr;
};
