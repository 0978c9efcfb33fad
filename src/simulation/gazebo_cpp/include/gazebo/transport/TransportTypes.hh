#pragma once
#ifndef BOOST_BIND_GLOBAL_PLACEHOLDERS
#define BOOST_BIND_GLOBAL_PLACEHOLDERS  // without Boost's note about them
#endif
#include <boost/bind.hpp>  // plugins of others write boost::bind(..., _1) and include nothing for it: Noetic's Boost brought it everywhere
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
