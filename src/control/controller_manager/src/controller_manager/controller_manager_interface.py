"""What the command line tools do, for import by other programs. Each function prints what it did.

Service names are relative: ROS_NAMESPACE (or ``__ns:=``) chooses the controller manager.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import rospy
from controller_manager_msgs.srv import (
    ListControllers,
    ListControllerTypes,
    LoadController,
    ReloadControllerLibraries,
    SwitchController,
    SwitchControllerRequest,
    UnloadController,
)
from controller_manager_msgs.utils import describe_controller_managers
from node_signals.services import wait_for_service

#: s of waiting after which the tools say what they are waiting for
_PATIENCE = 3.0


def _call(name: str, service_type: type, *arguments: Any) -> Any:
    """Call a service of the controller manager, waiting for it as long as it takes."""
    service = rospy.resolve_name(f"controller_manager/{name}")
    try:
        wait_for_service(service, timeout=_PATIENCE)
    except rospy.ROSException:
        rospy.logwarn("Waiting for service %s. %s", service, describe_controller_managers())
        wait_for_service(service)
    return rospy.ServiceProxy(service, service_type).call(*arguments)


def list_controller_types() -> None:
    for name in _call("list_controller_types", ListControllerTypes).types:
        print(name)


def reload_libraries(force_kill: bool, restore: bool = False) -> bool:
    """Load the libraries of all controllers anew, which needs them gone.

    :param force_kill: stop and unload what is loaded; False fails if anything is.
    :param restore: load and start again what was there before.
    :return: whether it worked.
    """
    print(f"Restore: {restore}")
    before = _call("list_controllers", ListControllers).controller if restore else []
    ok = _call("reload_controller_libraries", ReloadControllerLibraries, force_kill).ok
    print("Successfully reloaded libraries" if ok else "Failed to reload libraries. Do you still have controllers loaded?")
    if restore:
        for controller in before:
            _call("load_controller", LoadController, controller.name)
        _call(
            "switch_controller",
            SwitchController,
            SwitchControllerRequest(
                start_controllers=[controller.name for controller in before if controller.state == "running"],
                strictness=SwitchControllerRequest.BEST_EFFORT,
            ),
        )
        print("Controllers restored to original state")
    return ok


def list_controllers() -> None:
    controllers = _call("list_controllers", ListControllers).controller
    if not controllers:
        print("No controllers are loaded in mechanism control")
    for controller in controllers:
        interfaces = dict.fromkeys(claimed.hardware_interface for claimed in controller.claimed_resources)
        print(f"'{controller.name}' - '{'+'.join(interfaces)}' ( {controller.state} )")


def load_controller(name: str) -> bool:
    """Load the controller ``name``, which its parameters describe. :return: whether it worked."""
    ok = _call("load_controller", LoadController, name).ok
    print(f"Loaded '{name}'" if ok else f"Error when loading '{name}'")
    return ok


def unload_controller(name: str) -> bool:
    """Unload the controller ``name``, which must not run. :return: whether it worked."""
    ok = _call("unload_controller", UnloadController, name).ok
    print(f"Unloaded '{name}' successfully" if ok else f"Error when unloading '{name}'")
    return ok


def start_controller(name: str) -> bool:
    """Start the loaded controller ``name``. :return: whether it worked."""
    return start_controllers([name])


def start_controllers(names: Sequence[str]) -> bool:
    """Start all controllers of ``names`` in one cycle, or none. :return: whether it worked."""
    return start_stop_controllers(start_controllers=names)


def stop_controller(name: str) -> bool:
    """Stop the controller ``name``. :return: whether it worked."""
    return stop_controllers([name])


def stop_controllers(names: Sequence[str]) -> bool:
    """Stop all controllers of ``names`` in one cycle, or none. :return: whether it worked."""
    return start_stop_controllers(stop_controllers=names)


def start_stop_controllers(start_controllers: Sequence[str] = (), stop_controllers: Sequence[str] = ()) -> bool:
    """One strict switch: ``start_controllers`` start and ``stop_controllers`` stop, or nothing changes. :return: whether it worked."""
    start, stop = list(start_controllers), list(stop_controllers)
    ok = _call(
        "switch_controller",
        SwitchController,
        SwitchControllerRequest(start_controllers=start, stop_controllers=stop, strictness=SwitchControllerRequest.STRICT),
    ).ok
    if not ok:
        print(f"Error when starting {start} and stopping {stop}")
        return False
    for verb, names in (("Started", start), ("Stopped", stop)):
        if names:
            print(f"{verb} {names} successfully")
    return True
