#pragma once
#include <memory>
#include <string>

#include <boost/enable_shared_from_this.hpp>

#include <gazebo/common/Time.hh>
#include <gazebo/transport/TransportTypes.hh>
#include <gazebo/common/common.hh>

namespace gazebo
{
namespace transport
{

struct Topic;

/// Sends messages of one type to the subscribers of a topic in this process, which get them in a thread of the transport.
class GAZEBO_VISIBLE Publisher : public boost::enable_shared_from_this<Publisher>
{
public:
  /// \param hz how often at most, by the wall's clock; what comes sooner is dropped. 0: no limit
  Publisher(std::shared_ptr<Topic> topic, const std::string& type, unsigned int limit, double hz);
  ~Publisher();
  bool HasConnections() const;
  void WaitForConnection() const { WaitForConnection(common::Time(-1.0)); }
  bool WaitForConnection(const common::Time& timeout) const;  // negative: for ever
  void Publish(const google::protobuf::Message& message, bool block = false) { publish(message, block); }
  template <typename M>
  void Publish(M message, bool block = false)
  {
    publish(message, block);
  }
  unsigned int GetRemoteSubscriptionCount();
  unsigned int GetOutgoingCount() const;
  std::string GetTopic() const;
  std::string GetMsgType() const { return type_; }
  void SendMessage() {}
  void SetNode(NodePtr) {}
  std::string GetPrevMsg() const;
  MessagePtr GetPrevMsgPtr() const;
  void Fini();
  uint32_t Id() const { return id_; }

private:
  void publish(const google::protobuf::Message& message, bool block);
  std::shared_ptr<Topic> topic_;
  std::string type_;
  unsigned int limit_;
  double period_;
  common::Time last_;
  uint32_t id_;
};

}  // namespace transport
}  // namespace gazebo
