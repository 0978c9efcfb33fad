"""The controllers of ``controller_list``."""

from __future__ import annotations

from typing import Any

import rospy
from moveit_core.controller_manager import ControllerHandle, ControllerManager
from moveit_core.errors import one_line

from . import entries
from .actions import FollowJointTrajectoryHandle, GripperCommandHandle

HANDLES = {"FollowJointTrajectory": FollowJointTrajectoryHandle, "GripperCommand": GripperCommandHandle}


def read_controller_list(namespace: str, required=("name", "joints")) -> list[dict[str, Any]]:
    """The usable entries of ``controller_list`` in ``namespace``; what is wrong with others is told, one line each.

    :param required: keys that each must have.
    """
    parameter = rospy.resolve_name(namespace + "controller_list")
    listed = rospy.get_param(namespace + "controller_list", None)
    if listed is None:
        rospy.logerr(
            "No controller_list specified: parameter %s is not set; the controllers' YAML file is loaded "
            "there by "
            "the *_moveit_controller_manager.launch.xml that trajectory_execution.launch.xml includes",
            parameter,
        )
        return []
    if not isinstance(listed, list):
        rospy.logerr("Parameter controller_list should be specified as an array: %s is %s", parameter, one_line(repr(listed), 60))
        return []
    usable = []
    for number, entry in enumerate(listed):
        missing = [key for key in required if not isinstance(entry, dict) or key not in entry]
        if missing:
            rospy.logerr(
                "Name and joints must be specified for each controller: entry %d of %s lacks %s", number, parameter, ", ".join(missing)
            )
        elif not isinstance(entry["joints"], list):
            rospy.logerr("The list of joints for controller %s is not specified as an array (%s)", entry["name"], parameter)
        else:
            usable.append({**entry, "joints": [str(joint) for joint in entry["joints"]], "name": str(entry["name"])})
    return usable


def action_topic(name: str, action_ns: str) -> str:
    """``name/action_ns``; an empty part is left out, and with an empty name the action is in the root
    (``/action_ns``)."""
    if not name:
        return "/" + action_ns.strip("/")
    return name.rstrip("/") + ("/" + action_ns.strip("/") if action_ns else "")


class ListedControllers(ControllerManager):
    """Those of ``controller_list``, as :meth:`add` has them."""

    def __init__(self, model, namespace: str = "~"):
        super().__init__(model, namespace)
        self._entries: dict[str, dict[str, Any]] = {}
        self._handles: dict[str, ControllerHandle] = {}

    def add(self, entry: dict[str, Any], handle: ControllerHandle) -> None:
        """Take the controller of ``entry``, with ``name`` and ``joints``; ``handle`` executes for it."""
        self._entries[entry["name"]] = entry
        self._handles[entry["name"]] = handle

    def controllers(self) -> list[str]:
        return sorted(self._handles)

    def joints(self, controller: str) -> list[str]:
        return self._entries[controller]["joints"]

    def handle(self, controller: str) -> ControllerHandle | None:
        return self._handles.get(controller)

    def is_default(self, controller: str) -> bool:
        return entries.flag(self._entries[controller], "default")


class SimpleControllerManager(ListedControllers):
    """All controllers of the list count as active; none can be switched."""

    def __init__(self, model, namespace: str = "~"):
        super().__init__(model, namespace)
        for entry in read_controller_list(namespace, ("name", "joints", "action_ns", "type")):
            kind = str(entry["type"])
            if kind not in HANDLES:
                rospy.logerr("Unknown controller type: %s of controller '%s'; there are: %s", kind, entry["name"], ", ".join(HANDLES))
                continue
            if kind == "GripperCommand" and entries.flag(entry, "parallel") and len(entry["joints"]) != 2:
                rospy.logerr("Parallel Gripper requires exactly two joints: controller '%s' has %d", entry["name"], len(entry["joints"]))
                continue
            topic = action_topic(entry["name"], str(entry["action_ns"]))
            self.add(entry, HANDLES[kind](entry["name"], topic, entry))
        rospy.loginfo("Returned %d controllers in list", len(self._handles))

    def describe(self) -> str:
        if not self._handles:
            return f"none (parameter {rospy.resolve_name(self.namespace + 'controller_list')} has no usable entry)"
        return super().describe()
