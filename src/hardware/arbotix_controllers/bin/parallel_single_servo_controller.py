#!/usr/bin/env python3
import node_signals

with node_signals.silent():
    from arbotix_controllers.topics import linkage

if __name__ == "__main__":
    linkage()
