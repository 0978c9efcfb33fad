#!/usr/bin/env python3
import node_signals

with node_signals.silent():
    from velocity_mux.joystick import main

    node_signals.leave(main())
