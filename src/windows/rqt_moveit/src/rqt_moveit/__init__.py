"""Whether MoveIt is there, for rqt."""
