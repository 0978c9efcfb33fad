#include "master.hpp"

#include <algorithm>

#include <gazebo/gazebo_config.h>

namespace gazebo
{
namespace transport
{
namespace
{

template <typename M>
bool same(const M& a, const M& b)
{
  return a.topic() == b.topic() && a.host() == b.host() && a.port() == b.port();
}

template <typename M>
bool read(M& message, const msgs::Packet& packet)
{
  return message.ParsePartialFromString(packet.serialized_data()) && message.IsInitialized();
}

/// The one of the client, or of nobody in particular.
template <typename Entries>
typename Entries::const_iterator of(const Entries& entries, int client)
{
  return std::find_if(entries.begin(), entries.end(), [&](const auto& each) { return each.first == client; });
}

template <typename Entries, typename M>
void drop(Entries& entries, const M& message)
{
  entries.erase(std::remove_if(entries.begin(), entries.end(), [&](const auto& each) { return same(each.second, message); }),
                entries.end());
}

msgs::GzString_V strings(const std::vector<std::string>& all)
{
  msgs::GzString_V message;
  for (const std::string& each : all)
    message.add_data(each);
  return message;
}

}  // namespace

void Master::all(const std::string& type, const google::protobuf::Message& message)
{
  for (const int client : clients_)
    send_(client, type, message);
}

msgs::Publishers Master::publishers() const
{
  msgs::Publishers message;
  for (const auto& each : publishers_)
    *message.add_publisher() = each.second;
  return message;
}

void Master::Add(int client)
{
  msgs::GzString version;
  version.set_data("gazebo " GAZEBO_VERSION);
  send_(client, "version_init", version);
  send_(client, "topic_namepaces_init", strings(spaces_));  // as the original spells it
  send_(client, "publishers_init", publishers());
  clients_.insert(client);
}

void Master::Remove(int client)
{
  clients_.erase(client);
  for (auto found = of(publishers_, client); found != publishers_.end(); found = of(publishers_, client))
    unadvertise(msgs::Publish(found->second));
  for (auto found = of(subscribers_, client); found != subscribers_.end(); found = of(subscribers_, client))
    unsubscribe(msgs::Subscribe(found->second));
}

void Master::advertise(int client, const msgs::Publish& publisher)
{
  all("publisher_add", publisher);
  publishers_.emplace_back(client, publisher);
  for (const auto& each : subscribers_)
    if (each.second.topic() == publisher.topic() && clients_.count(each.first))
      send_(each.first, "publisher_advertise", publisher);
}

void Master::unadvertise(const msgs::Publish& publisher)
{
  all("publisher_del", publisher);
  for (const auto& each : subscribers_)
    if (each.second.topic() == publisher.topic() && clients_.count(each.first))
      send_(each.first, "unadvertise", publisher);
  drop(publishers_, publisher);
}

void Master::subscribe(int client, const msgs::Subscribe& subscriber)
{
  subscribers_.emplace_back(client, subscriber);
  for (const auto& each : publishers_)
    if (each.second.topic() == subscriber.topic())
      send_(client, "publisher_subscribe", each.second);
}

void Master::unsubscribe(const msgs::Subscribe& subscriber)
{
  for (const auto& each : publishers_)
    if (each.second.topic() == subscriber.topic() && clients_.count(each.first))
      send_(each.first, "unsubscribe", subscriber);
  drop(subscribers_, subscriber);
}

msgs::TopicInfo Master::info(const std::string& topic) const
{
  msgs::TopicInfo message;
  message.set_msg_type("");
  for (const auto& each : publishers_)
    if (each.second.topic() == topic)
    {
      *message.add_publisher() = each.second;
      if (message.msg_type().empty())
        message.set_msg_type(each.second.msg_type());
    }
  for (const auto& each : subscribers_)
    if (each.second.topic() == topic)
    {
      *message.add_subscriber() = each.second;
      if (message.msg_type().empty())
        message.set_msg_type(each.second.msg_type());
    }
  return message;
}

void Master::answer(int client, const msgs::Request& request)
{
  if (request.request() == "get_publishers")
    send_(client, "publisher_list", publishers());
  else if (request.request() == "topic_info")
    send_(client, "topic_info_response", info(request.data()));
  else if (request.request() == "get_topic_namespaces")
    send_(client, "get_topic_namespaces_response", strings(spaces_));
  else if (request.request() == "get_topics")
  {
    std::set<std::string> names;
    for (const auto& each : publishers_)
      names.insert(each.second.topic());
    for (const auto& each : subscribers_)
      names.insert(each.second.topic());
    send_(client, "topic_list", strings({ names.begin(), names.end() }));
  }
}

void Master::Handle(int client, const msgs::Packet& packet)
{
  msgs::Publish publisher;
  msgs::Subscribe subscriber;
  msgs::GzString space;
  msgs::Request request;
  if (packet.type() == "advertise" && read(publisher, packet))
    advertise(client, publisher);
  else if (packet.type() == "unadvertise" && read(publisher, packet))
    unadvertise(publisher);
  else if (packet.type() == "subscribe" && read(subscriber, packet))
    subscribe(client, subscriber);
  else if (packet.type() == "unsubscribe" && read(subscriber, packet))
    unsubscribe(subscriber);
  else if (packet.type() == "request" && read(request, packet))
    answer(client, request);
  else if (packet.type() == "register_topic_namespace" && read(space, packet) &&
           std::find(spaces_.begin(), spaces_.end(), space.data()) == spaces_.end())
  {
    spaces_.push_back(space.data());
    all("topic_namespace_add", space);
  }
}

}  // namespace transport
}  // namespace gazebo
