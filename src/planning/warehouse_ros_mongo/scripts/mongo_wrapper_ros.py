#!/usr/bin/env python3
"""The node of warehouse.launch; see moveit_ros_warehouse.server."""

import sys

import node_signals

with node_signals.silent():
    from moveit_ros_warehouse.server import main

    node_signals.leave(main(sys.argv[1:]))
