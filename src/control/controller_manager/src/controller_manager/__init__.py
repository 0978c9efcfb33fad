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

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from controller_manager.manager import ControllerManager

__all__ = ["ControllerManager"]


def __getattr__(name: str) -> Any:  # spawner wants its own module from here, and no more
    if name in ("ControllerManager", "manager"):
        manager = import_module(f"{__name__}.manager")
        return manager if name == "manager" else manager.ControllerManager
    raise AttributeError(f"module '{__name__}' has no attribute '{name}'")
