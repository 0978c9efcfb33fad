#!/usr/bin/env python3
import node_signals

with node_signals.silent():
    from keyboard_teleop.node import main

if __name__ == "__main__":
    main()
