"""RobotHW: what a robot offers to the controller manager."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from enum import Enum
from typing import Any, TypeVar, overload

import rospy

from .interfaces import HardwareInterface

InterfaceT = TypeVar("InterfaceT", bound=HardwareInterface)


@dataclass(frozen=True)
class InterfaceResources:
    """Resources that a controller claims through one interface (C++ name), sorted."""

    hardware_interface: str
    resources: tuple[str, ...] = ()


@dataclass(frozen=True)
class ControllerInfo:
    """A controller as the hardware sees it when controllers are switched."""

    name: str
    type: str
    claimed_resources: tuple[InterfaceResources, ...] = field(default_factory=tuple)


class SwitchState(Enum):
    DONE = 0
    ONGOING = 1
    ERROR = 2


class RobotHW:
    """Base of every robot. Override what the hardware needs; each hook does nothing (and succeeds) by default.

    read, write, do_switch and switch_result are called by the control loop and must not block; init, check_for_conflict
    and prepare_switch are called by a service thread.
    """

    def __init__(self) -> None:
        self._interfaces: dict[str, HardwareInterface] = {}
        self._children: list[RobotHW] = []
        self._merged: dict[str, HardwareInterface] = {}
        self._twin: Any = None  # in C++; see the module compiled

    # -- interfaces -------------------------------------------------------------------------------------------------

    def register_interface(self, interface: HardwareInterface) -> None:
        """Offer an interface. A second one of the same type replaces the first, with a warning."""
        if interface.type_name in self._interfaces:
            rospy.logwarn("Replacing previously registered interface '%s'.", interface.type_name)
        self._interfaces[interface.type_name] = interface
        self._merged.clear()

    def register_interface_manager(self, hw: RobotHW) -> None:
        """Offer the interfaces of ``hw``, another robot, too; those of the same type are merged by handle."""
        self._children.append(hw)
        self._merged.clear()

    @overload
    def get(self, interface: type[InterfaceT]) -> InterfaceT | None: ...

    @overload
    def get(self, interface: str) -> HardwareInterface | None: ...

    def get(self, interface: type[HardwareInterface] | str) -> HardwareInterface | None:
        """The interface of that class (or C++ name), or None. The same object every time, as long as nothing is
        registered in between: claims live in it."""
        name = interface if isinstance(interface, str) else interface.type_name
        if name in self._merged:
            return self._merged[name]
        parts = [self._interfaces[name]] if name in self._interfaces else []
        parts += [part for part in (child.get(name) for child in self._children) if part is not None]
        if not parts:
            return None
        if len(parts) == 1:
            return parts[0]
        self._merged[name] = type(parts[0]).merged(parts)
        return self._merged[name]

    def interface_names(self) -> list[str]:
        """C++ names of all interfaces offered, sorted."""
        names = set(self._interfaces)
        for child in self._children:
            names.update(child.interface_names())
        return sorted(names)

    def compiled_part(self) -> Any:
        """A ``compiled.Robot`` with interfaces of a third party in C++, which compiled controllers find beside those registered here;
        None if there are none. Asked once, when the first compiled controller is loaded."""
        return None

    # -- life ---------------------------------------------------------------------------------------------------------

    def init(self, root_nh, robot_hw_nh) -> bool:
        """Set up from parameters. :return: False to refuse.

        :param root_nh: NodeHandle of the node's own namespace.
        :param robot_hw_nh: NodeHandle of this robot's parameters.
        """
        return True

    def read(self, time: float, period: float) -> None:
        """Bring measured states into the handles. ``time`` and ``period`` in s."""

    def write(self, time: float, period: float) -> None:
        """Send the commands of the handles out. ``time`` and ``period`` in s."""

    # -- switching ----------------------------------------------------------------------------------------------------

    def check_for_conflict(self, controllers: Sequence[ControllerInfo]) -> bool:
        """True if these controllers cannot run together: by default, if any resource is claimed twice, whatever the
        interface (a controller that takes one joint through two interfaces is in conflict with itself)."""
        owners: dict[str, list[str]] = {}
        for controller in controllers:
            for claimed in controller.claimed_resources:
                for resource in claimed.resources:
                    owners.setdefault(resource, []).append(controller.name)
        conflict = False
        for resource, names in sorted(owners.items()):
            if len(names) > 1:
                rospy.logwarn("Resource conflict on [%s].  Controllers = [%s]", resource, ", ".join(names))
                conflict = True
        return conflict

    def prepare_switch(self, start: Sequence[ControllerInfo], stop: Sequence[ControllerInfo]) -> bool:
        """May refuse a switch (False) before anything has changed: ``start`` and ``stop`` are the controllers that begin and end."""
        return True

    def do_switch(self, start: Sequence[ControllerInfo], stop: Sequence[ControllerInfo]) -> None:
        """Begin the switch of the hardware: for the controllers of ``start``, which begin, and of ``stop``, which end."""

    def switch_result(self, controller: ControllerInfo | None = None) -> SwitchState:
        """How far the switch is, for all (None) or for one controller."""
        return SwitchState.DONE
