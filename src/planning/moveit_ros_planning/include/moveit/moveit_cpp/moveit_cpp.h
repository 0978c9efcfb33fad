#error "moveit_cpp::MoveItCpp plans in its own process, which does not exist here: use moveit/move_group_interface/move_group_interface.h (docs/differences.md, 'MoveIt in C++')"
