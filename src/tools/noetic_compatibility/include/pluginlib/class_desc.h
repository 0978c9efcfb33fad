// The old name of the header.
#ifndef NOETIC_COMPATIBILITY_PLUGINLIB_CLASS_DESC_H
#define NOETIC_COMPATIBILITY_PLUGINLIB_CLASS_DESC_H
#include <pluginlib/class_desc.hpp>
#endif
