#include <moveit_servo/low_pass_filter.h>

namespace moveit_servo
{
LowPassFilter::LowPassFilter(double low_pass_filter_coeff) : coefficient_(low_pass_filter_coeff) {}

double LowPassFilter::filter(double new_measurement)
{
  // (1 + c s) y = x with s = (1 - 1/z) / (1 + 1/z)
  last_output_ = (new_measurement + last_measurement_ - (1.0 - coefficient_) * last_output_) / (1.0 + coefficient_);
  last_measurement_ = new_measurement;
  return last_output_;
}

void LowPassFilter::reset(double data)
{
  last_measurement_ = data;
  last_output_ = data;
}
}  // namespace moveit_servo
