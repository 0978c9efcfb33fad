#pragma once

#define MOVEIT_KINEMATICS_BASE_EXPORT __attribute__((visibility("default")))
