#error "kinematics_metrics::KinematicsMetrics does not exist here: compute it from RobotState::getJacobian (docs/differences.md, 'MoveIt in C++')"
