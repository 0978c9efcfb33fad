#pragma once
#include <gazebo/sensors/SensorManager.hh>
