// Handles that change a joint's command so that it keeps its limits (limit_law.h), and collections of them.
#pragma once

#include <string>

#include <hardware_interface/internal/resource_manager.h>
#include <hardware_interface/joint_command_interface.h>
#include <joint_limits_interface/joint_limits.h>
#include <joint_limits_interface/joint_limits_interface_exception.h>
#include <joint_limits_interface/limit_law.h>
#include <ros/console.h>
#include <ros/duration.h>
#include <ros/time.h>

namespace joint_limits_interface
{
namespace internal
{

/// \throws JointLimitsInterfaceException the limit is not there
inline void need(bool has, const hardware_interface::JointHandle& joint, const char* kind)
{
  if (!has)
    throw JointLimitsInterfaceException("Cannot enforce limits for joint '" + joint.getName() + "'. It has no " + kind +
                                        " limits specification.");
}

/// What all limit handles have: a joint and its law.
class LimitHandle
{
public:
  LimitHandle() = default;

  std::string getName() const { return jh_.getName(); }

  /// Put the joint's command within its limits; a line in the log, at most every 5 s, where it is no usable number.
  /// \param period since the last cycle
  void enforceLimits(const ros::Duration& period)
  {
    const double wanted = jh_.getCommand();
    double allowed = wanted;
    if (!law_.enforce(allowed, jh_.getPosition(), jh_.getVelocity(), period.toSec()))
      warn(wanted, allowed);
    jh_.setCommand(allowed);
  }

  /// Forget the last command: the joint was moved by other means.
  void reset() { law_.reset(); }

protected:
  LimitHandle(const hardware_interface::JointHandle& joint, const CommandLimiter& law) : jh_(joint), law_(law) {}

  hardware_interface::JointHandle jh_;
  CommandLimiter law_;

private:
  void warn(double wanted, double held)
  {
    const ros::WallTime now = ros::WallTime::now();
    if (!warned_.isZero() && now - warned_ < ros::WallDuration(5.0))
      return;
    warned_ = now;
    ROS_WARN(
        "Joint '%s' was commanded %g, which is no usable number; holding %g. Look at the controller or the message that it "
        "was sent.",
        getName().c_str(), wanted, held);
  }

  ros::WallTime warned_;
};

}  // namespace internal

/// Keeps positions inside the limits and their steps within the velocity limit.
class PositionJointSaturationHandle : public internal::LimitHandle
{
public:
  PositionJointSaturationHandle() = default;
  PositionJointSaturationHandle(const hardware_interface::JointHandle& jh, const JointLimits& limits)
    : internal::LimitHandle(jh, CommandLimiter(LimitRule::PositionSaturation, limits))
  {
  }
};

/// Slows a joint down on its way to the soft limits, and keeps it inside the hard ones.
class PositionJointSoftLimitsHandle : public internal::LimitHandle
{
public:
  PositionJointSoftLimitsHandle() = default;

  /// \throws JointLimitsInterfaceException there are no velocity limits
  PositionJointSoftLimitsHandle(const hardware_interface::JointHandle& jh, const JointLimits& limits,
                                const SoftJointLimits& soft_limits)
    : internal::LimitHandle(jh, CommandLimiter(LimitRule::PositionSoft, limits, soft_limits))
  {
    internal::need(limits.has_velocity_limits, jh, "velocity");
  }
};

/// Keeps efforts within the limit, and lets none push further out of the position or velocity limits.
class EffortJointSaturationHandle : public internal::LimitHandle
{
public:
  EffortJointSaturationHandle() = default;

  /// \throws JointLimitsInterfaceException there are no velocity or effort limits
  EffortJointSaturationHandle(const hardware_interface::JointHandle& jh, const JointLimits& limits)
    : internal::LimitHandle(jh, CommandLimiter(LimitRule::EffortSaturation, limits))
  {
    internal::need(limits.has_velocity_limits, jh, "velocity");
    internal::need(limits.has_effort_limits, jh, "effort");
  }
};

/// Brakes an effort-commanded joint on its way to the soft position limits.
class EffortJointSoftLimitsHandle : public internal::LimitHandle
{
public:
  EffortJointSoftLimitsHandle() = default;

  /// \throws JointLimitsInterfaceException there are no velocity or effort limits
  EffortJointSoftLimitsHandle(const hardware_interface::JointHandle& jh, const JointLimits& limits,
                              const SoftJointLimits& soft_limits)
    : internal::LimitHandle(jh, CommandLimiter(LimitRule::EffortSoft, limits, soft_limits))
  {
    internal::need(limits.has_velocity_limits, jh, "velocity");
    internal::need(limits.has_effort_limits, jh, "effort");
  }
};

/// Keeps velocities within the limit, and their steps within the acceleration limit if there is one.
class VelocityJointSaturationHandle : public internal::LimitHandle
{
public:
  VelocityJointSaturationHandle() = default;

  /// \throws JointLimitsInterfaceException there are no velocity limits
  VelocityJointSaturationHandle(const hardware_interface::JointHandle& jh, const JointLimits& limits)
    : internal::LimitHandle(jh, CommandLimiter(LimitRule::VelocitySaturation, limits))
  {
    internal::need(limits.has_velocity_limits, jh, "velocity");
  }
};

/// Slows a velocity-commanded joint down on its way to the soft position limits.
class VelocityJointSoftLimitsHandle : public internal::LimitHandle
{
public:
  VelocityJointSoftLimitsHandle() = default;
  VelocityJointSoftLimitsHandle(const hardware_interface::JointHandle& jh, const JointLimits& limits,
                                const SoftJointLimits& soft_limits)
    : internal::LimitHandle(jh, CommandLimiter(LimitRule::VelocitySoft, limits, soft_limits))
  {
  }
};

/// Limit handles of one kind, enforced together in the order of their joints' names.
template <class HandleType>
class JointLimitsInterface : public hardware_interface::ResourceManager<HandleType>
{
public:
  HandleType getHandle(const std::string& name)
  {
    try
    {
      return this->hardware_interface::ResourceManager<HandleType>::getHandle(name);
    }
    catch (const std::logic_error& error)
    {
      throw JointLimitsInterfaceException(error.what());
    }
  }

  void enforceLimits(const ros::Duration& period)
  {
    for (auto& entry : this->resource_map_)
      entry.second.enforceLimits(period);
  }

  void reset()
  {
    for (auto& entry : this->resource_map_)
      entry.second.reset();
  }
};

class PositionJointSaturationInterface : public JointLimitsInterface<PositionJointSaturationHandle>
{
};

class PositionJointSoftLimitsInterface : public JointLimitsInterface<PositionJointSoftLimitsHandle>
{
};

class EffortJointSaturationInterface : public JointLimitsInterface<EffortJointSaturationHandle>
{
};

class EffortJointSoftLimitsInterface : public JointLimitsInterface<EffortJointSoftLimitsHandle>
{
};

class VelocityJointSaturationInterface : public JointLimitsInterface<VelocityJointSaturationHandle>
{
};

class VelocityJointSoftLimitsInterface : public JointLimitsInterface<VelocityJointSoftLimitsHandle>
{
};

}  // namespace joint_limits_interface
