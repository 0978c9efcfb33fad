// The old name of the header.
#ifndef NOETIC_COMPATIBILITY_PLUGINLIB_CLASS_LOADER_H
#define NOETIC_COMPATIBILITY_PLUGINLIB_CLASS_LOADER_H
#include <pluginlib/class_loader.hpp>
#endif
