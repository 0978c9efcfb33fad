// Handles that change a joint's command so that it keeps its limits, and collections of them.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <hardware_interface/internal/resource_manager.h>
#include <hardware_interface/joint_command_interface.h>
#include <joint_limits_interface/joint_limits.h>
#include <joint_limits_interface/joint_limits_interface_exception.h>
#include <ros/console.h>
#include <ros/duration.h>

namespace joint_limits_interface
{
namespace internal
{

template <typename T>
inline T saturate(const T value, const T low, const T high)
{
  return std::min(std::max(value, low), high);
}

inline double infinite() { return std::numeric_limits<double>::infinity(); }

/// \throws JointLimitsInterfaceException the limit is not there
inline void need(bool has, const hardware_interface::JointHandle& joint, const char* kind)
{
  if (!has)
    throw JointLimitsInterfaceException("Cannot enforce limits for joint '" + joint.getName() + "'. It has no " + kind +
                                        " limits specification.");
}

/// What all limit handles have.
class LimitHandle
{
public:
  LimitHandle() = default;
  LimitHandle(const hardware_interface::JointHandle& joint, const JointLimits& limits) : jh_(joint), limits_(limits) {}

  std::string getName() const { return jh_.getName(); }

protected:
  double lowest() const { return limits_.has_position_limits ? limits_.min_position : -infinite(); }
  double highest() const { return limits_.has_position_limits ? limits_.max_position : infinite(); }
  double fastest() const { return limits_.has_velocity_limits ? limits_.max_velocity : infinite(); }

  /// Velocities that bring the joint to its soft limits, as fast as it may.
  void soft_velocities(const SoftJointLimits& soft, double position, double& low, double& high) const
  {
    const double limit = fastest();
    low = -limit;
    high = limit;
    if (!limits_.has_position_limits)
      return;
    low = saturate(-soft.k_position * (position - soft.min_position), -limit, limit);
    high = saturate(-soft.k_position * (position - soft.max_position), -limit, limit);
  }

  hardware_interface::JointHandle jh_;
  JointLimits limits_;
};

/// Those of positions remember their last output; before the first cycle it is the measured position.
class PositionLimitHandle : public LimitHandle
{
public:
  PositionLimitHandle() = default;
  using LimitHandle::LimitHandle;

  /// Forget the last command: the joint was moved by other means.
  void reset() { previous_ = std::numeric_limits<double>::quiet_NaN(); }

protected:
  double previous()
  {
    if (std::isnan(previous_))
      previous_ = jh_.getPosition();
    return previous_;
  }

  void command(double low, double high)
  {
    previous_ = saturate(jh_.getCommand(), std::max(low, lowest()), std::min(high, highest()));
    jh_.setCommand(previous_);
  }

private:
  double previous_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace internal

/// Keeps positions inside the limits and their steps within the velocity limit.
class PositionJointSaturationHandle : public internal::PositionLimitHandle
{
public:
  PositionJointSaturationHandle() = default;
  PositionJointSaturationHandle(const hardware_interface::JointHandle& jh, const JointLimits& limits)
    : internal::PositionLimitHandle(jh, limits)
  {
  }

  /// \param period since the last cycle
  void enforceLimits(const ros::Duration& period)
  {
    const double from = previous();
    const double step = limits_.has_velocity_limits ? limits_.max_velocity * period.toSec() : internal::infinite();
    command(from - step, from + step);
  }
};

/// Slows a joint down on its way to the soft limits, and keeps it inside the hard ones.
class PositionJointSoftLimitsHandle : public internal::PositionLimitHandle
{
public:
  PositionJointSoftLimitsHandle() = default;

  /// \throws JointLimitsInterfaceException there are no velocity limits
  PositionJointSoftLimitsHandle(const hardware_interface::JointHandle& jh, const JointLimits& limits,
                                const SoftJointLimits& soft_limits)
    : internal::PositionLimitHandle(jh, limits)
    , soft_limits_(soft_limits)
  {
    internal::need(limits.has_velocity_limits, jh, "velocity");
  }

  void enforceLimits(const ros::Duration& period)
  {
    const double from = previous();
    double low, high;
    soft_velocities(soft_limits_, from, low, high);
    command(from + low * period.toSec(), from + high * period.toSec());
  }

private:
  SoftJointLimits soft_limits_;
};

/// Keeps efforts within the limit, and lets none push further out of the position or velocity limits.
class EffortJointSaturationHandle : public internal::LimitHandle
{
public:
  EffortJointSaturationHandle() = default;

