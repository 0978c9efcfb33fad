// The master of Gazebo's transport: who publishes which topic where, and who wants to hear of it.
#pragma once
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gazebo/msgs/msgs.hh>

namespace gazebo
{
namespace transport
{

/// It speaks with its clients, which have numbers, in packets. Not thread-safe.
class Master
{
public:
  using Send = std::function<void(int client, const std::string& type, const google::protobuf::Message& message)>;

  /// \param spaces what "~" may stand for behind /gazebo/; the first is that of who does not say
  Master(std::vector<std::string> spaces, Send send) : spaces_(std::move(spaces)), send_(std::move(send)) {}
  void Add(int client);     // and greets it
  void Remove(int client);  // and all that it publishes and hears
  void Handle(int client, const msgs::Packet& packet);

private:
  template <typename M>
  using Entries = std::vector<std::pair<int, M>>;
  void all(const std::string& type, const google::protobuf::Message& message);
  void advertise(int client, const msgs::Publish& publisher);
  void unadvertise(const msgs::Publish& publisher);
  void subscribe(int client, const msgs::Subscribe& subscriber);
  void unsubscribe(const msgs::Subscribe& subscriber);
  void answer(int client, const msgs::Request& request);
  msgs::Publishers publishers() const;
  msgs::TopicInfo info(const std::string& topic) const;

  std::vector<std::string> spaces_;
  Send send_;
  std::set<int> clients_;
  Entries<msgs::Publish> publishers_;
  Entries<msgs::Subscribe> subscribers_;
};

}  // namespace transport
}  // namespace gazebo
