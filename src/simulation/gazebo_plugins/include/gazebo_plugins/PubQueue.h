// Publishing from the physics thread without waiting for the wire: messages are queued, and a thread of their own publishes them.
#pragma once
#include <deque>
#include <functional>
#include <utility>
#include <vector>

#include <boost/shared_ptr.hpp>
#include <boost/thread/condition_variable.hpp>
#include <boost/thread/mutex.hpp>
#include <boost/thread/thread.hpp>
#include <ros/ros.h>

template <class T>
class PubMessagePair
{
public:
  PubMessagePair(T& message, ros::Publisher& publisher) : msg_(message), pub_(publisher) {}
  T msg_;
  ros::Publisher pub_;
};

/// The queue of one type of message. Made by PubMultiQueue::addPub().
template <class T>
class PubQueue
{
public:
  typedef boost::shared_ptr<std::deque<boost::shared_ptr<PubMessagePair<T>>>> QueuePtr;
  typedef boost::shared_ptr<PubQueue<T>> Ptr;

  PubQueue(QueuePtr queue, boost::shared_ptr<boost::mutex> lock, std::function<void()> notify)
    : queue_(std::move(queue))
    , lock_(std::move(lock))
    , notify_(std::move(notify))
  {
  }

  void push(T& message, ros::Publisher& publisher)
  {
    const boost::shared_ptr<PubMessagePair<T>> pair(new PubMessagePair<T>(message, publisher));
    {
      const boost::mutex::scoped_lock lock(*lock_);
      queue_->push_back(pair);
    }
    notify_();
  }

  void pop(std::vector<boost::shared_ptr<PubMessagePair<T>>>& all)
  {
    const boost::mutex::scoped_lock lock(*lock_);
    all.assign(queue_->begin(), queue_->end());
    queue_->clear();
  }

private:
  QueuePtr queue_;
  boost::shared_ptr<boost::mutex> lock_;
  std::function<void()> notify_;
};

/// Queues of any types, and the thread that empties them.
class PubMultiQueue
{
public:
  PubMultiQueue() = default;
  PubMultiQueue(const PubMultiQueue&) = delete;
  PubMultiQueue& operator=(const PubMultiQueue&) = delete;
  ~PubMultiQueue()
  {
    {
      const boost::mutex::scoped_lock lock(wake_lock_);
      running_ = false;
    }
    wake_.notify_all();
    if (thread_.joinable())
      thread_.join();
  }

  template <class T>
  boost::shared_ptr<PubQueue<T>> addPub()
  {
    const typename PubQueue<T>::QueuePtr messages(new std::deque<boost::shared_ptr<PubMessagePair<T>>>);
    const boost::shared_ptr<PubQueue<T>> queue(
        new PubQueue<T>(messages, boost::shared_ptr<boost::mutex>(new boost::mutex), [this] { notify(); }));
    const boost::mutex::scoped_lock lock(queues_lock_);
    queues_.push_back([queue] {
      std::vector<boost::shared_ptr<PubMessagePair<T>>> all;
      queue->pop(all);
      for (const auto& pair : all)
        pair->pub_.publish(pair->msg_);
    });
    return queue;
  }

  void startServiceThread()
  {
    if (!thread_.joinable())
      thread_ = boost::thread([this] { serve(); });
  }

  /// Publish what is queued now.
  void spinOnce()
  {
    const boost::mutex::scoped_lock lock(queues_lock_);
    for (const auto& publish : queues_)
      publish();
  }

  void spin()
  {
    while (ros::ok() && running_)
      spinOnce();
  }

private:
  void notify()
  {
    {
      const boost::mutex::scoped_lock lock(wake_lock_);
      waiting_ = true;
    }
    wake_.notify_one();
  }

  void serve()
  {
    while (true)
    {
      {
        boost::mutex::scoped_lock lock(wake_lock_);
        while (running_ && !waiting_)
          wake_.wait(lock);
        if (!running_)
          return;
        waiting_ = false;
      }
      spinOnce();
    }
  }

  std::vector<std::function<void()>> queues_;
  boost::mutex queues_lock_, wake_lock_;
  boost::condition_variable wake_;
  bool running_ = true, waiting_ = false;
  boost::thread thread_;
};
