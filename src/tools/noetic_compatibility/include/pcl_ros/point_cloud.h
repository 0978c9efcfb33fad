// Noetic's PCL has boost's pointers, as roscpp: publisher.publish(cloud) and callbacks with PointCloud::ConstPtr take them as they are.
// Debian's PCL has std's, which are made to do the same here.
#ifndef NOETIC_COMPATIBILITY_PCL_ROS_POINT_CLOUD_H
#define NOETIC_COMPATIBILITY_PCL_ROS_POINT_CLOUD_H
#include_next <pcl_ros/point_cloud.h>

#if PCL_VERSION_COMPARE(>=, 1, 11, 0)
namespace noetic_compatibility
{
// subscribe<Cloud>("points", 1, callback) takes callbacks with Cloud::ConstPtr, too.
template <typename T>
struct HasStdPointers<pcl::PointCloud<T>> : std::true_type
{
};
}  // namespace noetic_compatibility

namespace ros
{
namespace message_traits
{
// A pointer to a cloud is sent as the cloud.
template <typename T>
struct MD5Sum<std::shared_ptr<pcl::PointCloud<T>>> : MD5Sum<pcl::PointCloud<T>>
{
  using MD5Sum<pcl::PointCloud<T>>::value;
  static const char* value(const std::shared_ptr<pcl::PointCloud<T>>&) { return MD5Sum<pcl::PointCloud<T>>::value(); }
};
template <typename T>
struct DataType<std::shared_ptr<pcl::PointCloud<T>>> : DataType<pcl::PointCloud<T>>
{
  using DataType<pcl::PointCloud<T>>::value;
  static const char* value(const std::shared_ptr<pcl::PointCloud<T>>&) { return DataType<pcl::PointCloud<T>>::value(); }
};
template <typename T>
struct MD5Sum<std::shared_ptr<const pcl::PointCloud<T>>> : MD5Sum<pcl::PointCloud<T>>
{
  using MD5Sum<pcl::PointCloud<T>>::value;
  static const char* value(const std::shared_ptr<const pcl::PointCloud<T>>&) { return MD5Sum<pcl::PointCloud<T>>::value(); }
};
template <typename T>
struct DataType<std::shared_ptr<const pcl::PointCloud<T>>> : DataType<pcl::PointCloud<T>>
{
  using DataType<pcl::PointCloud<T>>::value;
  static const char* value(const std::shared_ptr<const pcl::PointCloud<T>>&) { return DataType<pcl::PointCloud<T>>::value(); }
};
}  // namespace message_traits

namespace serialization
{
template <typename T>
struct Serializer<std::shared_ptr<pcl::PointCloud<T>>>
{
  template <typename Stream>
  static void write(Stream& stream, const std::shared_ptr<pcl::PointCloud<T>>& cloud)
  {
    stream.next(*cloud);
  }
  static uint32_t serializedLength(const std::shared_ptr<pcl::PointCloud<T>>& cloud) { return serializationLength(*cloud); }
};
template <typename T>
struct Serializer<std::shared_ptr<const pcl::PointCloud<T>>>
{
  template <typename Stream>
  static void write(Stream& stream, const std::shared_ptr<const pcl::PointCloud<T>>& cloud)
  {
    stream.next(*cloud);
  }
  static uint32_t serializedLength(const std::shared_ptr<const pcl::PointCloud<T>>& cloud)
  {
    return serializationLength(*cloud);
  }
};
}  // namespace serialization

// What a callback asks for by its parameter's type.
template <typename T>
struct ParameterAdapter<const std::shared_ptr<const pcl::PointCloud<T>>&>
{
  typedef pcl::PointCloud<T> Message;
  typedef ros::MessageEvent<Message const> Event;
  typedef std::shared_ptr<const Message> Parameter;
  static const bool is_const = true;
  static Parameter getParameter(const Event& event) { return pcl::pcl_ptr(event.getMessage()); }
};
template <typename T>
struct ParameterAdapter<std::shared_ptr<const pcl::PointCloud<T>>>
  : ParameterAdapter<const std::shared_ptr<const pcl::PointCloud<T>>&>
{
};
template <typename T>
struct ParameterAdapter<const std::shared_ptr<pcl::PointCloud<T>>&>
{
  typedef pcl::PointCloud<T> Message;
  typedef ros::MessageEvent<Message const> Event;
  typedef std::shared_ptr<Message> Parameter;
  static const bool is_const = false;
  static Parameter getParameter(const Event& event) { return pcl::pcl_ptr(ros::MessageEvent<Message>(event).getMessage()); }
};
template <typename T>
struct ParameterAdapter<std::shared_ptr<pcl::PointCloud<T>>> : ParameterAdapter<const std::shared_ptr<pcl::PointCloud<T>>&>
{
};
}  // namespace ros
#endif
#endif
