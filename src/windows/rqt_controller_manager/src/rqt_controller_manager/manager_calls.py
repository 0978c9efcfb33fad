"""What a controller manager is asked; any of it may hang."""

from typing import NamedTuple

import rospy
from controller_manager_msgs.srv import ListControllers, LoadController, SwitchController, SwitchControllerRequest, UnloadController
from controller_manager_msgs.utils import ControllerManagerLister, get_rosparam_controller_names
from qt_gui.errors import WindowError

UNINITIALIZED = "uninitialized"


class ControllerRow(NamedTuple):
    """A controller as it is shown; ``resources`` are (interface, joints)."""

    name: str
    state: str
    type: str = ""
    resources: tuple[tuple[str, tuple[str, ...]], ...] = ()


class CallError(WindowError, RuntimeError):
    """A request that the manager refused; one line says which."""


class ManagerCalls:
    """Stateless but for the managers known."""

    def __init__(self):
        self._list_managers = ControllerManagerLister()

    def managers(self) -> list[str]:
        return list(self._list_managers())

    def controllers(self, manager: str) -> list[ControllerRow]:
        """Those that are loaded, and those that could be: parameters beside the manager that have a type.

        :raises rospy.ServiceException: the manager is gone
        """
        loaded = rospy.ServiceProxy(f"{manager}/list_controllers", ListControllers)().controller
        rows = [
            ControllerRow(c.name, c.state, c.type, tuple((r.hardware_interface, tuple(r.resources)) for r in c.claimed_resources))
            for c in loaded
        ]
        namespace = manager.rsplit("/", 1)[0] or "/"
        names = {row.name for row in rows}
        for name in get_rosparam_controller_names(namespace):
            if name not in names:
                kind = rospy.get_param(f"{namespace.rstrip('/')}/{name}/type", "")
                rows.append(ControllerRow(name, UNINITIALIZED, str(kind)))
        return rows

    def act(self, manager: str, name: str, *steps: str) -> None:
        """Load, start, stop or unload the controller ``name`` of ``manager``, as ``steps`` say, one after the other.

        :param manager: its namespace
        :raises CallError: the manager refuses one
        :raises rospy.ServiceException: it is gone
        """
        for step in steps:
            if step in ("load", "unload"):
                kind = LoadController if step == "load" else UnloadController
                done = rospy.ServiceProxy(f"{manager}/{step}_controller", kind)(name).ok
            else:
                request = SwitchControllerRequest(strictness=SwitchControllerRequest.STRICT)
                (request.start_controllers if step == "start" else request.stop_controllers).append(name)
                done = rospy.ServiceProxy(f"{manager}/switch_controller", SwitchController)(request).ok
            if not done:
                raise CallError(f"{manager} did not {step} {name}; its log says why")
