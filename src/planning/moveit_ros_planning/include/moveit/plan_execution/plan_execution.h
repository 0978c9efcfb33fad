#error "plan_execution::PlanExecution does not exist in C++ here: move_group executes (moveit/move_group_interface/move_group_interface.h) (docs/differences.md, 'MoveIt in C++')"
