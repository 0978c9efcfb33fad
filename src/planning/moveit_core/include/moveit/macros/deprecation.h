#pragma once

#ifndef MOVEIT_DEPRECATED
#define MOVEIT_DEPRECATED __attribute__((deprecated))
#endif
