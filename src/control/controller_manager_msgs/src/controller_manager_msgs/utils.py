"""Finding controller managers, and filtering what they list."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import rosgraph
import rospy
import rosservice

from .msg import ControllerState
from .srv import ListControllers, ListControllerTypes, LoadController, ReloadControllerLibraries, SwitchController, UnloadController

#: service below a controller manager's namespace -> its type
_SERVICES = {
    "list_controllers": ListControllers._type,
    "list_controller_types": ListControllerTypes._type,
    "load_controller": LoadController._type,
    "unload_controller": UnloadController._type,
    "switch_controller": SwitchController._type,
    "reload_controller_libraries": ReloadControllerLibraries._type,
}


def _join(namespace: str, name: str) -> str:
    return f"{namespace.rstrip('/')}/{name}"


def _service_type(name: str) -> str | None:
    try:
        return rosservice.get_service_type(name)
    except (OSError, rosservice.ROSServiceIOException):  # its node has died without telling the master
        return None


def is_controller_manager(namespace: str) -> bool:
    """True if all six services are there in ``namespace``, each with the right type."""
    return all(_service_type(_join(namespace, name)) == kind for name, kind in _SERVICES.items())


def get_controller_managers(namespace: str = "/", initial_guess: Sequence[str] | None = None) -> list[str]:
    """Namespaces of the controller managers at or below ``namespace``, sorted, such as ``/arm/controller_manager``.

    :param initial_guess: an earlier answer; what is still there of it is not looked at again, right or wrong.
    """
    if not rosgraph.is_master_online():
        return []
    services = set(rosservice.get_service_list(namespace=namespace))
    candidates = {name[: -len("/list_controllers")] or "/" for name in services if name.endswith("/list_controllers")}
    known = set(initial_guess or ())
    found = []
    for candidate in sorted(candidates):
        complete = all(_join(candidate, name) in services for name in _SERVICES)
        if candidate in known or (complete and is_controller_manager(candidate)):
            found.append(candidate)
    return found


def describe_controller_managers() -> str:
    """A sentence for messages: which controller managers there are, or that there is none."""
    try:
        managers = get_controller_managers()
    except (OSError, rosservice.ROSServiceException, rosgraph.MasterException):
        return "The ROS master does not answer."
    if not managers:
        return "There is no controller manager at all; is the robot (or its gazebo_ros_control plugin) running?"
    return f"Controller managers found: {', '.join(managers)}."


class ControllerManagerLister:
    """Lists controller managers below ``namespace`` again and again, asking only new ones for their types."""

    def __init__(self, namespace: str = "/"):
        self._namespace = namespace
        self._known: list[str] = []

    def __call__(self) -> list[str]:
        self._known = get_controller_managers(self._namespace, self._known)
        return self._known


class ControllerLister:
    """Lists the controllers of the manager at ``namespace`` over a connection that is kept open; [] while it cannot be reached."""

    def __init__(self, namespace: str = "/controller_manager"):
        self._service = _join(namespace, "list_controllers")
        self._proxy = self._connect()

    def _connect(self) -> rospy.ServiceProxy:
        return rospy.ServiceProxy(self._service, ListControllers, persistent=True)

    def __call__(self) -> list[ControllerState]:
        for _ in range(2):
            try:
                return self._proxy().controller
            except rospy.ServiceException:  # the manager went, or came back as another process
                self._proxy.close()
                self._proxy = self._connect()
        return []


def _matches(text: str, value: str, match_substring: bool) -> bool:
    return value in text if match_substring else value == text


def filter_by_name(controllers: Sequence[ControllerState], name: str, match_substring: bool = False) -> list[ControllerState]:
    """Those of ``controllers`` that are called ``name``, or have it in their name with ``match_substring``."""
    return [controller for controller in controllers if _matches(controller.name, name, match_substring)]


def filter_by_type(controllers: Sequence[ControllerState], type_name: str, match_substring: bool = False) -> list[ControllerState]:
    """Those of ``controllers`` whose type is ``type_name``, or has it in its name with ``match_substring``."""
    return [controller for controller in controllers if _matches(controller.type, type_name, match_substring)]


def filter_by_state(controllers: Sequence[ControllerState], state: str, match_substring: bool = False) -> list[ControllerState]:
    """Those of ``controllers`` whose state ("running", "stopped" ...) is ``state``, or has it within with ``match_substring``."""
    return [controller for controller in controllers if _matches(controller.state, state, match_substring)]


def filter_by_hardware_interface(
    controllers: Sequence[ControllerState], hardware_interface: str, match_substring: bool = False
) -> list[ControllerState]:
    """Those of ``controllers`` with a claim through ``hardware_interface``, a C++ name, or part of one with ``match_substring``."""
    return [
        controller
        for controller in controllers
        if any(_matches(claimed.hardware_interface, hardware_interface, match_substring) for claimed in controller.claimed_resources)
    ]


def filter_by_resources(
    controllers: Sequence[ControllerState], resources: Sequence[str], hardware_interface: str | None = None, match_any: bool = False
) -> list[ControllerState]:
    """Those of ``controllers`` that claim all of ``resources`` (any of them with ``match_any``).

    :param hardware_interface: count only claims through this interface; by default every interface counts.
    """
    enough = any if match_any else all
    result = []
    for controller in controllers:
        claimed = {
            resource
            for entry in controller.claimed_resources
            if hardware_interface in (None, entry.hardware_interface)
            for resource in entry.resources
        }
        if enough(resource in claimed for resource in resources):
            result.append(controller)
    return result


def get_rosparam_controller_names(namespace: str = "/") -> list[str]:
    """First-level names in ``namespace`` that have a parameter ``type``: controllers that could be loaded."""
    values: Any = rospy.get_param(namespace, {})
    entries: dict[str, Any] = values if isinstance(values, dict) else {}
    return [name for name, value in entries.items() if isinstance(value, dict) and "type" in value and not isinstance(value["type"], dict)]
