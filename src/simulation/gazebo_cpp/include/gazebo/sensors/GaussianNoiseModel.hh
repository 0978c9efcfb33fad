#pragma once
#include <gazebo/sensors/Noise.hh>
