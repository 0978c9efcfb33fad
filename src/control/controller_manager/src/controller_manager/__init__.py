"""The controller manager: loads, starts, switches, stops and unloads controllers inside a robot's process.

A robot's main loop::

    manager = ControllerManager(robot_hw, "/arm")
    while running:
        robot_hw.read(time, period)
        manager.update(time, period)
        robot_hw.write(time, period)
    manager.shutdown()

The services live in ``<namespace>/controller_manager`` and run in threads of rospy.
"""
from .manager import ControllerManager

__all__ = ["ControllerManager"]
