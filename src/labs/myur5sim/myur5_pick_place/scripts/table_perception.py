#!/usr/bin/env python3
"""What RViz's tab Manipulation asks for; see myur5_pick_place.table_perception."""

import node_signals

with node_signals.silent():
    from myur5_pick_place.table_perception import main

    node_signals.leave(main())
