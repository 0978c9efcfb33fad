#!/usr/bin/env python3
"""A command line for move_group; see moveit_commander.command_line."""

import node_signals

with node_signals.silent():
    from moveit_commander.command_line import main

try:
    node_signals.leave(main())
except KeyboardInterrupt:
    node_signals.leave(0)
