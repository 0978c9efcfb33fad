// The thread that action clients get their news in.
#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

#include <ros/callback_queue.h>
#include <ros/publisher.h>

namespace moveit {
namespace planning_interface {

/// A callback queue with a thread of its own, so that a program without a spinner gets its results, too. Nothing is called
/// while somebody holds the lock: a goal is sent under it, as an answer that comes before sendGoal() has returned would be lost.
class ActionQueue : public ros::CallbackQueue {
 public:
  ActionQueue() : thread_([this] { run(); }) {}

  ~ActionQueue() override {
    {
      const std::lock_guard<std::recursive_mutex> lock(mutex_);
      done_ = true;
    }
    news_.notify_all();
    thread_.join();
  }

  void addCallback(const ros::CallbackInterfacePtr& callback, uint64_t removal_id = 0) override {
    ros::CallbackQueue::addCallback(callback, removal_id);
    news_.notify_all();
  }

  std::unique_lock<std::recursive_mutex> lock() { return std::unique_lock<std::recursive_mutex>(mutex_); }

 private:
  void run() {
    std::unique_lock<std::recursive_mutex> lock(mutex_);
    while (!done_) {
      // Not for ever: news that come between the look and the wait would be slept through.
      news_.wait_for(lock, std::chrono::milliseconds(isEmpty() ? 10 : 1));
      callAvailable();
    }
  }

  std::recursive_mutex mutex_;
  std::condition_variable_any news_;
  bool done_ = false;
  std::thread thread_;  // the last one: it uses the others
};

/// A message that is published while nobody has connected yet is lost: give move_group a moment, after the start. To a publisher
/// that was closed and made again, rospy comes back half a second, one and two seconds after it has noticed.
inline void waitForSubscriber(const ros::Publisher& publisher, double patience = 5.0) {
  for (const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(patience);
       publisher.getNumSubscribers() == 0 && ros::ok() && ros::WallTime::now() < end;)
    ros::WallDuration(0.005).sleep();
}

}  // namespace planning_interface
}  // namespace moveit
