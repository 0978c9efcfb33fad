#!/usr/bin/env python3
import node_signals

with node_signals.silent():
    from actionlib_tutorials import fibonacci

    node_signals.leave(fibonacci.serve())
