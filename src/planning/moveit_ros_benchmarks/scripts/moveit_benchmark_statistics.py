#!/usr/bin/env python3
"""Logs of benchmarks into a database for Planner Arena; see moveit_ros_benchmarks.statistics."""

import signal

signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C while the imports take their second
import sys  # noqa: E402

from moveit_ros_benchmarks.statistics import main  # noqa: E402

sys.exit(main())
