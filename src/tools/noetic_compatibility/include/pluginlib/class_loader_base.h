// The old name of the header.
#ifndef NOETIC_COMPATIBILITY_PLUGINLIB_CLASS_LOADER_BASE_H
#define NOETIC_COMPATIBILITY_PLUGINLIB_CLASS_LOADER_BASE_H
#include <pluginlib/class_loader_base.hpp>
#endif
