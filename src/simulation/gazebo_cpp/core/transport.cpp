// Topics within the process. Messages are handed on by one thread, in the order in which they were published.
#include <gazebo/transport/transport.hh>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

#include <gazebo/common/Console.hh>
#include <gazebo/common/Event.hh>

#include "transport.hpp"

namespace gazebo
{
namespace transport
{

using Message = boost::shared_ptr<google::protobuf::Message const>;

struct Subscription
{
  std::string topic, type;
  std::function<void(const Message&)> callback;
  const char* owner = internal::CurrentPlugin();
  std::atomic<bool> on{ true };
  std::mutex running;  // held while the callback runs
};

struct Topic
{
  std::string name, type;
  std::vector<std::shared_ptr<Subscription>> subscriptions;
  MessagePtr last;
  unsigned int publishers = 0;
};

namespace
{

struct Delivery
{
  std::shared_ptr<Subscription> to;
  Message message;
};

/// All topics, and the thread that delivers. Left where it is at the end.
struct Post
{
  std::mutex mutex;
  std::condition_variable changed;
  std::map<std::string, std::shared_ptr<Topic>> topics;
  std::deque<Delivery> queue;
  std::string world = "default";
  std::atomic<uint64_t> sent{ 0 }, done{ 0 };
  std::thread::id thread;
  bool running = false;

  std::shared_ptr<Topic> topic(const std::string& name)
  {
    auto& found = topics[name];
    if (!found)
      found = std::make_shared<Topic>(), found->name = name;
    return found;
  }

  void send(const std::shared_ptr<Subscription>& to, const Message& message)
  {
    if (!running)
    {
      running = true;
      std::thread([this] { deliver(); }).detach();
    }
    queue.push_back({ to, message });
    ++sent;
    changed.notify_all();
  }

  void deliver()
  {
    thread = std::this_thread::get_id();
    while (true)
    {
      Delivery next;
      {
        std::unique_lock<std::mutex> lock(mutex);
        changed.wait(lock, [&] { return !queue.empty(); });
        next = std::move(queue.front());
        queue.pop_front();
      }
      hand_over(next);
      ++done;
      const std::lock_guard<std::mutex> lock(mutex);
      changed.notify_all();
    }
  }

