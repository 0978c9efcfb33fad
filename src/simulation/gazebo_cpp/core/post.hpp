// The topics that this process knows of, and the thread that hands messages on.
#pragma once
#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <gazebo/common/Event.hh>
#include <gazebo/transport/TransportTypes.hh>

namespace gazebo
{
namespace transport
{

using Message = boost::shared_ptr<google::protobuf::Message const>;

/// What a subscriber gets: a message of this process, or the bytes of one of another.
struct Parcel
{
  Message message;
  std::shared_ptr<const std::string> bytes;
  std::string type;  // of bytes
};

struct Subscription
{
  std::string topic, type;
  std::function<void(const Parcel&)> callback;
  bool latching = false;
  const char* owner = internal::CurrentPlugin();
  std::atomic<bool> on{ true };
  std::mutex running;  // held while the callback runs
};

struct Topic
{
  std::string name, type;
  std::vector<std::shared_ptr<Subscription>> subscriptions;
  Parcel last;
  MessagePtr published;  // the last one of this process
  unsigned int publishers = 0;
  std::atomic<int> listeners{ 0 };  // of other processes

  bool Heard() const { return !subscriptions.empty() || listeners; }
};

/// All topics, and the thread that delivers. Left where it is at the end.
class Post
{
public:
  static Post& Get();
  std::mutex mutex;  // of what follows
  std::condition_variable changed;
  std::map<std::string, std::shared_ptr<Topic>> topics;
  std::string world;  // what "~" stands for behind /gazebo/

  std::string World() const { return world.empty() ? "default" : world; }
  std::shared_ptr<Topic> Find(const std::string& name);  // made when there is none

  /// To all subscriptions of this process, but not if those wait for too many by now: who never gets on must not take all memory.
  void Spread(Topic& topic, const Parcel& parcel);
  void Send(const std::shared_ptr<Subscription>& to, const Parcel& parcel);
  std::size_t Waiting() const { return queue_.size(); }

  bool Here() const { return std::this_thread::get_id() == thread_; }
  uint64_t Sent() const { return sent_; }
  uint64_t Done() const { return done_; }

private:
  struct Delivery
  {
    std::shared_ptr<Subscription> to;
    Parcel parcel;
  };
  void deliver();
  static void handOver(const Delivery& next);

  std::deque<Delivery> queue_;
  std::atomic<uint64_t> sent_{ 0 }, done_{ 0 };
  std::atomic<std::thread::id> thread_{};
  bool running_ = false;
};

}  // namespace transport
}  // namespace gazebo