  /// \throws JointLimitsInterfaceException there are no velocity or effort limits
  EffortJointSaturationHandle(const hardware_interface::JointHandle& jh, const JointLimits& limits)
    : internal::LimitHandle(jh, limits)
  {
    internal::need(limits.has_velocity_limits, jh, "velocity");
    internal::need(limits.has_effort_limits, jh, "effort");
  }

  void enforceLimits(const ros::Duration& /*period*/)
  {
    double low = -limits_.max_effort, high = limits_.max_effort;
    if (jh_.getPosition() < lowest() || jh_.getVelocity() < -limits_.max_velocity)
      low = 0.0;
    if (jh_.getPosition() > highest() || jh_.getVelocity() > limits_.max_velocity)
      high = 0.0;
    jh_.setCommand(internal::saturate(jh_.getCommand(), low, high));
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
    : internal::LimitHandle(jh, limits)
    , soft_limits_(soft_limits)
  {
    internal::need(limits.has_velocity_limits, jh, "velocity");
    internal::need(limits.has_effort_limits, jh, "effort");
  }

  void enforceLimits(const ros::Duration& /*period*/)
  {
    double low, high;
    soft_velocities(soft_limits_, jh_.getPosition(), low, high);
    const double limit = limits_.max_effort, velocity = jh_.getVelocity();
    jh_.setCommand(internal::saturate(jh_.getCommand(),
                                      internal::saturate(-soft_limits_.k_velocity * (velocity - low), -limit, limit),
                                      internal::saturate(-soft_limits_.k_velocity * (velocity - high), -limit, limit)));
  }

private:
  SoftJointLimits soft_limits_;
};

/// Keeps velocities within the limit, and their steps within the acceleration limit if there is one.
class VelocityJointSaturationHandle : public internal::LimitHandle
{
public:
  VelocityJointSaturationHandle() = default;

  /// \throws JointLimitsInterfaceException there are no velocity limits
  VelocityJointSaturationHandle(const hardware_interface::JointHandle& jh, const JointLimits& limits)
    : internal::LimitHandle(jh, limits)
  {
    internal::need(limits.has_velocity_limits, jh, "velocity");
  }

  void enforceLimits(const ros::Duration& period)
  {
    double low = -limits_.max_velocity, high = limits_.max_velocity;
    if (limits_.has_acceleration_limits)
    {
      const double step = limits_.max_acceleration * period.toSec();
      low = std::max(previous_ - step, low);
      high = std::min(previous_ + step, high);
    }
    previous_ = internal::saturate(jh_.getCommand(), low, high);
    jh_.setCommand(previous_);
  }

private:
  double previous_ = 0.0;
};

/// Slows a velocity-commanded joint down on its way to the soft position limits.
class VelocityJointSoftLimitsHandle : public internal::LimitHandle
{
public:
  VelocityJointSoftLimitsHandle() = default;
  VelocityJointSoftLimitsHandle(const hardware_interface::JointHandle& jh, const JointLimits& limits,
                                const SoftJointLimits& soft_limits)
    : internal::LimitHandle(jh, limits)
    , soft_limits_(soft_limits)
  {
  }

  void enforceLimits(const ros::Duration& period)
  {
    double low, high;
    soft_velocities(soft_limits_, jh_.getPosition(), low, high);
    if (limits_.has_acceleration_limits)
    {
      const double step = limits_.max_acceleration * period.toSec(), velocity = jh_.getVelocity();
      low = std::max(velocity - step, low);
      high = std::min(velocity + step, high);
    }
    jh_.setCommand(internal::saturate(jh_.getCommand(), low, high));
  }

  void reset() {}

private:
  SoftJointLimits soft_limits_;
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
};

class PositionJointSaturationInterface : public JointLimitsInterface<PositionJointSaturationHandle>
{
public:
  void reset()
  {
    for (auto& entry : resource_map_)
      entry.second.reset();
  }
};

class PositionJointSoftLimitsInterface : public JointLimitsInterface<PositionJointSoftLimitsHandle>
{
public:
  void reset()
  {
    for (auto& entry : resource_map_)
      entry.second.reset();
  }
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
