#pragma once

#include <moveit_msgs/MotionPlanRequest.h>

namespace planning_interface
{
typedef moveit_msgs::MotionPlanRequest MotionPlanRequest;
}
