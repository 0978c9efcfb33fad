// The version of MoveIt whose interfaces these are.
#pragma once

#define MOVEIT_VERSION_STR "1.1.14"

#define MOVEIT_VERSION_MAJOR 1
#define MOVEIT_VERSION_MINOR 1
#define MOVEIT_VERSION_PATCH 14
#define MOVEIT_VERSION_EXTRA ""

// #if MOVEIT_VERSION >= MOVEIT_VERSION_CHECK(1, 0, 0)
#define MOVEIT_VERSION_CHECK(major, minor, patch) ((major << 16) | (minor << 8) | (patch))
#define MOVEIT_VERSION MOVEIT_VERSION_CHECK(MOVEIT_VERSION_MAJOR, MOVEIT_VERSION_MINOR, MOVEIT_VERSION_PATCH)
