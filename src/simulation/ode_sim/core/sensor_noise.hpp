// The error of a sensor that SDF's <noise> describes, of types gaussian and gaussian_quantized alike; nothing here knows ROS or SDF. What is
// drawn is handed in, so that whoever calls keeps the generator: normal, of the distribution N(0, 1), and uniform, of [0, 1).
//
//   measured = value + bias + mean + stddev * normal, then rounded to a multiple of precision where that is more than 1e-6
//   bias     = +-(bias_mean + bias_stddev * normal), drawn once, with either sign equally likely
//   bias'    = exp(-dt / T) bias + s sqrt(-T / 2 expm1(-2 dt / T)) normal: a Gauss-Markov process of first order, s
//              <dynamic_bias_stddev> (unit of the value / sqrt(s)), T <dynamic_bias_correlation_time> (s), dt since the last value (s)
//
// Source: what Gazebo Classic 11's GaussianNoiseModel does; the process is that of ETH's IMU noise model (kalibr).
// Faces: gazebo/sensors/Noise.hh in C++, gazebo_plugins.sensors.noise in Python. Pure functions: any thread may call them.
#pragma once
#include <cmath>

namespace ode_sim::noise {

constexpr double kFinest = 1e-6;  // a precision up to which nothing is rounded

inline double drawn_bias(double mean, double stddev, double normal, double uniform) {
  const double bias = mean + stddev * normal;
  return uniform < 0.5 ? -bias : bias;
}

inline bool wanders(double stddev, double time, double dt) { return stddev > 0 && time > 0 && dt > 0; }

/// The bias dt later. Only where it wanders.
inline double wandered_bias(double bias, double stddev, double time, double dt, double normal) {
  const double sigma = stddev * std::sqrt(-time / 2 * std::expm1(-2 * dt / time));
  return std::exp(-dt / time) * bias + sigma * normal;
}

inline double measured(double value, double bias, double mean, double stddev, double precision, double normal) {
  const double noisy = value + (bias + mean) + stddev * normal;
  return precision > kFinest ? std::round(noisy / precision) * precision : noisy;
}

}  // namespace ode_sim::noise
