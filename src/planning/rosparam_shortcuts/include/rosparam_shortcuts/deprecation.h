#pragma once

#define ROSPARAM_SHORTCUTS_DEPRECATED __attribute__((deprecated))
