"""Which controllers execute a trajectory."""

from __future__ import annotations

from collections.abc import Sequence

import rospy
from moveit_core.controller_manager import ControllerManager
from moveit_core.errors import one_line
from plugin_loader import PluginError, find_plugins

from . import _execution  # type: ignore[attr-defined]  # compiled

_SIMPLE = "moveit_simple_controller_manager/MoveItSimpleControllerManager"
_WORDS = {
    "simple": _SIMPLE,
    "fake": "moveit_fake_controller_manager/MoveItFakeControllerManager",
    "ros_control": "moveit_ros_control_interface::MoveItControllerManager",
}


def load_manager(model, namespace: str = "~") -> ControllerManager | None:
    """The controller manager that ``~moveit_controller_manager`` names; None (and an error line) if there is none.

    :param model: the robot. :param namespace: where the parameter is.
    """
    found, problems = find_plugins("moveit_core")
    parameter = rospy.resolve_name(namespace + "moveit_controller_manager")
    name = rospy.get_param(namespace + "moveit_controller_manager", "")
    managers = {known: plugin for known, plugin in found.items() if plugin.base.endswith("MoveItControllerManager")}
    if name and not isinstance(name, str):
        rospy.logerr(
            "parameter %s is %s, where the name of a controller manager is expected: trajectories are planned, but cannot be executed",
            parameter,
            one_line(repr(name), 60),
        )
        return None
    if not name:
        rospy.logerr(
            "Failed to load any controller manager: parameter %s is not set (trajectory_execution.launch.xml "
            "sets it). "
            "Trajectories are planned, but cannot be executed",
            parameter,
        )
        return None
    if name not in managers and _meant(name, namespace) in managers:
        rospy.logwarn(
            "parameter %s is '%s', which is no controller manager; it is taken for the word by which "
            "trajectory_execution.launch.xml chooses a file: %s is used",
            parameter,
            name,
            _meant(name, namespace),
        )
        name = _meant(name, namespace)
    if name not in managers:
        rospy.logerr("Exception while loading controller manager '%s': nobody exports it; there are: %s", name, ", ".join(sorted(managers)))
        for problem in problems:
            rospy.logwarn("%s", problem)
        return None
    try:
        return managers[name].load()(model, namespace)
    except PluginError as error:
        rospy.logerr("Exception while loading controller manager '%s': %s", name, error)
        return None


def _meant(name: str, namespace: str) -> str:
    """The manager behind a word of launch files: trajectory_execution.launch.xml passes on "simple", "fake" or the robot's name,
    with which it finds the next file, under the very argument in which that file may have its manager as a default."""
    if "/" in name or "::" in name:  # somebody's class
        return ""
    return _WORDS.get(name, _SIMPLE if rospy.get_param(namespace + "controller_list", None) else "")


class ControllerChoice:
    """Chooses controllers, by the laws that TrajectoryExecutionManager has, and makes them active."""

    def __init__(self, manager: ControllerManager, manage: bool):
        self._manager = manager
        self._manage = manage

    def choose(self, wanted: set[str]) -> list[str]:
        """Names of the controllers that together move the joints ``wanted``; empty if none do."""
        manager = self._manager
        known = [
            _execution.Controller(name, set(manager.joints(name)), active=manager.is_active(name), preferred=manager.is_default(name))
            for name in manager.controllers()
        ]
        return _execution.choose(wanted, known, self._manage)

    def activate(self, controllers: Sequence[str]) -> bool:
        """Make ``controllers`` active, and inactive those that hold their joints, where this node may switch at all."""
        idle = [name for name in controllers if not self._manager.is_active(name)]
        if not idle:
            return True
        if not self._manage:
            return False
        joints = {joint for name in idle for joint in self._manager.joints(name)}
        holders = [
            name for name in self._manager.active_controllers() if name not in controllers and joints & set(self._manager.joints(name))
        ]
        return self._manager.switch(idle, holders)
