#error "Collision checks with Bullet do not exist here: planning_scene::PlanningScene checks with FCL (docs/differences.md, 'MoveIt in C++')"
