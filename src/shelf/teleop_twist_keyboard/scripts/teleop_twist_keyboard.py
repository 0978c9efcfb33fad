#!/usr/bin/env python3
import node_signals

with node_signals.silent():
    from twist_keyboard.node import main

    node_signals.leave(main())
