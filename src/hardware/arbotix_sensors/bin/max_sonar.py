#!/usr/bin/env python3
import node_signals

with node_signals.silent():
    from arbotix_sensors.rangers import max_sonar

if __name__ == "__main__":
    max_sonar()
