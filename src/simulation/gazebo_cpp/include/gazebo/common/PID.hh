#pragma once
#include <gazebo/common/Time.hh>

namespace gazebo
{
namespace common
{

/// Error is what is less what should be; the command goes against it.
class GAZEBO_VISIBLE PID
{
public:
  PID(double p = 0.0, double i = 0.0, double d = 0.0, double imax = 0.0, double imin = 0.0, double cmdMax = -1.0,
      double cmdMin = 0.0)
  {
    Init(p, i, d, imax, imin, cmdMax, cmdMin);
  }
  virtual ~PID() = default;
  void Init(double p = 0.0, double i = 0.0, double d = 0.0, double imax = 0.0, double imin = 0.0, double cmdMax = -1.0,
            double cmdMin = 0.0);
  void SetPGain(double p) { p_ = p; }
  void SetIGain(double i) { i_ = i; }
  void SetDGain(double d) { d_ = d; }
  void SetIMax(double i) { imax_ = i; }
  void SetIMin(double i) { imin_ = i; }
  void SetCmdMax(double c) { cmd_max_ = c; }
  void SetCmdMin(double c) { cmd_min_ = c; }
  double GetPGain() const { return p_; }
  double GetIGain() const { return i_; }
  double GetDGain() const { return d_; }
  double GetIMax() const { return imax_; }
  double GetIMin() const { return imin_; }
  double GetCmdMax() const { return cmd_max_; }
  double GetCmdMin() const { return cmd_min_; }
  double Update(double error, Time dt);
  void SetCmd(double cmd) { cmd_ = cmd; }
  double GetCmd() { return cmd_; }
  void GetErrors(double& pe, double& ie, double& de) { pe = p_error_, ie = i_error_, de = d_error_; }
  void Reset();

private:
  double p_ = 0, i_ = 0, d_ = 0, imax_ = 0, imin_ = 0, cmd_max_ = -1, cmd_min_ = 0;
  double p_error_ = 0, last_p_error_ = 0, i_error_ = 0, d_error_ = 0, cmd_ = 0;
};

}  // namespace common
}  // namespace gazebo
