// A value that any thread writes and a control loop reads without waiting.
#pragma once

#include <memory>
#include <mutex>

namespace realtime_tools
{

/// Two copies of T: the loop has one, the writers the other, and the loop exchanges them when there is something new.
template <class T>
class RealtimeBuffer
{
public:
  RealtimeBuffer() : loops_(new T()), writers_(new T()) {}
  RealtimeBuffer(const T& data) : loops_(new T(data)), writers_(new T(data)) {}

  RealtimeBuffer(const RealtimeBuffer& source) : loops_(new T()), writers_(new T()) { writeFromNonRT(*source.readFromNonRT()); }

  RealtimeBuffer& operator=(const RealtimeBuffer& source)
  {
    if (this != &source)
      writeFromNonRT(*source.readFromNonRT());
    return *this;
  }

  /// For the loop: the newest value, or the one before while a writer is at work. The pointer is good until the next call.
  T* readFromRT()
  {
    std::unique_lock<std::mutex> lock(mutex_, std::try_to_lock);
    if (lock.owns_lock() && fresh_)
    {
      loops_.swap(writers_);
      fresh_ = false;
    }
    return loops_.get();
  }

  /// For other threads: the newest value. To be changed only by writeFromNonRT().
  T* readFromNonRT() const
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    return fresh_ ? writers_.get() : loops_.get();
  }

  /// For other threads.
  void writeFromNonRT(const T& data)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    *writers_ = data;
    fresh_ = true;
  }

  /// While nobody else has the buffer: both copies.
  void initRT(const T& data)
  {
    *writers_ = data;
    *loops_ = data;
  }

private:
  std::unique_ptr<T> loops_, writers_;
  bool fresh_ = false;
  mutable std::mutex mutex_;
};

}  // namespace realtime_tools
