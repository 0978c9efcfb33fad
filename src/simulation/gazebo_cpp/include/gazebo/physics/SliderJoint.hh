#pragma once
#include <gazebo/physics/Joint.hh>
