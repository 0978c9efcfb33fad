// Publishing from a control loop: the loop fills a message, a thread sends it.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include <ros/node_handle.h>
#include <ros/publisher.h>

namespace realtime_tools
{

/// In the loop:
///
///     if (publisher.trylock()) { publisher.msg_.data = 1.0; publisher.unlockAndPublish(); }
///
/// trylock() fails while the last message is being copied: that cycle's message is left out, and the loop never waits.
template <class Msg>
class RealtimePublisher
{
public:
  /// Belongs to whoever has the lock.
  Msg msg_;

  RealtimePublisher(const ros::NodeHandle& node, const std::string& topic, int queue_size, bool latched = false)
  {
    init(node, topic, queue_size, latched);
  }

  /// Nothing is published before init().
  RealtimePublisher() = default;

  ~RealtimePublisher()
  {
    stop();
    if (thread_.joinable())
      thread_.join();
    publisher_.shutdown();
  }

  RealtimePublisher(const RealtimePublisher&) = delete;
  RealtimePublisher& operator=(const RealtimePublisher&) = delete;

  /// Advertise, and start the thread. To be called once, not in the loop.
  void init(const ros::NodeHandle& node, const std::string& topic, int queue_size, bool latched = false)
  {
    node_ = node;
    publisher_ = node_.advertise<Msg>(topic, queue_size, latched);
    running_ = true;
    turn_ = Turn::LOOP;
    thread_ = std::thread(&RealtimePublisher::publishingLoop, this);
  }

  /// Send nothing more.
  void stop()
  {
    {
      const std::lock_guard<std::mutex> lock(turn_mutex_);
      running_ = false;
    }
    filled_.notify_one();
  }

  /// \return true: msg_ is the caller's, until unlockAndPublish() or unlock(). Never waits.
  bool trylock()
  {
    if (!message_mutex_.try_lock())
      return false;
    std::unique_lock<std::mutex> turn(turn_mutex_, std::try_to_lock);
    if (turn.owns_lock() && turn_ == Turn::LOOP)
      return true;
    message_mutex_.unlock();
    return false;
  }

  /// Hand the message over to the thread.
  void unlockAndPublish()
  {
    message_mutex_.unlock();
    {
      const std::lock_guard<std::mutex> lock(turn_mutex_);  // held by the thread for an instant only
      turn_ = Turn::THREAD;
    }
    filled_.notify_one();
  }

  /// Waits for msg_: not for the loop.
  void lock() { message_mutex_.lock(); }
  void unlock() { message_mutex_.unlock(); }

private:
  enum class Turn
  {
    NOBODY,
    LOOP,
    THREAD
  };

  void publishingLoop()
  {
    while (true)
    {
      {
        std::unique_lock<std::mutex> lock(turn_mutex_);
        filled_.wait(lock, [this] { return turn_ == Turn::THREAD || !running_; });
        if (!running_)
          return;
      }
      Msg outgoing;
      {
        const std::lock_guard<std::mutex> lock(message_mutex_);
        outgoing = msg_;
      }
      {
        const std::lock_guard<std::mutex> lock(turn_mutex_);
        turn_ = Turn::LOOP;
      }
      publisher_.publish(outgoing);
    }
  }

  ros::NodeHandle node_;
  ros::Publisher publisher_;
  std::mutex message_mutex_;  // of msg_
  std::mutex turn_mutex_;     // of turn_ and running_
  std::condition_variable filled_;
  Turn turn_ = Turn::NOBODY;
  bool running_ = false;
  std::thread thread_;
};

template <class Msg>
using RealtimePublisherSharedPtr = std::shared_ptr<RealtimePublisher<Msg>>;

}  // namespace realtime_tools
