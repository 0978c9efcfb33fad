// The old name of the header.
#ifndef NOETIC_COMPATIBILITY_PLUGINLIB_CLASS_LIST_MACROS_H
#define NOETIC_COMPATIBILITY_PLUGINLIB_CLASS_LIST_MACROS_H
#include <pluginlib/class_list_macros.hpp>
#endif
