// NOETIC_COMPATIBILITY_STD_POINTERS(TEMPLATE, MESSAGE): a message whose library has std's pointers, where Noetic's has boost's as roscpp,
// is published through them and handed to callbacks by them. TEMPLATE is `template <>` or the parameters of MESSAGE. No semicolon follows.
#ifndef NOETIC_COMPATIBILITY_STD_POINTERS_H
#define NOETIC_COMPATIBILITY_STD_POINTERS_H
#include <ros/node_handle.h>

#include <memory>

namespace noetic_compatibility
{
// What a callback asks for by its parameter's type.
template <typename M>
struct ConstParameter
{
  typedef M Message;
  typedef ros::MessageEvent<Message const> Event;
  typedef std::shared_ptr<const Message> Parameter;
  static const bool is_const = true;
  static Parameter getParameter(const Event& event) { return Received<Message>(event.getMessage()); }
};
template <typename M>
struct MutableParameter
{
  typedef M Message;
  typedef ros::MessageEvent<Message const> Event;
  typedef std::shared_ptr<Message> Parameter;
  static const bool is_const = false;
  static Parameter getParameter(const Event& event)
  {
    const boost::shared_ptr<Message> kept = ros::MessageEvent<Message>(event).getMessage();
    return Parameter(kept.get(), [kept](Message*) {});
  }
};
}  // namespace noetic_compatibility

// A pointer to a message is sent as the message.
#define NOETIC_COMPATIBILITY_SENT_AS(TEMPLATE, POINTER, ...)                                           \
  namespace message_traits                                                                             \
  {                                                                                                    \
  TEMPLATE struct MD5Sum<POINTER> : MD5Sum<__VA_ARGS__>                                                \
  {                                                                                                    \
    using MD5Sum<__VA_ARGS__>::value;                                                                  \
    static const char* value(const POINTER&) { return MD5Sum<__VA_ARGS__>::value(); }                  \
  };                                                                                                   \
  TEMPLATE struct DataType<POINTER> : DataType<__VA_ARGS__>                                            \
  {                                                                                                    \
    using DataType<__VA_ARGS__>::value;                                                                \
    static const char* value(const POINTER&) { return DataType<__VA_ARGS__>::value(); }                \
  };                                                                                                   \
  }                                                                                                    \
  namespace serialization                                                                              \
  {                                                                                                    \
  TEMPLATE struct Serializer<POINTER>                                                                  \
  {                                                                                                    \
    template <typename Stream>                                                                         \
    static void write(Stream& stream, const POINTER& message)                                          \
    {                                                                                                  \
      stream.next(*message);                                                                           \
    }                                                                                                  \
    static uint32_t serializedLength(const POINTER& message) { return serializationLength(*message); } \
  };                                                                                                   \
  }

#define NOETIC_COMPATIBILITY_STD_POINTERS(TEMPLATE, ...)                                                                      \
  namespace noetic_compatibility                                                                                              \
  {                                                                                                                           \
  TEMPLATE struct HasStdPointers<__VA_ARGS__> : std::true_type                                                                \
  {                                                                                                                           \
  };                                                                                                                          \
  }                                                                                                                           \
  namespace ros                                                                                                               \
  {                                                                                                                           \
  NOETIC_COMPATIBILITY_SENT_AS(TEMPLATE, std::shared_ptr<__VA_ARGS__>, __VA_ARGS__)                                           \
  NOETIC_COMPATIBILITY_SENT_AS(TEMPLATE, std::shared_ptr<const __VA_ARGS__>, __VA_ARGS__)                                     \
  TEMPLATE struct ParameterAdapter<const std::shared_ptr<const __VA_ARGS__>&>                                                 \
    : noetic_compatibility::ConstParameter<__VA_ARGS__>                                                                       \
  {                                                                                                                           \
  };                                                                                                                          \
  TEMPLATE struct ParameterAdapter<std::shared_ptr<const __VA_ARGS__>> : noetic_compatibility::ConstParameter<__VA_ARGS__>    \
  {                                                                                                                           \
  };                                                                                                                          \
  TEMPLATE struct ParameterAdapter<const std::shared_ptr<__VA_ARGS__>&> : noetic_compatibility::MutableParameter<__VA_ARGS__> \
  {                                                                                                                           \
  };                                                                                                                          \
  TEMPLATE struct ParameterAdapter<std::shared_ptr<__VA_ARGS__>> : noetic_compatibility::MutableParameter<__VA_ARGS__>        \
  {                                                                                                                           \
  };                                                                                                                          \
  }
#endif
