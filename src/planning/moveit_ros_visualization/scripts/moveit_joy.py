#!/usr/bin/env python3
"""The node `moveit_joy`; see moveit_ros_visualization.joystick."""

import node_signals

with node_signals.silent():
    from moveit_ros_visualization.joystick import main

    node_signals.leave(main())
