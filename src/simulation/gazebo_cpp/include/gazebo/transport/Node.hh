#pragma once
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <boost/enable_shared_from_this.hpp>
#include <boost/function.hpp>
#include <boost/make_shared.hpp>
#include <boost/thread/mutex.hpp>

#include <gazebo/common/Console.hh>
#include <gazebo/common/Time.hh>
#include <gazebo/msgs/msgs.hh>
#include <gazebo/transport/Publisher.hh>
#include <gazebo/transport/Subscriber.hh>
#include <gazebo/common/common.hh>

namespace gazebo
{
namespace transport
{

/// "~" in a topic is /gazebo/<name of the world>, or the space that Init() was given.
class GAZEBO_VISIBLE Node : public boost::enable_shared_from_this<Node>
{
  /// Gets a message, or none and the bytes of one that another process has sent.
  using Raw = std::function<void(const boost::shared_ptr<google::protobuf::Message const>&, const std::string&)>;

public:
  Node();
  virtual ~Node();
  void Init(const std::string& space = "");
  bool TryInit(const common::Time& = common::Time(1, 0)) { return Init(), true; }
  bool IsInitialized() const { return !space_.empty(); }
  void Fini();
  std::string GetTopicNamespace() const { return space_; }
  std::string DecodeTopicName(const std::string& topic);
  std::string EncodeTopicName(const std::string& topic);
  unsigned int GetId() const { return id_; }
  std::string GetMsgType(const std::string& topic) const;

  template <typename M>
  PublisherPtr Advertise(const std::string& topic, unsigned int limit = 1000, double hz = 0)
  {
    return Advertise(topic, M().GetTypeName(), limit, hz);
  }
  PublisherPtr Advertise(const std::string& topic, const std::string& type, unsigned int limit = 1000, double hz = 0);
  template <typename M>
  void Publish(const std::string& topic, const google::protobuf::Message& message)
  {
    publishOnce(topic, message);
  }
  void Publish(const std::string& topic, const google::protobuf::Message& message) { publishOnce(topic, message); }

  template <typename M, typename T>
  SubscriberPtr Subscribe(const std::string& topic, void (T::*method)(const boost::shared_ptr<M const>&), T* object,
                          bool latching = false)
  {
    return subscribe<M>(
        topic, [object, method](const boost::shared_ptr<M const>& message) { (object->*method)(message); }, latching);
  }
  template <typename M>
  SubscriberPtr Subscribe(const std::string& topic, void (*function)(const boost::shared_ptr<M const>&), bool latching = false)
  {
    return subscribe<M>(topic, function, latching);
  }
  template <typename T>
  SubscriberPtr Subscribe(const std::string& topic, void (T::*method)(const std::string&), T* object, bool latching = false)
  {
    return listen(
        topic, "",
        [object, method](const auto& message, const std::string& bytes) {
          (object->*method)(message ? message->SerializeAsString() : bytes);
        },
        latching);
  }
  SubscriberPtr Subscribe(const std::string& topic, void (*function)(const std::string&), bool latching = false)
  {
    return SubscribeToBytes(topic, function, latching);
  }
  SubscriberPtr SubscribeToBytes(const std::string& topic, std::function<void(const std::string&)> function,
                                 bool latching = false)
  {
    return listen(
        topic, "",
        [function](const auto& message, const std::string& bytes) { function(message ? message->SerializeAsString() : bytes); },
        latching);
  }

private:
  template <typename M, typename F>
  SubscriberPtr subscribe(const std::string& topic, F function, bool latching)
  {
    const auto handed = [function](const boost::shared_ptr<google::protobuf::Message const>& message,
                                   const std::string& bytes) {
      boost::shared_ptr<M const> own = boost::dynamic_pointer_cast<M const>(message);
      if (!own)  // from another process, or of the same name and compiled by somebody else
      {
        const boost::shared_ptr<M> copy = boost::make_shared<M>();
        if (!copy->ParsePartialFromString(message ? message->SerializeAsString() : bytes) || !copy->IsInitialized())
        {
          gzerr << "a message that is no whole " << copy->GetTypeName() << " is ignored" << std::endl;
          return;
        }
        own = copy;
      }
      function(own);
    };
    return listen(topic, M().GetTypeName(), handed, latching);
  }
  void publishOnce(const std::string& topic, const google::protobuf::Message& message);
  SubscriberPtr listen(const std::string& topic, const std::string& type, Raw callback, bool latching);

  std::string space_;
  unsigned int id_;
};

}  // namespace transport
}  // namespace gazebo
