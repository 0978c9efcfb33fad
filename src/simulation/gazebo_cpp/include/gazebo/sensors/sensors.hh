#pragma once
#include <gazebo/gazebo_config.h>
#include <gazebo/sensors/SensorTypes.hh>
