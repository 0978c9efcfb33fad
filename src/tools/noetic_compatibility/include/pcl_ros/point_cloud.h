// Noetic's PCL has boost's pointers, as roscpp: publisher.publish(cloud) and callbacks with PointCloud::ConstPtr take them as they are.
// Debian's PCL has std's, which are made to do the same here.
#ifndef NOETIC_COMPATIBILITY_PCL_ROS_POINT_CLOUD_H
#define NOETIC_COMPATIBILITY_PCL_ROS_POINT_CLOUD_H
#include_next <pcl_ros/point_cloud.h>

#if PCL_VERSION_COMPARE(>=, 1, 11, 0)
#include <noetic_compatibility/std_pointers.h>
NOETIC_COMPATIBILITY_STD_POINTERS(template <typename T>, pcl::PointCloud<T>)
#endif
#endif
