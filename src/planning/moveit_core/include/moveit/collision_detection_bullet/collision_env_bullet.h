// There is no CollisionEnvBullet here: the checks of a scene are in CollisionEnv, by FCL.
#pragma once

#include <moveit/collision_detection/collision_env.h>
