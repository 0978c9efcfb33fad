"""roslaunch for an examination: ``python3 -m lab_check.held_launch SEED roslaunch-arguments...``

The simulator starts paused, in lock-step, with the examination's seed, and the examiner lets its time pass. Windows stay shut: nobody
looks, and a machine that marks has no display. The rest is the launch file's.
"""
from __future__ import annotations

import os
import sys

from node_signals import quick_start

quick_start.prepare()  # before roslaunch is imported
import roslaunch  # noqa: E402
from roslaunch.config import ROSLaunchConfig  # noqa: E402

SIMULATOR = {"gzserver", "gazebo", "debug", "gdbrun", "perf"}
WINDOWS = {("rviz", "rviz"), ("gazebo_ros", "gzclient"), ("rqt_gui", "rqt_gui"), ("joint_state_publisher_gui", "joint_state_publisher_gui"),
           ("rqt_joint_trajectory_controller", "rqt_joint_trajectory_controller"), ("rqt_robot_steering", "rqt_robot_steering")}


def hold(seed: int, platform_python: str) -> None:
    """From here on each node that a launch file adds is looked at first."""
    add = ROSLaunchConfig.add_node

    def add_node(self, node, core=False, verbose=True):
        if (node.package, node.type) in WINDOWS or (node.package.startswith("rqt_") and node.type == node.package):
            print(f"[lab_check] the window {node.package}/{node.type} is left out", flush=True)
            return None
        if node.package == "gazebo_ros" and node.type in SIMULATOR:
            node.package, node.type = "lab_check", "gzserver"
            node.args = f"{_world_only(node.args)} --pause --lockstep --seed {seed}"
            # Modules of the submission must not stand in for the simulator's.
            node.launch_prefix = f"env PYTHONPATH={platform_python}"
            node.respawn = False
        return add(self, node, core=core, verbose=verbose)

    ROSLaunchConfig.add_node = add_node


def _world_only(arguments: str) -> str:
    """Without a seed of its own."""
    words, kept = (arguments or "").split(), []
    skip = False
    for word in words:
        if skip or word.startswith("--seed="):
            skip = False
        elif word == "--seed":
            skip = True
        else:
            kept.append(word)
    return " ".join(kept)


def main() -> None:
    hold(int(sys.argv[1]), os.environ.get("LAB_CHECK_PLATFORM_PYTHON", os.environ.get("PYTHONPATH", "")))
    roslaunch.main(["roslaunch", *sys.argv[2:]])


if __name__ == "__main__":
    main()
