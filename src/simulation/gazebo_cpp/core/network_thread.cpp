// The thread of the network: what comes from others.
#include "network.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

namespace gazebo
{
namespace transport
{
namespace
{

constexpr std::size_t busy =
    1000;                       // messages that subscribers of this process have not got to: no more are read until they have
constexpr int busy_pause = 10;  // ms
const std::chrono::seconds last_words(2), greeting(4);
enum : int
{
  wake_id = -1,
  listens_id = -2,
  master_listens_id = -3
};

bool same(const msgs::Publish& a, const msgs::Publish& b)
{
  return a.topic() == b.topic() && a.host() == b.host() && a.port() == b.port();
}

}  // namespace

void Network::run()
{
  std::vector<pollfd> fds;
  std::vector<int> ids;
  while (true)
  {
    int patience = -1;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      patience = collect(fds, ids);
    }
    poll(fds.data(), fds.size(), patience);
    std::function<void()> first;
    std::vector<std::string> reports;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      handle(fds, ids);
      if (!held_.empty())
        first.swap(first_);
      reports.swap(reports_);
    }
    if (first)
      first();
    for (const std::string& line : reports)
      internal::Report(false, line);
  }
}

int Network::collect(std::vector<pollfd>& fds, std::vector<int>& ids)
{
  fds.clear(), ids.clear();
  const auto watch = [&](int fd, int id, short events) {
    if (fd >= 0)
      fds.push_back({ fd, events, 0 }), ids.push_back(id);
  };
  watch(wake_, wake_id, POLLIN);
  watch(listens_, listens_id, POLLIN);
  watch(master_listens_, master_listens_id, POLLIN);
  Clock::time_point next = Clock::time_point::max();
  for (const auto& each : held_)
    next = std::min(next, each.second);
  Post& post = Post::Get();
  const std::lock_guard<std::mutex> lock(post.mutex);
  const bool full = post.Waiting() > busy;
  bool paused = false;
  for (const auto& each : connections_)
  {
    const Connection& connection = each.second;
    const bool rests = (full && connection.kind == Kind::source) || held_.count(each.first);
    paused = paused || (full && connection.kind == Kind::source);
    next = std::min(next, connection.end);
    watch(connection.link->Fd(), each.first,
          static_cast<short>((rests ? 0 : POLLIN) | (connection.link->HasToSend() ? POLLOUT : 0)));
  }
  if (paused)
    return busy_pause;
  if (next == Clock::time_point::max())
    return -1;
  const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(std::max(next, Clock::now()) - Clock::now()).count();
  return static_cast<int>(std::max<long>(0, ms)) + 1;
}

void Network::handle(const std::vector<pollfd>& fds, const std::vector<int>& ids)
{
  for (std::size_t i = 0; i < fds.size(); ++i)
  {
    const short events = fds[i].revents;
    eventfd_t count;
    if (!events)
      continue;
    if (ids[i] == wake_id)
      woken_ = false, eventfd_read(wake_, &count);
    else if (ids[i] == listens_id)
      accept(listens_, Kind::listener);
    else if (ids[i] == master_listens_id)
      accept(master_listens_, Kind::of_master);
    else if (connections_.count(ids[i]) && events & (POLLIN | POLLHUP | POLLERR))
      connections_.at(ids[i]).link->Receive([&](std::string&& data) { onFrame(ids[i], std::move(data)); });
  }
  greet();
  handOut();
  const auto now = Clock::now();
  for (auto each = connections_.begin(); each != connections_.end();)
  {
    const int id = (each++)->first;
    Connection& connection = connections_.at(id);
    connection.link->Flush();
    if (connection.link->Broken() || connection.end <= now)
      drop(id);
  }
}

