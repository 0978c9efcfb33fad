#!/usr/bin/env python3
import node_signals

with node_signals.silent():
    from turtle_tf import turtles

    node_signals.leave(turtles.broadcast_points("turtle_tf2_msg_broadcaster"))
