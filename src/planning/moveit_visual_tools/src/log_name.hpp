#pragma once

namespace moveit_visual_tools {
/// What upstream's class logs under; people set the level of this name.
constexpr char LOGNAME[] = "visual_tools";
}  // namespace moveit_visual_tools
