#error "collision_detection::CollisionEnvFCL does not exist here: use planning_scene::PlanningScene and its getCollisionEnv() (docs/differences.md, 'MoveIt in C++')"
