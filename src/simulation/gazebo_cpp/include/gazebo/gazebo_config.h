// Which Gazebo this stands in for; plugins ask by #if.
#pragma once
#define GAZEBO_MAJOR_VERSION 11
#define GAZEBO_MINOR_VERSION 0
#define GAZEBO_PATCH_VERSION 0
#define GAZEBO_VERSION "11.0"
#define GAZEBO_VERSION_FULL "11.0.0"
#define GAZEBO_VERSION_HEADER "Gazebo multi-robot simulator, version 11.0.0 (stand-in on ODE)\n"
#define HAVE_OPENAL 0
