"""The controller manager of a robot written in C++; called by core/manager.cpp, which has begun the interpreter where there was none."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .manager import ControllerManager

#: s after which a thread of Python that computes lets the control loop in
_SWITCH_INTERVAL = 0.0002

_own_node = False  # rospy's node was begun here


def make(robot: int, namespace: str, node: str, node_namespace: str) -> ControllerManager:
    """A controller manager in ``namespace``, which is absolute, for the C++ robot at an address.

    :param node, node_namespace: of the process; rospy's node has ``_controller_manager`` behind that name. In a process that is one
        of rospy already (the simulator) they do not count.
    """
    if "rospy" not in sys.modules:
        sys.argv = [node]
        os.environ["ROS_NAMESPACE"] = node_namespace
    import rospy  # reads both when it is imported
    from hardware_interface._robots import Robot
    from hardware_interface.compiled import CompiledRobotHW

    from .manager import ControllerManager

    global _own_node
    if not rospy.core.is_initialized():
        sys.setswitchinterval(_SWITCH_INTERVAL)
        rospy.init_node(f"{node}_controller_manager", disable_signals=True)
        _own_node = True
    return ControllerManager(CompiledRobotHW(Robot(robot, None)), namespace)


def end_node() -> None:
    """End rospy's node, if make() has begun it: for good, as rospy begins a node once in a process."""
    import rospy

    if _own_node:
        rospy.signal_shutdown("the robot's program ends")


def address_of(manager: ControllerManager, name: str) -> int:
    """Address of the C++ object of the controller ``name`` that ``manager`` has loaded; 0 if there is none, or it is Python's."""
    return next((getattr(loaded.controller, "address", 0) for loaded in manager.controllers if loaded.name == name), 0)


def add_loader(manager: ControllerManager, base: str, names: Callable[[], list[str]], create: Callable[[str], int]) -> None:
    """Let ``manager`` take the types of a loader in C++ too; ``base``, ``names`` and ``create`` as in ControllerTypes.add_loader."""
    manager.add_loader(base, names, create)
