// The same as for PointCloud<T> in pcl_ros/point_cloud.h, for the message that PCL has beside it: callbacks with PCLPointCloud2::ConstPtr.
#ifndef NOETIC_COMPATIBILITY_PCL_CONVERSIONS_PCL_CONVERSIONS_H
#define NOETIC_COMPATIBILITY_PCL_CONVERSIONS_PCL_CONVERSIONS_H
#include_next <pcl_conversions/pcl_conversions.h>

#include <pcl/pcl_config.h>
#if PCL_VERSION_COMPARE(>=, 1, 11, 0)
#include <noetic_compatibility/std_pointers.h>
NOETIC_COMPATIBILITY_STD_POINTERS(template <>, pcl::PCLPointCloud2)
#endif
#endif
