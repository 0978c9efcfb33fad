// The fan of rays that SDF's <ray> (<lidar>) describes: where its rays point, what they meet, and what is told of them; nothing here knows
// ROS or SDF. Angles in rad, lengths in m, directions in the sensor's frame (x ahead, z up).
//
//   <samples> rays stand evenly from min_angle to max_angle, both included; rows from the lowest pitch, in a row from the smallest yaw.
//   A single one looks straight ahead, whatever the angles are.
//   Each row and column tells floor(samples * resolution) values, again evenly from end to end. A value between rays is linear in their
//   four ranges, within [min, max], and the mean of their four intensities.
//   Told are ranges of at least max as +inf and those up to min as -inf (REP 117).
//
// Source: what Gazebo Classic 11's RaySensor and MultiRayShape do.
// Faces: gazebo/sensors/RaySensor.hh in C++, gazebo_plugins.sensors.laser in Python. Reads the scene: not while it steps.
#pragma once
#include <cstdint>
#include <vector>

#include "math.hpp"

namespace ode_sim {

struct Scene;

struct RayScan {
  int samples = 1;
  double resolution = 1, min_angle = 0, max_angle = 0;

  int count() const;                                                                         // of values told
  double step() const { return count() > 1 ? (max_angle - min_angle) / (count() - 1) : 0; }  // between values told
};

class RayFan {
 public:
  static constexpr double kMostRays = 1e6;

  // :raises std::invalid_argument: limits that are none, or too many rays or values.
  RayFan(const RayScan& horizontal, const RayScan& vertical, double min, double max);

  size_t rays() const { return directions_.size(); }
  size_t values() const { return static_cast<size_t>(horizontal_.count()) * vertical_.count(); }
  const RayScan& horizontal() const { return horizontal_; }
  const RayScan& vertical() const { return vertical_; }
  double min() const { return min_; }
  double max() const { return max_; }
  const std::vector<Vec3>& directions() const { return directions_; }  // of rays(), unit vectors
  std::vector<Vec3> told_directions() const;                           // of values(), unit vectors

  // :param X_WS: of the sensor in the world.
  // :param housing: ids of the shapes that it is built into.
  // :param ranges: of rays(), within [min, max]; max where nothing is met.
  // :param hits: of rays(), the id of the shape that was met, -1 for none.
  void cast(const Scene& scene, const Pose& X_WS, const std::vector<int>& housing, double* ranges, int32_t* hits) const;

  bool one_to_one() const { return rays() == values(); }
  // From rays() numbers to values() of them.
  void between(const double* ranges, double* told) const;
  void mean(const double* intensities, double* told) const;
  // What is told of a range within [min, max]: itself, or an infinity. Noise is for those that are themselves, and keeps within the limits.
  double told(double range) const;

 private:
  template <typename Blend>
  void blend(const double* rays, double* told, const Blend& of_four) const;

  RayScan horizontal_, vertical_;
  double min_, max_;
  std::vector<Vec3> directions_;
};

}  // namespace ode_sim
