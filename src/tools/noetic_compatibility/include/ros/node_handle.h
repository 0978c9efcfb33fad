// Noetic's ros/node_handle.h brings boost/bind.hpp, and with it _1, _2 ... without a namespace; Debian's no longer does.
// And subscribe<Message>(...) takes callbacks for pointers of std where the message has those (noetic_compatibility::HasStdPointers,
// see pcl_ros/point_cloud.h): more templates in the class, nothing that another library would see.
#ifndef NOETIC_COMPATIBILITY_ROS_NODE_HANDLE_H
#define NOETIC_COMPATIBILITY_ROS_NODE_HANDLE_H
#ifndef BOOST_BIND_GLOBAL_PLACEHOLDERS
#define BOOST_BIND_GLOBAL_PLACEHOLDERS  // no note about them at every file
#endif
#include <boost/bind.hpp>

// All that ros/node_handle.h includes comes first, as one word in it is to mean more.
#include <ros/advertise_options.h>
#include <ros/advertise_service_options.h>
#include <ros/forwards.h>
#include <ros/init.h>
#include <ros/publisher.h>
#include <ros/rate.h>
#include <ros/service_client.h>
#include <ros/service_client_options.h>
#include <ros/service_server.h>
#include <ros/spinner.h>
#include <ros/steady_timer.h>
#include <ros/subscribe_options.h>
#include <ros/subscriber.h>
#include <ros/timer.h>
#include <ros/timer_options.h>
#include <ros/wall_timer.h>
#include <ros/wall_timer_options.h>
#include <xmlrpcpp/XmlRpcValue.h>
#include <boost/shared_ptr.hpp>
#include <memory>
#include <type_traits>

namespace noetic_compatibility
{
template <typename Message>
struct HasStdPointers : std::false_type
{
};

// What a subscription of Message by a callback with parameter P returns, if P is one of std's pointers to it.
template <typename Message, typename P, typename Bare = typename std::decay<P>::type>
using SubscribedByStdPointer =
    typename std::enable_if<HasStdPointers<Message>::value && (std::is_same<Bare, std::shared_ptr<const Message>>::value ||
                                                               std::is_same<Bare, std::shared_ptr<Message>>::value),
                            ros::Subscriber>::type;

// The same for what boost::bind() makes and for lambdas, which do not tell what they take.
template <typename Message, typename Callback>
using SubscribedByCallable =
    typename std::enable_if<HasStdPointers<Message>::value && std::is_class<Callback>::value, ros::Subscriber>::type;

// A received message as whichever pointer a callback wants.
template <typename Message>
class Received
{
public:
  explicit Received(const boost::shared_ptr<const Message>& message) : message_(message) {}
  operator boost::shared_ptr<const Message>() const { return message_; }
  operator std::shared_ptr<const Message>() const
  {
    const boost::shared_ptr<const Message> kept = message_;
    return std::shared_ptr<const Message>(kept.get(), [kept](const Message*) {});
  }

private:
  boost::shared_ptr<const Message> message_;
};

template <typename Message, typename Callback>
struct CallWithReceived
{
  Callback callback;
  void operator()(const boost::shared_ptr<const Message>& message) { callback(Received<Message>(message)); }
};
}  // namespace noetic_compatibility

// clang-format off
#define NOETIC_COMPATIBILITY_SUBSCRIBE(PARAMETERS, OBJECT, BOUND) \
  template <class M, PARAMETERS, class P> \
  noetic_compatibility::SubscribedByStdPointer<M, P> subscribe(const std::string& topic, uint32_t queue_size, OBJECT, \
                                                               const TransportHints& transport_hints = TransportHints()) \
  { \
    SubscribeOptions ops; \
    ops.template initByFullCallbackType<P>(topic, queue_size, BOUND); \
    ops.transport_hints = transport_hints; \
    return subscribe(ops); \
  }
#define NOETIC_COMPATIBILITY_COMMA ,
#pragma push_macro("private")
#undef private
#define private \
  NOETIC_COMPATIBILITY_SUBSCRIBE(class T, void (T::*fp)(P) NOETIC_COMPATIBILITY_COMMA T* obj, \
                                 boost::bind(fp, obj, boost::placeholders::_1)) \
  NOETIC_COMPATIBILITY_SUBSCRIBE(class T, void (T::*fp)(P) const NOETIC_COMPATIBILITY_COMMA T* obj, \
                                 boost::bind(fp, obj, boost::placeholders::_1)) \
  NOETIC_COMPATIBILITY_SUBSCRIBE(class R, R (*fp)(P), fp) \
  template <class M, class F> \
  noetic_compatibility::SubscribedByCallable<M, F> subscribe(const std::string& topic, uint32_t queue_size, F callback, \
                                                             const VoidConstPtr& tracked_object = VoidConstPtr(), \
                                                             const TransportHints& transport_hints = TransportHints()) \
  { \
    SubscribeOptions ops; \
    ops.template init<M>(topic, queue_size, noetic_compatibility::CallWithReceived<M, F>{callback}); \
    ops.tracked_object = tracked_object; \
    ops.transport_hints = transport_hints; \
    return subscribe(ops); \
  } \
private
// clang-format on
#include_next <ros/node_handle.h>
#pragma pop_macro("private")
#undef NOETIC_COMPATIBILITY_SUBSCRIBE
#undef NOETIC_COMPATIBILITY_COMMA
#else
#include_next <ros/node_handle.h>
#endif
