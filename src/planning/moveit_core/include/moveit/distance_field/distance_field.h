#error "Distance fields do not exist here: planning_scene::PlanningScene::distanceToCollision gives distances (docs/differences.md, 'MoveIt in C++')"
