// A sine whose frequency grows exponentially.
#pragma once

#include <cmath>

#include <ros/duration.h>

namespace control_toolbox
{

class SineSweep
{
public:
  /// \param start_freq, end_freq Hz \param duration s \return false: start > end, or something is negative
  bool init(double start_freq, double end_freq, double duration, double amplitude)
  {
    if (start_freq > end_freq || duration < 0.0 || amplitude < 0.0)
      return false;
    amplitude_ = amplitude;
    duration_ = ros::Duration(duration);
    omega_ = 2.0 * M_PI * start_freq;
    growth_ = start_freq > 0.0 ? std::log(end_freq / start_freq) / duration : 0.0;
    return true;
  }

  /// \param dt since the sweep began \return 0 after its end
  double update(ros::Duration dt)
  {
    if (dt > duration_)
      return 0.0;
    const double time = dt.toSec();
    return amplitude_ * std::sin(omega_ * (growth_ > 0.0 ? std::expm1(growth_ * time) / growth_ : time));
  }

private:
  double amplitude_ = 0.0;
  ros::Duration duration_;
  double omega_ = 0.0, growth_ = 0.0;
};

}  // namespace control_toolbox
