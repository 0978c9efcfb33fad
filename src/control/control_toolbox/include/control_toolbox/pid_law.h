// The law of the PID, on which control_toolbox::Pid (pid.h) and Python's Pid (pid.py) stand. Without ROS.
//
//   command = p e + I + d e'       e = target - measured, in any unit; dt in s
//   E = sum of e dt, e' = (e - e of the last step) / dt
//   I = clamp(i E, i_min, i_max); with antiwindup E itself is put between i_min / i and i_max / i, and I = i E
//
// Before the first step the last error counts as 0; after a reset with a derivative the first step takes that. Where the bounds of I
// lie the wrong way round the lower one is asked first. i_min = i_max = 0 switches the integral part off.
//
// - dt 0, or an error or derivative that is not finite (also a quotient that overflows): the command is 0 and nothing is integrated.
// - dt below 0: E runs back, and the derivative is that of the step before, as is the last error.
//
// Source: control_toolbox 1.19 (noetic), value by value. It differs where a sum overflows, which there is NaN for good: the command
// is 0 then, and an E that is no number begins at 0 again.
//
// Threads: everything may be called from the control loop; nothing waits, allocates or throws. One law belongs to one thread; gains
// are an argument, so that whoever calls hands over one consistent set.
#pragma once

#include <algorithm>
#include <cmath>

namespace control_toolbox
{

/// i_max and i_min bound the integral term, in units of the command.
struct PidGains
{
  double p;
  double i;
  double d;
  double i_max;
  double i_min;
  bool antiwindup;
};

class PidLaw
{
public:
  /// Forget the past: the last error counts as 0.
  void reset() { reset(0.0, 0.0, true); }

  /// Forget the past. \param derivative that the first step takes, unless the last error counts as 0
  void reset(double derivative, double integral, bool last_error_counts = false)
  {
    last_error_ = p_error_ = i_term_ = command_ = 0.0;
    i_error_ = integral;
    d_error_ = derivative;
    last_error_counts_ = last_error_counts;
  }

  /// One step, with the difference quotient. \return whether it counted; command() is as before where it did not
  bool step(const PidGains& gains, double error, double dt)
  {
    if (dt == 0.0 || !std::isfinite(dt) || !std::isfinite(error))
      return false;
    double derivative = d_error_;
    if (dt > 0.0)
    {
      if (last_error_counts_)
        derivative = (error - last_error_) / dt;
      last_error_ = error;
      last_error_counts_ = true;
    }
    return step(gains, error, derivative, dt);
  }

  /// The same with the derivative of the error.
  bool step(const PidGains& gains, double error, double derivative, double dt)
  {
    p_error_ = error;
    d_error_ = derivative;
    if (dt == 0.0 || !std::isfinite(dt) || !std::isfinite(error) || !std::isfinite(derivative))
      return false;
    i_error_ += dt * error;
    if (gains.antiwindup && gains.i != 0.0)
    {
      const double one = gains.i_min / gains.i, other = gains.i_max / gains.i;
      i_error_ = clamp(i_error_, std::min(one, other), std::max(one, other));
    }
    i_term_ = gains.i * i_error_;
    if (!gains.antiwindup)
      i_term_ = clamp(i_term_, gains.i_min, gains.i_max);
    command_ = gains.p * p_error_ + i_term_ + gains.d * d_error_;
    if (!std::isfinite(command_))
    {
      if (!std::isfinite(i_error_))
        i_error_ = 0.0;
      command_ = 0.0;
    }
    return true;
  }

  double p_error() const { return p_error_; }
  double i_error() const { return i_error_; }
  double d_error() const { return d_error_; }
  double i_term() const { return i_term_; }
  double command() const { return command_; }
  void set_command(double command) { command_ = command; }

private:
  static double clamp(double value, double low, double high) { return value < low ? low : high < value ? high : value; }

  double last_error_ = 0.0;
  bool last_error_counts_ = true;
  double p_error_ = 0.0, i_error_ = 0.0, d_error_ = 0.0, i_term_ = 0.0, command_ = 0.0;
};

}  // namespace control_toolbox
