#!/usr/bin/env python3
import node_signals

with node_signals.silent():
    from axis_camera_ptz.node import main

    node_signals.leave(main())
