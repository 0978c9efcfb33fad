#error "Constraint samplers do not exist here: ask move_group for a plan, or RobotState::setFromIK (docs/differences.md, 'MoveIt in C++')"
