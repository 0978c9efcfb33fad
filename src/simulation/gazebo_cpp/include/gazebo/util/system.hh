#pragma once
#include <gazebo/gazebo_config.h>
#define GAZEBO_VISIBLE __attribute__((visibility("default")))
#define GAZEBO_HIDDEN __attribute__((visibility("hidden")))
#define GZ_COMMON_VISIBLE GAZEBO_VISIBLE
#define GZ_PHYSICS_VISIBLE GAZEBO_VISIBLE
#define GZ_SENSORS_VISIBLE GAZEBO_VISIBLE
#define GZ_TRANSPORT_VISIBLE GAZEBO_VISIBLE
#define GZ_MSGS_VISIBLE GAZEBO_VISIBLE
#define GZ_UTIL_VISIBLE GAZEBO_VISIBLE
#define GZ_PLUGIN_VISIBLE GAZEBO_VISIBLE
#ifndef GAZEBO_DEPRECATED
#define GAZEBO_DEPRECATED(version) __attribute__((deprecated))
#endif
