#pragma once
#include <list>
#include <map>
#include <string>

#include <gazebo/common/Time.hh>
#include <gazebo/transport/Node.hh>

namespace gazebo
{
namespace transport
{

GAZEBO_VISIBLE bool get_master_uri(std::string& host, unsigned int& port);

/// Become a client of the simulator at host:port, or at GAZEBO_MASTER_URI. Does nothing in the simulator itself.
/// \param iterations s that it may take to be there
/// \return whether there is one
GAZEBO_VISIBLE bool init(const std::string& host = "", unsigned int port = 0, uint32_t iterations = 30);
GAZEBO_VISIBLE void run();
GAZEBO_VISIBLE void stop();
GAZEBO_VISIBLE void fini();
GAZEBO_VISIBLE bool is_stopped();
GAZEBO_VISIBLE void clear_buffers();
GAZEBO_VISIBLE void pause_incoming(bool pause);
GAZEBO_VISIBLE void get_topic_namespaces(std::list<std::string>& namespaces);
GAZEBO_VISIBLE bool waitForNamespaces(const common::Time& most);
GAZEBO_VISIBLE std::map<std::string, std::list<std::string>> getAdvertisedTopics();
GAZEBO_VISIBLE std::list<std::string> getAdvertisedTopics(const std::string& type);
GAZEBO_VISIBLE std::string getTopicMsgType(const std::string& topic);
GAZEBO_VISIBLE void requestNoReply(const std::string& world, const std::string& request, const std::string& data = "");
GAZEBO_VISIBLE void requestNoReply(NodePtr node, const std::string& request, const std::string& data = "");

template <typename M>
void publish(const std::string& topic, const google::protobuf::Message& message)
{
  const NodePtr node(new Node);
  node->Init();
  node->Publish<M>(topic, message);
}

}  // namespace transport
}  // namespace gazebo
