// Paths of joint values into trajectories: when to be where, how fast.
#pragma once

#include <vector>

#include "motion/types.hpp"

namespace motion
{
struct TimingLimits
{
  std::vector<double> velocity, acceleration;  // by variable, above 0, scaled already
};

struct TimedPath
{
  std::vector<double> times;  // s, from 0
  std::vector<std::vector<double>> positions, velocities, accelerations;
};

using Rows = std::vector<std::vector<double>>;

// Iterative parabolic: the way points stay, segments are stretched until velocities and accelerations fit.
TimedPath iterativeParabolic(const Rows& points, const TimingLimits& limits);

// Iterative spline: as before, with velocities and accelerations of a cubic spline through the way points.
TimedPath iterativeSpline(const Rows& points, const TimingLimits& limits);

// Time-optimal along the way with its corners rounded by circles (Kunz and Stilman 2012); new points every
// `resample_dt` s and the end. `path_tolerance`: how far a corner may be cut (norm over the joints).
TimedPath timeOptimal(const Rows& points, const TimingLimits& limits, double path_tolerance, double resample_dt,
                      double min_angle_change);
}  // namespace motion
