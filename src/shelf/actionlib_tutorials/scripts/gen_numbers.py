#!/usr/bin/env python3
import node_signals

with node_signals.silent():
    from actionlib_tutorials import averaging

    node_signals.leave(averaging.generate())
