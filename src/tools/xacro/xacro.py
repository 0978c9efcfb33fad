#!/usr/bin/env python3
# The old name of the command.
import sys

sys.path.pop(0)  # the script's own directory: its xacro.py would be found before the module of that name
from noetic_xacro.cli import main  # noqa: E402

main()
