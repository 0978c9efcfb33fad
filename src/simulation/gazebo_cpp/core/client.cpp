// Programs beside the simulator: gazebo::client, and what gz asks.
#include <gazebo/gazebo_client.hh>
#include <gazebo/transport/transport.hh>

#include <iostream>

#include <google/protobuf/text_format.h>

#include "network.hpp"
#include "transport.hpp"

namespace gazebo
{
namespace transport
{

std::string serve(const std::string& world, std::function<void()> first)
{
  set_world(world);
  std::string host;
  unsigned int port = 0;
  const std::string problem = master_uri(host, port);
  const std::string taken = Network::Get().Serve(world, port, std::move(first));
  return problem.empty() ? taken : problem + ", which is taken instead" + (taken.empty() ? "" : "; ") + taken;
}

void ready() { Network::Get().Ready(); }

std::string join(unsigned int tries)
{
  std::string host;
  unsigned int port = 0;
  const std::string problem = master_uri(host, port);
  return problem.empty() ? Network::Get().Join(host, port, tries) : problem;
}

std::vector<std::string> topic_names()
{
  msgs::GzString_V names;
  Network::Get().Ask("get_topics", "", "topic_list", names);
  return { names.data().begin(), names.data().end() };
}

TopicDescription describe_topic(const std::string& topic)
{
  msgs::TopicInfo info;
  TopicDescription found;
  if (Network::Get().Ask("topic_info", topic, "topic_info_response", info))
    found.type = info.msg_type();
  for (const auto& each : info.publisher())
    found.publishers.push_back(each.host() + ":" + std::to_string(each.port()));
  for (const auto& each : info.subscriber())
    found.subscribers.push_back(each.host() + ":" + std::to_string(each.port()));
  return found;
}

std::string message_text(const std::string& type, const std::string& bytes, bool in_one_line)
{
  const auto* descriptor = google::protobuf::DescriptorPool::generated_pool()->FindMessageTypeByName(type);
  const google::protobuf::Message* prototype =
      descriptor ? google::protobuf::MessageFactory::generated_factory()->GetPrototype(descriptor) : nullptr;
  const std::unique_ptr<google::protobuf::Message> message(prototype ? prototype->New() : new msgs::Empty);
  message->ParsePartialFromString(bytes);
  return in_one_line ? message->ShortDebugString() + "\n" : message->DebugString();
}

}  // namespace transport

namespace client
{

void printVersion() { gazebo::printVersion(); }

bool setup(int, char**)
{
  // Whether it is there, a line of its own says; how it is called otherwise is not its business.
  return transport::init() && transport::waitForNamespaces(common::Time(10, 0));
}

bool setup(const std::vector<std::string>&) { return setup(0, nullptr); }

bool shutdown()
{
  transport::fini();
  return true;
}

}  // namespace client
}  // namespace gazebo
