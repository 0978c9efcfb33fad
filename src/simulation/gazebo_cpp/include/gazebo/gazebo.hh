#pragma once
#include <gazebo/common/Plugin.hh>
#include <gazebo/gazebo_config.h>
#include <gazebo/gazebo_core.hh>
#include <gazebo/physics/PhysicsTypes.hh>

namespace gazebo
{
GAZEBO_VISIBLE void printVersion();
}  // namespace gazebo
