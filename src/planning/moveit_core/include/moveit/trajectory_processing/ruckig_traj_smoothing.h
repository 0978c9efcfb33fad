#error "trajectory_processing::RuckigSmoothing does not exist in C++ here: use TimeOptimalTrajectoryGeneration (docs/differences.md, 'MoveIt in C++')"