  static void hand_over(const Delivery& next)
  {
    const std::lock_guard<std::mutex> lock(next.to->running);
    if (!next.to->on)
      return;
    const internal::Running running(next.to->owner, "callback of a topic");
    try
    {
      next.to->callback(next.message);
    }
    catch (const std::exception& error)
    {
      next.to->on = false;
      internal::Failed(next.to->owner, ("callback of " + next.to->topic).c_str(), error.what());
    }
    catch (...)
    {
      next.to->on = false;
      internal::Failed(next.to->owner, ("callback of " + next.to->topic).c_str(), nullptr);
    }
  }
};

Post& post()
{
  static Post* one = new Post;
  return *one;
}

std::atomic<uint32_t> ids{ 1 };

}  // namespace

void set_world(const std::string& name)
{
  const std::lock_guard<std::mutex> lock(post().mutex);
  post().world = name;
}

bool wanted(const std::string& topic)
{
  const std::lock_guard<std::mutex> lock(post().mutex);
  const auto found = post().topics.find(topic);
  return found != post().topics.end() && !found->second->subscriptions.empty();
}

// -- Publisher ----------------------------------------------------------------------------------------------------------------------

Publisher::Publisher(std::shared_ptr<Topic> topic, const std::string& type, unsigned int limit, double hz)
  : topic_(std::move(topic)), type_(type), limit_(limit), period_(hz > 0 ? 1 / hz : 0), id_(ids++)
{
  ++topic_->publishers;
}

Publisher::~Publisher()
{
  const std::lock_guard<std::mutex> lock(post().mutex);
  --topic_->publishers;
}

void Publisher::Fini() {}
std::string Publisher::GetTopic() const { return topic_->name; }

bool Publisher::HasConnections() const
{
  const std::lock_guard<std::mutex> lock(post().mutex);
  return !topic_->subscriptions.empty();
}

unsigned int Publisher::GetRemoteSubscriptionCount() { return 0; }

bool Publisher::WaitForConnection(const common::Time& timeout) const
{
  std::unique_lock<std::mutex> lock(post().mutex);
  const auto there = [&] { return !topic_->subscriptions.empty(); };
  if (timeout >= common::Time::Zero)
    return post().changed.wait_for(lock, std::chrono::duration<double>(timeout.Double()), there);
  post().changed.wait(lock, there);
  return true;
}

unsigned int Publisher::GetOutgoingCount() const { return static_cast<unsigned int>(post().sent - post().done); }
MessagePtr Publisher::GetPrevMsgPtr() const
{
  const std::lock_guard<std::mutex> lock(post().mutex);
  return topic_->last;
}
std::string Publisher::GetPrevMsg() const
{
  const MessagePtr last = GetPrevMsgPtr();
  return last ? last->SerializeAsString() : "";
}

void Publisher::publish(const google::protobuf::Message& message, bool block)
{
  if (message.GetTypeName() != type_)
  {
    gzerr << "topic " << topic_->name << " takes " << type_ << ", not " << message.GetTypeName() << "; it is not sent" << std::endl;
    return;
  }
  const common::Time now = common::Time::GetWallTime();
  if (period_ > 0 && (now - last_).Double() < period_)
    return;
  last_ = now;
  const MessagePtr copy(message.New());
  copy->CopyFrom(message);
  uint64_t sent = 0;
  std::unique_lock<std::mutex> lock(post().mutex);
  topic_->last = copy;
  for (const auto& subscription : topic_->subscriptions)
    if (post().queue.size() < 100000)  // who never gets on with its callback must not take all memory
      post().send(subscription, copy);
  sent = post().sent;
  if (block && std::this_thread::get_id() != post().thread)
    post().changed.wait_for(lock, std::chrono::seconds(1), [&] { return post().done >= sent; });
}

// -- Subscriber ---------------------------------------------------------------------------------------------------------------------

std::string Subscriber::GetTopic() const { return subscription_->topic; }

void Subscriber::Unsubscribe() const
{
  subscription_->on = false;
  {
    const std::lock_guard<std::mutex> lock(post().mutex);
    auto& all = post().topic(subscription_->topic)->subscriptions;
    all.erase(std::remove(all.begin(), all.end(), subscription_), all.end());
  }
  if (std::this_thread::get_id() != post().thread)
    const std::lock_guard<std::mutex> done(subscription_->running);
}

// -- Node ---------------------------------------------------------------------------------------------------------------------------

Node::Node() : id_(ids++) {}
Node::~Node() = default;

void Node::Init(const std::string& space)
{
  const std::lock_guard<std::mutex> lock(post().mutex);
  space_ = space.empty() || space == "default" ? post().world : space;
}

void Node::Fini() { space_.clear(); }

std::string Node::DecodeTopicName(const std::string& topic)
{
  std::string name = topic;
  const std::size_t at = name.find('~');
  if (at != std::string::npos)
    name.replace(at, 1, "/gazebo/" + (space_.empty() ? post().world : space_));
  for (std::size_t twice; (twice = name.find("//")) != std::string::npos;)
    name.erase(twice, 1);
  return name;
}

std::string Node::EncodeTopicName(const std::string& topic)
{
  const std::string space = "/gazebo/" + space_;
  return topic.compare(0, space.size(), space) == 0 ? "~" + topic.substr(space.size()) : topic;
}

std::string Node::GetMsgType(const std::string& topic) const { return getTopicMsgType(topic); }

PublisherPtr Node::Advertise(const std::string& topic, const std::string& type, unsigned int limit, double hz)
{
  const std::string name = DecodeTopicName(topic);
  const std::lock_guard<std::mutex> lock(post().mutex);
  const auto found = post().topic(name);
  if (!found->type.empty() && found->type != type)
    gzerr << "topic " << name << " has messages of type " << found->type << "; it is advertised with " << type << ", too" << std::endl;
  found->type = type;
  return PublisherPtr(new Publisher(found, type, limit, hz));
}

SubscriberPtr Node::listen(const std::string& topic, const std::string& type, Raw callback, bool latching)
{
  const auto added = std::make_shared<Subscription>();
  added->topic = DecodeTopicName(topic);
  added->type = type;
  const std::string name = added->topic;
  added->callback = [callback, type, name](const Message& message) {
    if (type.empty() || message->GetTypeName() == type)
      callback(message);
    else
      gzerr << "topic " << name << " brings " << message->GetTypeName() << ", its subscriber wants " << type << std::endl;
  };
  const std::lock_guard<std::mutex> lock(post().mutex);
  const auto found = post().topic(name);
  found->subscriptions.push_back(added);
  if (latching && found->last)
    post().send(added, found->last);
  post().changed.notify_all();
  return SubscriberPtr(new Subscriber(added));
}

// -- free functions -----------------------------------------------------------------------------------------------------------------

bool init(const std::string&, unsigned int, uint32_t) { return true; }
void run() {}
void stop() {}
void fini() {}
bool is_stopped() { return false; }
void clear_buffers() {}
void pause_incoming(bool) {}
bool waitForNamespaces(const common::Time&) { return true; }
void get_topic_namespaces(std::list<std::string>& namespaces)
{
  const std::lock_guard<std::mutex> lock(post().mutex);
  namespaces.assign(1, post().world);
}

std::map<std::string, std::list<std::string>> getAdvertisedTopics()
{
  std::map<std::string, std::list<std::string>> found;
  const std::lock_guard<std::mutex> lock(post().mutex);
  for (const auto& topic : post().topics)
    if (topic.second->publishers)
      found[topic.second->type].push_back(topic.first);
  return found;
}

std::list<std::string> getAdvertisedTopics(const std::string& type) { return getAdvertisedTopics()[type]; }

std::string getTopicMsgType(const std::string& topic)
{
  const std::lock_guard<std::mutex> lock(post().mutex);
  const auto found = post().topics.find(topic);
  return found == post().topics.end() ? "" : found->second->type;
}

void requestNoReply(NodePtr node, const std::string& request, const std::string& data)
{
  const std::unique_ptr<msgs::Request> message(msgs::CreateRequest(request, data));
  node->Advertise<msgs::Request>("~/request")->Publish(*message);
}

void requestNoReply(const std::string& world, const std::string& request, const std::string& data)
{
  const NodePtr node(new Node);
  node->Init(world);
  requestNoReply(node, request, data);
}

}  // namespace transport
}  // namespace gazebo
