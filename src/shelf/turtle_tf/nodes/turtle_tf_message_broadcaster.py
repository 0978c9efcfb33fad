#!/usr/bin/env python3
import node_signals

with node_signals.silent():
    from turtle_tf import nodes

    node_signals.leave(nodes.broadcast_points())
