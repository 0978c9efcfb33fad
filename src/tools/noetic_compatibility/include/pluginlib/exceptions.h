// The old name of the header.
#ifndef NOETIC_COMPATIBILITY_PLUGINLIB_EXCEPTIONS_H
#define NOETIC_COMPATIBILITY_PLUGINLIB_EXCEPTIONS_H
#include <pluginlib/exceptions.hpp>
#endif
