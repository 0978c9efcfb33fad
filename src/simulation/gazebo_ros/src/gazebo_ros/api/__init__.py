"""Topics, services and parameters of the node ``gazebo``, one module per subject."""
