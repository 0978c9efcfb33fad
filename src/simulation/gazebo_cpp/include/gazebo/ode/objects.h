// Gazebo has an ODE of its own under this name; here it is the system's.
#pragma once
#include <ode/objects.h>
