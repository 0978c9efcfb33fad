// Noetic's brings ROS_INFO ... and ros::package; Debian's is that of ROS 2 and does not.
#ifndef NOETIC_COMPATIBILITY_PLUGINLIB_CLASS_LOADER_HPP
#define NOETIC_COMPATIBILITY_PLUGINLIB_CLASS_LOADER_HPP
#include <ros/console.h>
#include <ros/package.h>
#endif
#include_next <pluginlib/class_loader.hpp>
