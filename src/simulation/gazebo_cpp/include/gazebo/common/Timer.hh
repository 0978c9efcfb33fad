#pragma once
#include <gazebo/common/Time.hh>

namespace gazebo
{
namespace common
{

/// A stop watch of wall time.
class GAZEBO_VISIBLE Timer
{
public:
  Timer() = default;
  explicit Timer(const Time& maximum, bool countdown = false) : maximum_(maximum), down_(countdown) {}
  virtual ~Timer() = default;
  virtual void Start() { start_ = Time::GetWallTime(), running_ = true; }
  virtual void Stop() { stop_ = Time::GetWallTime(), running_ = false; }
  virtual void Reset() { start_ = stop_ = Time::GetWallTime(), running_ = false; }
  bool GetRunning() const { return running_; }
  Time GetElapsed() const
  {
    const Time passed = (running_ ? Time(Time::GetWallTime()) : stop_) - start_;
    return !down_ ? passed : passed > maximum_ ? Time::Zero : maximum_ - passed;
  }

private:
  Time start_, stop_, maximum_;
  bool running_ = false, down_ = false;
};

}  // namespace common
}  // namespace gazebo
