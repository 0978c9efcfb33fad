// Noetic's ros/node_handle.h brings boost/bind.hpp, and with it _1, _2 ... without a namespace; Debian's no longer does.
#ifndef NOETIC_COMPATIBILITY_ROS_NODE_HANDLE_H
#define NOETIC_COMPATIBILITY_ROS_NODE_HANDLE_H
#ifndef BOOST_BIND_GLOBAL_PLACEHOLDERS
#define BOOST_BIND_GLOBAL_PLACEHOLDERS  // no note about them at every file
#endif
#include <boost/bind.hpp>
#endif
#include_next <ros/node_handle.h>
