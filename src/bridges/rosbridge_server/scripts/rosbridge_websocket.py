#!/usr/bin/env python3
import node_signals

with node_signals.silent():
    from rosbridge_server.node import main

    node_signals.leave(main())