void Network::accept(int fd, Kind kind)
{
  const int made = accept4(fd, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
  if (made >= 0)
    add(made, kind, Link::small);
  else if (errno != EAGAIN && errno != EINTR && errno != ECONNABORTED)
    std::this_thread::sleep_for(std::chrono::milliseconds(busy_pause));  // too many files are open
  if (made >= 0 && kind == Kind::of_master)
    held_[next_ - 1] = Clock::now() + greeting;
}

void Network::add(int fd, Kind kind, std::size_t longest)
{
  Connection& added = connections_[next_++];
  added.kind = kind;
  added.link.reset(new Link(fd, longest));
}

void Network::greet()
{
  for (auto each = held_.begin(); each != held_.end();)
    if (ready_ || each->second <= Clock::now())
    {
      const int id = each->first;
      each = held_.erase(each);
      master_->Add(id);
    }
    else
      ++each;
}

void Network::drop(int id)
{
  const Kind kind = connections_.at(id).kind;
  const std::shared_ptr<Topic> topic = connections_.at(id).topic;
  connections_.erase(id);
  held_.erase(id);
  if (kind == Kind::of_master)
    master_->Remove(id);
  else if (kind == Kind::to_master)
  {
    closed_ = true;
    if (running_ && greeted_)
      reports_.push_back("the simulator has ended: no more messages come from it, or go to it");
  }
  else if (kind == Kind::listener && topic)
    --topic->listeners;
  changed_.notify_all();
}

void Network::handOut()
{
  std::deque<Outgoing> all;
  {
    const std::lock_guard<std::mutex> lock(outbox_mutex_);
    all.swap(outbox_);
  }
  for (const Outgoing& each : all)
  {
    if (!each.topic->listeners)
      continue;
    const Frame frame = framed(each.message->SerializeAsString());
    for (auto& [id, connection] : connections_)
    {
      if (connection.kind != Kind::listener || connection.topic != each.topic)
        continue;
      if (connection.link->Send(frame, each.most))
        reports_.push_back("topic " + each.topic->name + ": somebody who listens does not keep up; old messages are dropped");
      connection.link->Flush();
    }
  }
}

void Network::onFrame(int id, std::string&& data)
{
  Connection& connection = connections_.at(id);
  msgs::Packet packet;
  if (connection.kind == Kind::source)
  {
    Post& post = Post::Get();
    const std::string& type = connection.publisher.msg_type();
    const std::lock_guard<std::mutex> lock(post.mutex);
    post.Spread(*connection.topic, { Message(), std::make_shared<const std::string>(std::move(data)), type });
  }
  else if (!ReadMessage(packet, data))
    connection.end = Clock::time_point::min();  // speaks another language
  else if (connection.kind == Kind::of_master)
    master_->Handle(id, packet);
  else if (connection.kind == Kind::to_master)
    onPacket(packet);
  else
    onSubscriber(connection, packet);
}

void Network::onSubscriber(Connection& connection, const msgs::Packet& packet)
{
  msgs::Subscribe subscriber;
  if (packet.type() != "sub" || connection.topic || !ReadMessage(subscriber, packet.serialized_data()))
    return;
  Post& post = Post::Get();
  const std::lock_guard<std::mutex> lock(post.mutex);
  connection.topic = post.Find(subscriber.topic());
  if (subscriber.latching() && connection.topic->published)
    connection.link->Send(framed(connection.topic->published->SerializeAsString()));
  ++connection.topic->listeners;
  post.changed.notify_all();
}

void Network::onPacket(const msgs::Packet& packet)
{
  const std::string& type = packet.type();
  const std::string& data = packet.serialized_data();
  msgs::Publish publisher;
  msgs::Publishers publishers;
  msgs::GzString_V names;
  msgs::GzString name;
  if (type == "publishers_init" && ReadMessage(publishers, data))
  {
    publishers_.assign(publishers.publisher().begin(), publishers.publisher().end());
    greeted_ = true;
  }
  else if (type == "topic_namepaces_init" && ReadMessage(names, data))
    spaces_.assign(names.data().begin(), names.data().end());
  else if (type == "topic_namespace_add" && ReadMessage(name, data))
    spaces_.push_back(name.data());
  else if (type == "publisher_add" && ReadMessage(publisher, data))
    publishers_.push_back(publisher);
  else if (type == "publisher_del" && ReadMessage(publisher, data))
    publishers_.remove_if([&](const msgs::Publish& each) { return same(each, publisher); });
  else if ((type == "publisher_subscribe" || type == "publisher_advertise" || type == "publisher_update") &&
           ReadMessage(publisher, data))
    onPublisher(publisher);
  else if (type == "unadvertise" && ReadMessage(publisher, data))
    onUnadvertised(publisher);
  else
    answers_[type] = data;
  changed_.notify_all();
}

void Network::onPublisher(const msgs::Publish& publisher)
{
  const auto known = announced_.find(publisher.topic());
  if (own(publisher) || known == announced_.end() || !known->second.heard)
    return;
  for (const auto& each : connections_)
    if (each.second.kind == Kind::source && each.second.end == Clock::time_point::max() &&
        same(each.second.publisher, publisher))
      return;
  const int fd = connect_to(publisher.host(), publisher.port(), false);
  if (fd < 0)
    return reports_.push_back("topic " + publisher.topic() + ": who publishes it at " + publisher.host() + ":" +
                              std::to_string(publisher.port()) + " cannot be reached");
  add(fd, Kind::source, Link::large);
  Connection& connection = connections_.at(next_ - 1);
  connection.publisher = publisher;
  {
    const std::lock_guard<std::mutex> lock(Post::Get().mutex);
    connection.topic = Post::Get().Find(publisher.topic());
  }
  msgs::Subscribe message;
  message.set_topic(publisher.topic()), message.set_msg_type(publisher.msg_type());
  message.set_host(address_), message.set_port(port_), message.set_latching(known->second.latching);
  connection.link->Send(framed(msgs::Package("sub", message)));
  wake();
}

/// What it has sent may still be on its way: on another connection than this news.
void Network::onUnadvertised(const msgs::Publish& publisher)
{
  for (auto& each : connections_)
    if (each.second.kind == Kind::source && same(each.second.publisher, publisher))
      each.second.end = std::min(each.second.end, Clock::now() + last_words);
  wake();
}

}  // namespace transport
}  // namespace gazebo
