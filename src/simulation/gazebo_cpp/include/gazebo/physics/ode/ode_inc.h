#pragma once
#include <gazebo/ode/ode.h>
