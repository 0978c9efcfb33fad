#pragma once
#include <boost/shared_ptr.hpp>
#include <google/protobuf/message.h>

#include <gazebo/util/system.hh>

namespace gazebo
{
namespace transport
{
class Publisher;
class Subscriber;
class Node;
typedef boost::shared_ptr<google::protobuf::Message> MessagePtr;
typedef boost::shared_ptr<Publisher> PublisherPtr;
typedef boost::shared_ptr<Subscriber> SubscriberPtr;
typedef boost::shared_ptr<Node> NodePtr;
}  // namespace transport
}  // namespace gazebo
