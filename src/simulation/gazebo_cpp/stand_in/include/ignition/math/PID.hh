#pragma once
#include <chrono>

#include <ignition/math/Helpers.hh>

namespace ignition
{
namespace math
{
inline namespace v6
{

/// Error is what is less what should be; the command goes against it. A maximum below its minimum is no limit.
class IGNITION_MATH_VISIBLE PID
{
public:
  PID(double p = 0.0, double i = 0.0, double d = 0.0, double imax = -1.0, double imin = 0.0, double cmdMax = -1.0,
      double cmdMin = 0.0, double cmdOffset = 0.0)
  {
    Init(p, i, d, imax, imin, cmdMax, cmdMin, cmdOffset);
  }
  void Init(double p = 0.0, double i = 0.0, double d = 0.0, double imax = -1.0, double imin = 0.0, double cmdMax = -1.0,
            double cmdMin = 0.0, double cmdOffset = 0.0)
  {
    p_ = p, i_ = i, d_ = d, imax_ = imax, imin_ = imin, cmd_max_ = cmdMax, cmd_min_ = cmdMin, cmd_offset_ = cmdOffset;
    Reset();
  }
  void SetPGain(double v) { p_ = v; }
  void SetIGain(double v) { i_ = v; }
  void SetDGain(double v) { d_ = v; }
  void SetIMax(double v) { imax_ = v; }
  void SetIMin(double v) { imin_ = v; }
  void SetCmdMax(double v) { cmd_max_ = v; }
  void SetCmdMin(double v) { cmd_min_ = v; }
  void SetCmdOffset(double v) { cmd_offset_ = v; }
  double PGain() const { return p_; }
  double IGain() const { return i_; }
  double DGain() const { return d_; }
  double IMax() const { return imax_; }
  double IMin() const { return imin_; }
  double CmdMax() const { return cmd_max_; }
  double CmdMin() const { return cmd_min_; }
  double CmdOffset() const { return cmd_offset_; }
  double Update(double error, const std::chrono::duration<double>& dt);
  void SetCmd(double cmd) { cmd_ = cmd; }
  double Cmd() const { return cmd_; }
  void Errors(double& pe, double& ie, double& de) const { pe = p_error_, ie = i_error_, de = d_error_; }
  void Reset() { p_error_ = last_error_ = i_error_ = d_error_ = cmd_ = 0; }

private:
  double p_ = 0, i_ = 0, d_ = 0, imax_ = -1, imin_ = 0, cmd_max_ = -1, cmd_min_ = 0, cmd_offset_ = 0;
  double p_error_ = 0, last_error_ = 0, i_error_ = 0, d_error_ = 0, cmd_ = 0;
};

}  // namespace v6
}  // namespace math
}  // namespace ignition
