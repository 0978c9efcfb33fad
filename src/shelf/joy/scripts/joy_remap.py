#!/usr/bin/env python3
import node_signals

with node_signals.silent():
    from joystick.remap import main

    node_signals.leave(main())
