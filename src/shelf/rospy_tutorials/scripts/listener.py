#!/usr/bin/env python3
import node_signals

with node_signals.silent():
    from rospy_tutorials import talking

    node_signals.leave(talking.listen())
