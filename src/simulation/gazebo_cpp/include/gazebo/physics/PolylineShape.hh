#pragma once
#include <gazebo/physics/Shape.hh>
