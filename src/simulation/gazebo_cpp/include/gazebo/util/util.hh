#pragma once
#include <gazebo/util/system.hh>
