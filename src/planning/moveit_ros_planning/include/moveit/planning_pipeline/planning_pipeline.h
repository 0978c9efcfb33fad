#error "planning_pipeline::PlanningPipeline does not exist in C++ here: ask move_group for a plan (moveit/move_group_interface/move_group_interface.h) (docs/differences.md, 'MoveIt in C++')"
