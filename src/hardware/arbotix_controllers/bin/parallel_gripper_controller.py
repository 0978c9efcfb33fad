#!/usr/bin/env python3
import node_signals

with node_signals.silent():
    from arbotix_controllers.topics import two_sides

if __name__ == "__main__":
    two_sides()
