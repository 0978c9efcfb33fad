#error "There is one collision detector here and nothing to allocate: use planning_scene::PlanningScene and its getCollisionEnv() (docs/differences.md, 'MoveIt in C++')"
