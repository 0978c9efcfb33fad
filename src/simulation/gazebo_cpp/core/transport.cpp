// Nodes, publishers and subscribers, as plugins and programs see them.
#include <gazebo/transport/transport.hh>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <set>

#include <gazebo/common/Console.hh>

#include "network.hpp"
#include "post.hpp"
#include "transport.hpp"

namespace gazebo
{
namespace transport
{
namespace
{

std::atomic<uint32_t> ids{ 1 };

}  // namespace

void set_world(const std::string& name)
{
  const std::lock_guard<std::mutex> lock(Post::Get().mutex);
  Post::Get().world = name;
}

bool wanted(const std::string& topic)
{
  const std::lock_guard<std::mutex> lock(Post::Get().mutex);
  const auto found = Post::Get().topics.find(topic);
  return found != Post::Get().topics.end() && found->second->Heard();
}

// -- Publisher ----------------------------------------------------------------------------------------------------------------------

Publisher::Publisher(std::shared_ptr<Topic> topic, const std::string& type, unsigned int limit, double hz)
  : topic_(std::move(topic))
  , type_(type)
  , limit_(limit)
  , period_(hz > 0 ? 1 / hz : 0)
  , id_(ids++)
{
  ++topic_->publishers;
}

Publisher::~Publisher()
{
  {
    const std::lock_guard<std::mutex> lock(Post::Get().mutex);
    --topic_->publishers;
  }
  Network::Get().Refresh(topic_->name);
}

void Publisher::Fini() {}
std::string Publisher::GetTopic() const { return topic_->name; }

bool Publisher::HasConnections() const
{
  const std::lock_guard<std::mutex> lock(Post::Get().mutex);
  return topic_->Heard();
}

unsigned int Publisher::GetRemoteSubscriptionCount() { return static_cast<unsigned int>(topic_->listeners); }

bool Publisher::WaitForConnection(const common::Time& timeout) const
{
  std::unique_lock<std::mutex> lock(Post::Get().mutex);
  const auto there = [&] { return topic_->Heard(); };
  if (timeout >= common::Time::Zero)
    return Post::Get().changed.wait_for(lock, std::chrono::duration<double>(timeout.Double()), there);
  Post::Get().changed.wait(lock, there);
  return true;
}

unsigned int Publisher::GetOutgoingCount() const { return static_cast<unsigned int>(Post::Get().Sent() - Post::Get().Done()); }
MessagePtr Publisher::GetPrevMsgPtr() const
{
  const std::lock_guard<std::mutex> lock(Post::Get().mutex);
  return topic_->published;
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
    gzerr << "topic " << topic_->name << " takes " << type_ << ", not " << message.GetTypeName() << "; it is not sent"
          << std::endl;
    return;
  }
  if (!message.IsInitialized())
  {
    gzerr << "topic " << topic_->name << ": a message without " << message.InitializationErrorString() << " is not sent"
          << std::endl;
    return;
  }
  const common::Time now = common::Time::GetWallTime();
  if (period_ > 0 && (now - last_).Double() < period_)
    return;
  last_ = now;
  const MessagePtr copy(message.New());
  copy->CopyFrom(message);
  uint64_t sent = 0;
  std::unique_lock<std::mutex> lock(Post::Get().mutex);
  topic_->published = copy;
  Post::Get().Spread(*topic_, { copy, nullptr, "" });
  if (topic_->listeners)
    Network::Get().Send(topic_, copy, limit_);
  sent = Post::Get().Sent();
  if (block && !Post::Get().Here())
    Post::Get().changed.wait_for(lock, std::chrono::seconds(1), [&] { return Post::Get().Done() >= sent; });
}

// -- Subscriber ---------------------------------------------------------------------------------------------------------------------

std::string Subscriber::GetTopic() const { return subscription_->topic; }

void Subscriber::Unsubscribe() const
{
  subscription_->on = false;
  {
    const std::lock_guard<std::mutex> lock(Post::Get().mutex);
    auto& all = Post::Get().Find(subscription_->topic)->subscriptions;
    all.erase(std::remove(all.begin(), all.end(), subscription_), all.end());
  }
  Network::Get().Refresh(subscription_->topic);
  if (!Post::Get().Here())
    const std::lock_guard<std::mutex> done(subscription_->running);
}

// -- Node ---------------------------------------------------------------------------------------------------------------------------

Node::Node() : id_(ids++) {}
Node::~Node() = default;

void Node::Init(const std::string& space)
{
  if (!space.empty() && space != "default")
  {
    space_ = space;
    return;
  }
  const bool client = Network::Get().Client();
  const std::list<std::string> spaces = client ? Network::Get().Spaces(std::chrono::seconds(1)) : std::list<std::string>();
  const std::lock_guard<std::mutex> lock(Post::Get().mutex);
  space_ = spaces.empty() ? Post::Get().World() : spaces.front();
}

void Node::Fini() { space_.clear(); }

std::string Node::DecodeTopicName(const std::string& topic)
{
  std::string name = topic;
  const std::size_t at = name.find('~');
  if (at != std::string::npos)
    name.replace(at, 1, "/gazebo/" + (space_.empty() ? Post::Get().World() : space_));
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
  PublisherPtr made;
  {
    const std::lock_guard<std::mutex> lock(Post::Get().mutex);
    const auto found = Post::Get().Find(name);
    if (!found->type.empty() && found->type != type)
      gzerr << "topic " << name << " has messages of type " << found->type << "; it is advertised with " << type << ", too"
            << std::endl;
    found->type = type;
    made.reset(new Publisher(found, type, limit, hz));
  }
  Network::Get().Refresh(name);
  return made;
}

void Node::publishOnce(const std::string& topic, const google::protobuf::Message& message)
{
  const PublisherPtr publisher = Advertise(topic, message.GetTypeName());
  if (Network::Get().Client())  // who is to hear it is another process, which has yet to connect
    publisher->WaitForConnection(common::Time(5, 0));
  publisher->Publish(message);
}

SubscriberPtr Node::listen(const std::string& topic, const std::string& type, Raw callback, bool latching)
{
  const auto added = std::make_shared<Subscription>();
  added->topic = DecodeTopicName(topic);
  added->type = type;
  added->latching = latching;
  const std::string name = added->topic;
  bool said = false;
  added->callback = [callback, type, name, said](const Parcel& parcel) mutable {
    static const std::string none;
    const std::string& brought = parcel.message ? parcel.message->GetTypeName() : parcel.type;
    if (type.empty() || brought == type)
      return callback(parcel.message, parcel.bytes ? *parcel.bytes : none);
    if (!said)
      gzerr << "topic " << name << " brings " << brought << ", its subscriber wants " << type << std::endl;
    said = true;
  };
  {
    const std::lock_guard<std::mutex> lock(Post::Get().mutex);
    const auto found = Post::Get().Find(name);
    found->subscriptions.push_back(added);
    if (latching && (found->last.message || found->last.bytes))
      Post::Get().Send(added, found->last);
    Post::Get().changed.notify_all();
  }
  Network::Get().Refresh(name);
  return SubscriberPtr(new Subscriber(added));
}

// -- free functions -----------------------------------------------------------------------------------------------------------------

bool get_master_uri(std::string& host, unsigned int& port)
{
  const std::string problem = master_uri(host, port);
  if (!problem.empty())
    internal::Report(false, problem + ", which is taken instead");
  return problem.empty() && std::getenv("GAZEBO_MASTER_URI");
}

bool init(const std::string& host, unsigned int port, uint32_t iterations)
{
  std::string name = host;
  if (host.empty())
    get_master_uri(name, port);
  const std::string problem = Network::Get().Join(name, port, iterations);
  if (!problem.empty())
    internal::Report(true, problem);
  return problem.empty();
}

void run() {}
void stop() {}
void fini() { Network::Get().Leave(); }
bool is_stopped() { return !Network::Get().Running(); }
void clear_buffers() {}
void pause_incoming(bool) {}
bool waitForNamespaces(const common::Time& most)
{
  return !Network::Get().Client() || !Network::Get().Spaces(std::chrono::duration<double>(most.Double())).empty();
}

void get_topic_namespaces(std::list<std::string>& namespaces)
{
  namespaces = Network::Get().Spaces(std::chrono::seconds(0));
  const std::lock_guard<std::mutex> lock(Post::Get().mutex);
  if (namespaces.empty())
    namespaces.assign(1, Post::Get().World());
}

std::map<std::string, std::list<std::string>> getAdvertisedTopics()
{
  std::map<std::string, std::set<std::string>> found;
  for (const msgs::Publish& each : Network::Get().Publishers())
    found[each.msg_type()].insert(each.topic());
  {
    const std::lock_guard<std::mutex> lock(Post::Get().mutex);
    for (const auto& topic : Post::Get().topics)
      if (topic.second->publishers)
        found[topic.second->type].insert(topic.first);
  }
  std::map<std::string, std::list<std::string>> lists;
  for (const auto& each : found)
    lists[each.first].assign(each.second.begin(), each.second.end());
  return lists;
}

std::list<std::string> getAdvertisedTopics(const std::string& type) { return getAdvertisedTopics()[type]; }

std::string getTopicMsgType(const std::string& topic)
{
  for (const msgs::Publish& each : Network::Get().Publishers())
    if (each.topic() == topic)
      return each.msg_type();
  const std::lock_guard<std::mutex> lock(Post::Get().mutex);
  const auto found = Post::Get().topics.find(topic);
  return found == Post::Get().topics.end() ? "" : found->second->type;
}

void requestNoReply(NodePtr node, const std::string& request, const std::string& data)
{
  const std::unique_ptr<msgs::Request> message(msgs::CreateRequest(request, data));
  node->Publish("~/request", *message);
}

void requestNoReply(const std::string& world, const std::string& request, const std::string& data)
{
  const NodePtr node(new Node);
  node->Init(world);
  requestNoReply(node, request, data);
}

}  // namespace transport
}  // namespace gazebo
