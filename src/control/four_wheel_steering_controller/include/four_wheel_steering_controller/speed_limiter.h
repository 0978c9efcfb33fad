// The one of diff_drive_controller.
#pragma once

#include <diff_drive_controller/speed_limiter.h>

namespace four_wheel_steering_controller
{

using diff_drive_controller::SpeedLimiter;

}  // namespace four_wheel_steering_controller
