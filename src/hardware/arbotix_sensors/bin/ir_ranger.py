#!/usr/bin/env python3
import node_signals

with node_signals.silent():
    from arbotix_sensors.rangers import ir_ranger

if __name__ == "__main__":
    ir_ranger()
