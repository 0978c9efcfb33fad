"""The controllers of one or of several running controller_managers, found and switched through their services."""

from __future__ import annotations

import time
from collections.abc import Sequence
from typing import Any

import rosgraph
import rospy
from controller_manager_msgs.srv import ListControllers, SwitchController, SwitchControllerRequest
from moveit_core.controller_manager import ControllerHandle, ControllerManager
from moveit_core.errors import one_line
from moveit_simple_controller_manager.actions import FollowJointTrajectoryHandle, GripperCommandHandle

#: a list of controllers is believed for this long (wall s)
_AGE = 1.0


def _handle_kind(name: str, controller_type: str, topics: set[str]):
    """(class, name of the action) for a controller; None for those that take no trajectories.

    :param name: with its namespace. :param controller_type: that of list_controllers. :param topics: of trajectories' results
    """
    if controller_type.endswith("/JointTrajectoryController") or f"{name}/follow_joint_trajectory/result" in topics:
        return FollowJointTrajectoryHandle, "follow_joint_trajectory"
    if controller_type.endswith("/GripperActionController"):
        return GripperCommandHandle, "gripper_cmd"
    return None


def _resources(controller) -> set[str]:
    """What a controller of list_controllers claims, or would when it runs."""
    return {resource for claimed in controller.claimed_resources for resource in claimed.resources}


def _topics() -> list:
    """(name, type) of all topics; none when the master cannot be asked."""
    try:
        return rospy.get_published_topics()
    except (OSError, rospy.ROSException, rosgraph.MasterException):
        return []


class ControlManager(ControllerManager):
    """The controllers of the controller_manager in ``~ros_control_namespace`` (default /)."""

    def __init__(self, model, namespace: str = "~", control_namespace: str | None = None):
        super().__init__(model, namespace)
        given = rospy.get_param(namespace + "ros_control_namespace", "/") if control_namespace is None else control_namespace
        self._ns = "/" + given.strip("/") + ("/" if given.strip("/") else "")
        self._known: dict[str, Any] = {}  # those that take trajectories
        self._running: dict[str, Any] = {}  # those of any kind
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
            self._known, self._running = {}, {}
            return
        listed = {self._full(controller.name): controller for controller in reply.controller}
        topics = {name for name, kind in _topics() if kind == "control_msgs/FollowJointTrajectoryActionResult"}
        kinds = {name: _handle_kind(name, controller.type, topics) for name, controller in listed.items()}
        self._known = {name: controller for name, controller in listed.items() if kinds[name]}
        self._running = {name: controller for name, controller in listed.items() if controller.state == "running"}
        for name in self._known:
            if name in self._running and name not in self._handles:
                make, action = kinds[name]
                self._handles[name] = make(name, f"{name}/{action}", {"name": name, "joints": self.joints(name)})

    def _full(self, name: str) -> str:
        return self._ns + name.lstrip("/")

    def controllers(self) -> list[str]:
        self._discover()
        return sorted(self._known)

    def active_controllers(self) -> list[str]:
        self._discover()
        return sorted(name for name in self._known if name in self._running)

    def joints(self, controller: str) -> list[str]:
        entry = self._known.get(controller)
        return sorted(_resources(entry)) if entry else []

    def handle(self, controller: str) -> ControllerHandle | None:
        self._discover()
        return self._handles.get(controller) if controller in self.active_controllers() else None

    def switch(self, activate: Sequence[str], deactivate: Sequence[str]) -> bool:
        """As the base has it. Names of other managers are passed over; whatever runs and holds a joint that is needed is stopped."""
        self._discover(force=True)
        known, running = self._known, self._running
        start = [name for name in activate if name in known and name not in running]
        needed = {resource for name in start for resource in _resources(known[name])}
        holders = [name for name, controller in running.items() if name not in activate and needed & _resources(controller)]
        stop = list(dict.fromkeys([*(name for name in deactivate if name in running), *holders]))
        if not start and not stop:
            return True
        request = SwitchControllerRequest(strictness=SwitchControllerRequest.STRICT)
        request.start_controllers = [known[name].name for name in start]
        request.stop_controllers = [running[name].name for name in stop]
        try:
            good = rospy.ServiceProxy(self._ns + "controller_manager/switch_controller", SwitchController)(request).ok
            problem = "controller_manager refuses; its log says why"
        except (rospy.ROSException, rospy.ServiceException) as error:
            good, problem = False, one_line(error)
        if not good:
            rospy.logerr("Could not switch controllers at %s, start %s, stop %s: %s", self._ns, start, stop, problem)
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
        self._discover()
        return all(manager.switch(activate, deactivate) for manager in self._managers.values())

    def reload(self) -> None:
        self._read = 0.0
        for manager in self._managers.values():
            manager.reload()
