"""The controllers of one or of several running controller_managers, found and switched through their services."""

from __future__ import annotations

import time
from collections.abc import Sequence
from typing import Any

import rosgraph
import rospy
from controller_manager_msgs.srv import ListControllers, SwitchController, SwitchControllerRequest
from moveit_core.controller_manager import ControllerHandle, ControllerManager
from moveit_simple_controller_manager.actions import FollowJointTrajectoryHandle, GripperCommandHandle

#: a list of controllers is believed for this long (wall s)
_AGE = 1.0


def _handle_kind(controller_type: str):
    """(class, name of the action) for a controller type; None for those that take no trajectories."""
    if controller_type.endswith("/JointTrajectoryController"):
        return FollowJointTrajectoryHandle, "follow_joint_trajectory"
    if controller_type.endswith("/GripperActionController"):
        return GripperCommandHandle, "gripper_cmd"
    return None


class ControlManager(ControllerManager):
    """The controllers of the controller_manager in ``~ros_control_namespace`` (default /)."""

    def __init__(self, model, namespace: str = "~", control_namespace: str | None = None):
        super().__init__(model, namespace)
        given = rospy.get_param(namespace + "ros_control_namespace", "/") if control_namespace is None else control_namespace
        self._ns = "/" + given.strip("/") + ("/" if given.strip("/") else "")
        self._known: dict[str, Any] = {}
        self._read = 0.0
        self._handles: dict[str, ControllerHandle] = {}
        rospy.loginfo("Started moveit_ros_control_interface::MoveItControllerManager for namespace %s", self._ns)

    @property
    def _list_service(self) -> str:
        return self._ns + "controller_manager/list_controllers"

    def _discover(self, force: bool = False) -> None:
        if not force and time.monotonic() - self._read < _AGE:
            return
        self._read = time.monotonic()
        try:
            rospy.wait_for_service(self._list_service, timeout=0.5)
            reply = rospy.ServiceProxy(self._list_service, ListControllers)()
        except (rospy.ROSException, rospy.ServiceException) as error:
            rospy.logwarn_throttle(10, f"Failed to read controllers from {self._list_service}: {error}")
            self._known = {}
            return
        known = {}
        for controller in reply.controller:
            if _handle_kind(controller.type) is not None:
                known[self._full(controller.name)] = controller
        self._known = known
        for name, controller in known.items():
            if controller.state == "running" and name not in self._handles:
                make, action = _handle_kind(controller.type)
                self._handles[name] = make(name, f"{name}/{action}", {"joints": self.joints(name)})

    def _full(self, name: str) -> str:
        return self._ns + name.lstrip("/")

    def controllers(self) -> list[str]:
        self._discover()
        return sorted(self._known)

    def active_controllers(self) -> list[str]:
        self._discover()
        return sorted(name for name, controller in self._known.items() if controller.state == "running")

    def joints(self, controller: str) -> list[str]:
        entry = self._known.get(controller)
        return sorted({joint for claimed in entry.claimed_resources for joint in claimed.resources}) if entry else []

    def handle(self, controller: str) -> ControllerHandle | None:
        self._discover()
        return self._handles.get(controller) if controller in self.active_controllers() else None

    def switch(self, activate: Sequence[str], deactivate: Sequence[str]) -> bool:
        request = SwitchControllerRequest(strictness=SwitchControllerRequest.STRICT)
        request.start_controllers = [name[len(self._ns) :] for name in activate if not self.is_active(name)]
        request.stop_controllers = [name[len(self._ns) :] for name in deactivate if self.is_active(name)]
        if not request.start_controllers and not request.stop_controllers:
            return True
        try:
            good = rospy.ServiceProxy(self._ns + "controller_manager/switch_controller", SwitchController)(request).ok
        except (rospy.ROSException, rospy.ServiceException) as error:
            rospy.logerr("Could not switch controllers at %s: %s", self._ns, error)
            good = False
        self._discover(force=True)
        return good

    def reload(self) -> None:
        self._discover(force=True)

    def describe(self) -> str:
        if not self.controllers():
            return f"none that take trajectories ({self._list_service} was asked)"
        return super().describe()


class MultiControlManager(ControllerManager):
    """The controllers of every controller_manager that the master knows."""

    def __init__(self, model, namespace: str = "~"):
        super().__init__(model, namespace)
        self._managers: dict[str, ControlManager] = {}
        self._read = 0.0

    def _discover(self) -> None:
        if time.monotonic() - self._read < _AGE:
            return
        self._read = time.monotonic()
        try:
            services = rosgraph.Master(rospy.get_name()).getSystemState()[2]
        except (OSError, rosgraph.MasterException) as error:
            rospy.logwarn("controller managers cannot be looked up: %s", error)
            return
        suffix = "controller_manager/list_controllers"
        for name, _ in services:
            if name.endswith("/" + suffix):
                found = name[: -len(suffix)]
                if found not in self._managers:
                    self._managers[found] = ControlManager(self.model, self.namespace, found)

    def _owner(self, controller: str) -> ControlManager | None:
        self._discover()
        return next((manager for manager in self._managers.values() if controller in manager.controllers()), None)

    def controllers(self) -> list[str]:
        self._discover()
        return sorted(name for manager in self._managers.values() for name in manager.controllers())

    def active_controllers(self) -> list[str]:
        self._discover()
        return sorted(name for manager in self._managers.values() for name in manager.active_controllers())

    def joints(self, controller: str) -> list[str]:
        owner = self._owner(controller)
        return owner.joints(controller) if owner else []

    def handle(self, controller: str) -> ControllerHandle | None:
        owner = self._owner(controller)
        return owner.handle(controller) if owner else None

    def switch(self, activate: Sequence[str], deactivate: Sequence[str]) -> bool:
        return all(
            manager.switch(
                [name for name in activate if name in manager.controllers()], [name for name in deactivate if name in manager.controllers()]
            )
            for manager in self._managers.values()
        )

    def reload(self) -> None:
        self._read = 0.0
        for manager in self._managers.values():
            manager.reload()
