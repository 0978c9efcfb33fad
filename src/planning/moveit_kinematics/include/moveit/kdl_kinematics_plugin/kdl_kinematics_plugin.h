#error "kdl_kinematics_plugin::KDLKinematicsPlugin has no class of its own here: load it by its name through pluginlib, as kinematics::KinematicsBase (docs/differences.md, 'MoveIt in C++')"
