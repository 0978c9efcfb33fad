#pragma once

#define RVIZ_VISUAL_TOOLS_DEPRECATED __attribute__((deprecated))
