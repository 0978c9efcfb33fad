"""roslaunch for an examination: ``python3 -m lab_check.examination.guarded_roslaunch roslaunch-arguments...``

In the simulator's place stands who asks the examiner for it (:mod:`.simulator`). Windows stay shut: nobody looks, and a machine that marks
has no display. The rest is the launch file's. All of this runs in the submission's world, and is believed nothing.
"""

from __future__ import annotations

import sys
from typing import Any

from node_signals import quick_start

quick_start.prepare()  # before roslaunch is imported
import roslaunch  # noqa: E402
from roslaunch.config import ROSLaunchConfig  # noqa: E402

from lab_check.examination.window_nodes import is_window  # noqa: E402

SIMULATOR = {"gzserver", "gazebo", "debug", "gdbrun", "perf"}


def hold() -> None:
    """From here on each node that a launch file adds is looked at first."""
    add = ROSLaunchConfig.add_node

    def add_node(self: ROSLaunchConfig, node: roslaunch.core.Node, core: bool = False, verbose: bool = True) -> Any:
        if is_window(node.package, node.type):
            print(f"[lab_check] the window {node.package}/{node.type} is left out", flush=True)
            return None
        if node.package == "gazebo_ros" and node.type in SIMULATOR:
            node.package, node.type = "lab_check", "gzserver"
            node.launch_prefix = None
            node.respawn = False
        return add(self, node, core=core, verbose=verbose)

    ROSLaunchConfig.add_node = add_node


def main() -> None:
    hold()
    roslaunch.main(["roslaunch", *sys.argv[1:]])


if __name__ == "__main__":
    main()
