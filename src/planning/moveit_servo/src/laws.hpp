// What moveit_servo computes, without ROS: joints as arrays, lengths in m, angles in rad, times in s.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Core>
#include <Eigen/SVD>

namespace moveit_servo
{
namespace laws
{
// Singular values that are this much smaller than the largest count as zero.
constexpr double RANK = 1e-9;
// Beyond this condition number rounding decides on which side of the singularity the arm is.
constexpr double ON_THE_SINGULARITY = 1e5;
// How long a joint may take to follow. The commanded position leads the measured one by no more than this time's way, so that an
// arm that is held does not jump when it is let go.
constexpr double LONGEST_LAG = 0.5;

// 1 at the threshold and beyond, 0.001 where things touch, exponentially between.
inline double thresholdScale(double distance, double threshold)
{
  if (distance >= threshold)
    return 1.0;
  return threshold > 0.0 ? std::exp(-std::log(0.001) / threshold * (distance - threshold)) : 0.001;
}

// 0 where the arm could not stop in time, or is too near and not on its way out; else 1. rate: of the distance, m/s.
inline double stopDistanceScale(double distance, double rate, double nearest_allowed, double time_to_stop)
{
  if (distance < nearest_allowed && rate <= 0.0)
    return 0.0;
  return rate < -1e-6 && distance / -rate < time_to_stop ? 0.0 : 1.0;
}

// How long the slowest joint takes to stand: without end for one that moves and has no limit (0) of its deceleration.
inline double worstCaseStopTime(const Eigen::ArrayXd& velocities, const Eigen::ArrayXd& decelerations)
{
  double longest = 0.0;
  for (Eigen::Index i = 0; i < velocities.size(); ++i)
    if (velocities[i] != 0.0)
      longest = std::max(longest, std::abs(velocities[i]) / decelerations[i]);
  return longest;
}

// The largest of 0 to 1 that brings all velocities between their limits.
inline double velocityLimitScale(const Eigen::ArrayXd& velocities, const Eigen::ArrayXd& lower, const Eigen::ArrayXd& upper)
{
  double scale = 1.0;
  for (Eigen::Index i = 0; i < velocities.size(); ++i)
    if (velocities[i] != 0.0)
      scale = std::min(scale, std::min(std::max(velocities[i], lower[i]), upper[i]) / velocities[i]);
  return std::max(scale, 0.0);
}

// Of a motion towards a singularity: 1 up to the lower threshold, 0 from the upper one, a straight line between.
inline double singularityScale(double condition, double lower, double upper)
{
  if (condition <= lower)
    return 1.0;
  return condition >= upper ? 0.0 : 1.0 - (condition - lower) / (upper - lower);
}

inline double condition(const Eigen::JacobiSVD<Eigen::MatrixXd>& svd)
{
  const auto& values = svd.singularValues();
  const double smallest = values[values.size() - 1];
  return smallest > 0.0 ? values[0] / smallest : std::numeric_limits<double>::infinity();
}

// Where to go next: from the last command, or, where the joints are further behind than LONGEST_LAG at this speed, from there.
inline Eigen::ArrayXd nextPositions(const Eigen::ArrayXd& commanded, const Eigen::ArrayXd& measured,
                                    const Eigen::ArrayXd& delta, double period)
{
  const double lead = delta.abs().maxCoeff() / period * LONGEST_LAG;
  if (lead == 0.0)
    return commanded;
  return commanded.max(measured - lead).min(measured + lead) + delta;
}
}  // namespace laws
}  // namespace moveit_servo
