#pragma once
#include <memory>
#include <string>

#include <gazebo/transport/TransportTypes.hh>
#include <gazebo/common/common.hh>

namespace gazebo
{
namespace transport
{

struct Subscription;

/// Messages come as long as it lives.
class GAZEBO_VISIBLE Subscriber
{
public:
  explicit Subscriber(std::shared_ptr<Subscription> subscription) : subscription_(std::move(subscription)) {}
  ~Subscriber() { Unsubscribe(); }
  std::string GetTopic() const;
  void Unsubscribe() const;  // waits for a callback that is under way, unless it is called there

private:
  std::shared_ptr<Subscription> subscription_;
};

}  // namespace transport
}  // namespace gazebo
