// Smooths one signal.
#pragma once

namespace moveit_servo
{
// A Butterworth low-pass filter of first order with gain 1 at rest. With the sampling period T its corner lies at
// arccot(coefficient) * 2 / T rad/s: the larger the coefficient, the smoother and the later.
class LowPassFilter
{
public:
  explicit LowPassFilter(double low_pass_filter_coeff);
  double filter(double new_measurement);
  // As if the signal had been this value for ever.
  void reset(double data);

private:
  double coefficient_;
  double last_measurement_ = 0.0;
  double last_output_ = 0.0;
};
}  // namespace moveit_servo
