#include "network.hpp"

#include <cstdlib>
#include <sys/eventfd.h>

namespace gazebo
{
namespace transport
{
namespace
{

constexpr std::size_t longest_outbox = 100000;
const std::chrono::seconds closing(2), greeting_comes(10), answering(5);

}  // namespace

Network& Network::Get()
{
  static Network* one = new Network;
  return *one;
}

// -- in any thread ------------------------------------------------------------------------------------------------------------------

void Network::start()
{
  address_ = own_address();
  if (wake_ < 0)
  {
    port_ = 0;
    listens_ = listen_on(port_);
    wake_ = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
    std::thread([this] { run(); }).detach();
  }
  closed_ = false;
  running_ = true;
}

std::string Network::Serve(const std::string& world, unsigned int port, std::function<void()> first)
{
  std::vector<std::string> topics;
  const std::lock_guard<std::mutex> lock(mutex_);
  if (running_)
    return "";
  master_listens_ = listen_on(port);
  if (master_listens_ < 0)
    return "port " + std::to_string(port) +
           " is taken, maybe by another simulator: gz topic and programs that are clients of Gazebo reach "
           "that one. For both, each with a port of its own: export GAZEBO_MASTER_URI=http://localhost:" +
           std::to_string(port + 1);
  serves_ = true;
  first_ = std::move(first);
  master_.reset(
      new Master({ world, "/gazebo" }, [this](int client, const std::string& type, const google::protobuf::Message& message) {
        const std::string packet = msgs::Package(type, message);
        const auto found = connections_.find(client);
        msgs::Packet own;
        if (found != connections_.end())
          found->second.link->Send(framed(packet));
        else if (client == 0 && ReadMessage(own, packet))
          onPacket(own);
      }));
  start();
  master_->Add(0);
  {
    const std::lock_guard<std::mutex> post(Post::Get().mutex);
    for (const auto& topic : Post::Get().topics)
      topics.push_back(topic.first);
  }
  for (const std::string& topic : topics)
    refresh(topic);
  return "";
}

void Network::Ready()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  ready_ = true;
  wake();
}

std::string Network::Join(const std::string& host, unsigned int port, unsigned int tries)
{
  if (running_)
    return "";
  int fd = -1;
  for (unsigned int i = 0; fd < 0; ++i)
  {
    if (i)
      std::this_thread::sleep_for(std::chrono::seconds(1));
    fd = connect_to(host, port, true);
    if (fd < 0 && i + 1 >= tries)
      return "no simulator answers at " + host + ":" + std::to_string(port) + " (GAZEBO_MASTER_URI)";
  }
  std::unique_lock<std::mutex> lock(mutex_);
  static const int at_end = std::atexit([] { Network::Get().Leave(); });  // what is published last must get out
  (void)at_end;
  greeted_ = false;
  add(fd, Kind::to_master, Link::small * 16);
  to_master_ = next_ - 1;
  start();
  wake();
  if (!changed_.wait_for(lock, greeting_comes, [&] { return greeted_ || closed_; }) || closed_)
  {
    running_ = false;
    return "what answers at " + host + ":" + std::to_string(port) + " (GAZEBO_MASTER_URI) is no simulator";
  }
  std::vector<std::string> topics;
  {
    const std::lock_guard<std::mutex> post(Post::Get().mutex);
    for (const auto& topic : Post::Get().topics)
      topics.push_back(topic.first);
  }
  for (const std::string& topic : topics)
    refresh(topic);
  return "";
}

void Network::Leave()
{
  if (!Client())
    return;
  const auto end = Clock::now() + closing;
  const auto left = [&] {
    const std::lock_guard<std::mutex> lock(mutex_);
    const std::lock_guard<std::mutex> outbox(outbox_mutex_);
    bool some = !outbox_.empty();
    for (const auto& each : connections_)
      some = some || each.second.link->HasToSend();
    return some;
  };
  while (left() && Clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  std::unique_lock<std::mutex> lock(mutex_);
  running_ = false;
  announced_.clear();
  for (auto& each : connections_)
    each.second.end = Clock::time_point::min();
  wake();
  changed_.wait_for(lock, closing, [&] { return connections_.empty(); });
}

void Network::wake()
{
  if (wake_ >= 0 && !woken_.exchange(true))
    eventfd_write(wake_, 1);
}

void Network::Refresh(const std::string& topic)
{
  if (!running_)
    return;
  const std::lock_guard<std::mutex> lock(mutex_);
  refresh(topic);
}

void Network::refresh(const std::string& name)
{
  Announced now;
  {
    Post& post = Post::Get();
    const std::lock_guard<std::mutex> lock(post.mutex);
    const auto topic = post.Find(name);
    now.published = topic->publishers > 0;
    now.heard = !topic->subscriptions.empty();
    now.type = topic->type;
    for (const auto& subscription : topic->subscriptions)
    {
      now.latching = now.latching || subscription->latching;
      if (now.type.empty())
        now.type = subscription->type;
    }
  }
  const Announced before = announced_[name];
  announced_[name] = now;
  if (now.published != before.published)
  {
    msgs::Publish message;
    message.set_topic(name), message.set_msg_type(now.type), message.set_host(address_), message.set_port(port_);
    tellMaster(now.published ? "advertise" : "unadvertise", message);
  }
  if (now.heard == before.heard)
    return;
  msgs::Subscribe message;
  message.set_topic(name), message.set_msg_type(now.type), message.set_host(address_), message.set_port(port_);
  message.set_latching(now.latching);
  tellMaster(now.heard ? "subscribe" : "unsubscribe", message);
  if (!now.heard)
    for (auto& each : connections_)
      if (each.second.kind == Kind::source && each.second.topic->name == name)
        each.second.end = Clock::time_point::min();
  wake();
}

void Network::tellMaster(const std::string& type, const google::protobuf::Message& message)
{
  const std::string data = msgs::Package(type, message);
  msgs::Packet packet;
  if (master_ && ReadMessage(packet, data))
    return master_->Handle(0, packet);
  const auto found = connections_.find(to_master_);
  if (found != connections_.end())
    found->second.link->Send(framed(data));
  wake();
}

void Network::Send(const std::shared_ptr<Topic>& topic, const MessagePtr& message, std::size_t most)
{
  {
    const std::lock_guard<std::mutex> lock(outbox_mutex_);
    outbox_.push_back({ topic, message, most });
    if (outbox_.size() > longest_outbox)
      outbox_.pop_front();
  }
  wake();
}

std::list<msgs::Publish> Network::Publishers()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return publishers_;
}

std::list<std::string> Network::Spaces(const std::chrono::duration<double>& patience)
{
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait_for(lock, patience, [&] { return !spaces_.empty() || closed_; });
  return spaces_;
}

bool Network::Ask(const std::string& request, const std::string& data, const std::string& answer,
                  google::protobuf::Message& message)
{
  const std::unique_ptr<msgs::Request> asked(msgs::CreateRequest(request, data));
  std::unique_lock<std::mutex> lock(mutex_);
  answers_.erase(answer);
  tellMaster("request", *asked);
  return changed_.wait_for(lock, answering, [&] { return answers_.count(answer) || closed_; }) && answers_.count(answer) &&
         ReadMessage(message, answers_[answer]);
}

}  // namespace transport
}  // namespace gazebo
