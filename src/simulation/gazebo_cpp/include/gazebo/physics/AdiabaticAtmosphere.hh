#pragma once
#include <gazebo/physics/Atmosphere.hh>
