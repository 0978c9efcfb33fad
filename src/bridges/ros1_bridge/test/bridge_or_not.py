#!/usr/bin/env python3
"""The bridge where ROS 2 is installed; nothing where it is not, so that the test can say so."""

import sys

import ros2_side  # noqa: F401 - chooses the domain
from ros1_bridge.link import prefix
from ros1_bridge.node import dynamic_bridge

sys.argv[1:] = ["--bridge-all-topics", *sys.argv[1:]]
sys.exit(dynamic_bridge() if prefix() is not None else 0)
