// Where the limits of a joint come from: its description, and parameters on top of it. All faces stand on it: joint_limits_urdf.h and
// joint_limits_rosparam.h, and limits.py. Without ROS. Units: rad or m and their derivatives, N m or N.
//
//   <limit>                  velocity and effort always bound; lower and upper those of revolute and prismatic joints alone; a continuous
//                            joint turns endlessly; an acceleration of before no longer bounds, a jerk still does
//   has_<kind>_limits: true  counts where every value of that kind is there beside it and can be kept: none is NaN, no maximum is minus
//                            infinity, no minimum infinity; false takes the limit away, and leaves its values as they were
//   angle_wraparound         counts beside has_position_limits: false
//   has_soft_limits: true    counts where all four values are there, none NaN
//
// Source: ros_control's joint_limits_interface 0.20 (joint_limits_urdf.h, joint_limits_rosparam.h). It differs in NaN and in a limit that
// nothing can be kept within, which are taken there.
//
// Threads: for set-up; parameters are copied, memory may be taken.
#pragma once

#include <cmath>
#include <limits>
#include <string>

#include <joint_limits_interface/joint_limits.h>

namespace joint_limits_interface
{

/// \p limits with what <limit> says.
/// \param bounded: a revolute or prismatic joint
/// \param endless: a continuous one
inline void apply_description(bool bounded, bool endless, double lower, double upper, double velocity, double effort,
                              JointLimits& limits)
{
  limits.has_position_limits = bounded;
  if (bounded)
  {
    limits.min_position = lower;
    limits.max_position = upper;
  }
  limits.angle_wraparound = endless;
  limits.has_velocity_limits = true;
  limits.max_velocity = velocity;
  limits.has_acceleration_limits = false;
  limits.has_effort_limits = true;
  limits.max_effort = effort;
}

namespace internal
{

struct Bound
{
  const char* name = nullptr;
  double* value = nullptr;
  double never = 0.0;  ///< The infinity that nothing can be kept within.
};

/// One kind of has_<kind>_limits. A second bound without a name is none.
template <class Values>
void apply_kind(const Values& values, const std::string& kind, bool& flag, const Bound& first, const Bound& second = Bound())
{
  bool has = false;
  if (!values.flag("has_" + kind + "_limits", has))
    return;
  if (!has)
  {
    flag = false;
    return;
  }
  double read[2] = {};
  const Bound* const bounds[2] = { &first, &second };
  for (int i = 0; i < 2; ++i)
    if (bounds[i]->name && (!values.number(bounds[i]->name, read[i]) || std::isnan(read[i]) || read[i] == bounds[i]->never))
      return;
  flag = true;
  for (int i = 0; i < 2; ++i)
    if (bounds[i]->name)
      *bounds[i]->value = read[i];
}

}  // namespace internal

/// \p limits with what the parameters of <namespace>/joint_limits/<joint> say.
/// \tparam Values: `bool flag(const std::string& name, bool&) const` and `bool number(const std::string& name, double&) const`, which
/// are false, and change nothing, where no such value is there
template <class Values>
void apply_parameters(const Values& values, JointLimits& limits)
{
  constexpr double inf = std::numeric_limits<double>::infinity();
  using internal::apply_kind;
  apply_kind(values, "position", limits.has_position_limits, { "min_position", &limits.min_position, inf },
             { "max_position", &limits.max_position, -inf });
  apply_kind(values, "velocity", limits.has_velocity_limits, { "max_velocity", &limits.max_velocity, -inf });
  apply_kind(values, "acceleration", limits.has_acceleration_limits, { "max_acceleration", &limits.max_acceleration, -inf });
  apply_kind(values, "jerk", limits.has_jerk_limits, { "max_jerk", &limits.max_jerk, -inf });
  apply_kind(values, "effort", limits.has_effort_limits, { "max_effort", &limits.max_effort, -inf });
  bool positions = true;
  if (values.flag("has_position_limits", positions) && !positions)
    values.flag("angle_wraparound", limits.angle_wraparound);
}

/// \return false: no has_soft_limits, or not all four values; nothing was changed
template <class Values>
bool apply_soft_parameters(const Values& values, SoftJointLimits& limits)
{
  bool has = false;
  SoftJointLimits read;
  const auto number = [&values](const char* name, double& value) { return values.number(name, value) && !std::isnan(value); };
  if (!values.flag("has_soft_limits", has) || !has || !number("soft_lower_limit", read.min_position) ||
      !number("soft_upper_limit", read.max_position) || !number("k_position", read.k_position) ||
      !number("k_velocity", read.k_velocity))
    return false;
  limits = read;
  return true;
}

}  // namespace joint_limits_interface
