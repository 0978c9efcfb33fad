// A value behind a lock. Put a shared pointer in, so that copying it takes no time.
#pragma once

#include <mutex>

namespace realtime_tools
{

template <class T>
class RealtimeBox
{
public:
  RealtimeBox(const T& initial = T()) : thing_(initial) {}

  void set(const T& value)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    thing_ = value;
  }

  void get(T& ref)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ref = thing_;
  }

private:
  T thing_;
  std::mutex mutex_;
};

}  // namespace realtime_tools
