// Gaussian noise.
#pragma once

#include <random>

#include <ros/console.h>

namespace control_toolbox
{

/// Noise of standard deviation ``amplitude``; the same seed gives the same noise.
class Dither
{
public:
  /// \return false: the amplitude is negative
  bool init(const double& amplitude, const double& seed)
  {
    if (amplitude < 0.0)
    {
      ROS_ERROR("Dither amplitude not set properly. Amplitude must be >0.");
      return false;
    }
    amplitude_ = amplitude;
    generator_.seed(static_cast<unsigned int>(seed));
    normal_.reset();
    return true;
  }

  double update() { return amplitude_ * normal_(generator_); }

  static double generateRandomSeed() { return static_cast<double>(std::random_device()()); }

private:
  double amplitude_ = 0.0;
  std::mt19937 generator_;
  std::normal_distribution<double> normal_;
};

}  // namespace control_toolbox
