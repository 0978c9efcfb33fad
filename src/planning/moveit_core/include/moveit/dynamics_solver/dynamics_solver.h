#error "dynamics_solver::DynamicsSolver does not exist here: use KDL's ChainIdSolver with kdl_parser (docs/differences.md, 'MoveIt in C++')"
