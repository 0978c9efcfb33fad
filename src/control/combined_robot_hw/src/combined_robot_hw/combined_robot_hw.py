"""CombinedRobotHW."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import rospy
from hardware_interface import ControllerInfo, InterfaceResources, RobotHW, SwitchState
from plugin_loader import PluginError, find_plugins


class CombinedRobotHW(RobotHW):
    """The robots named in parameter ``robot_hardware``, as one.

    Each ``<name>/type`` says which RobotHW plugin it is; ``<name>`` is the namespace of its parameters. Interfaces of
    the same type are merged; every part hears only of controllers that concern it.
    """

    def __init__(self) -> None:
        super().__init__()
        self.parts: list[RobotHW] = []

    def init(self, root_nh, robot_hw_nh) -> bool:
        """Load the parts and set them up.

        :param root_nh: handed on to each part.
        :param robot_hw_nh: where ``robot_hardware`` and the parts' namespaces are.
        :return: False, with one ERROR line, if a part is missing or refuses.
        """
        names = robot_hw_nh.param("robot_hardware", None)
        if not isinstance(names, list) or not all(isinstance(name, str) for name in names):
            rospy.logerr("parameter %s must be a list of names of robots, it is %r", robot_hw_nh.resolve("robot_hardware"), names)
            return False
        types, problems = find_plugins("hardware_interface")
        for problem in problems:
            rospy.logwarn("robot types: %s", problem)
        return all(self._load(name, types, root_nh, robot_hw_nh) for name in names)

    def _load(self, name: str, types: dict, root_nh, robot_hw_nh) -> bool:
        nh = robot_hw_nh.sub(name)
        kind = nh.param("type", None)
        if kind not in types:
            rospy.logerr(
                "robot '%s' cannot be loaded: parameter %s is %r; robot types that packages export: %s",
                name,
                nh.resolve("type"),
                kind,
                ", ".join(sorted(types)) or "none",
            )
            return False
        try:
            part = types[kind].load()()
            if part.init(root_nh, nh) is False:
                raise PluginError("its init() returned False")
        except Exception as error:  # a part is third-party code; the reason is what the user needs
            rospy.logerr("robot '%s' (%s) could not be initialized: %s", name, kind, error)
            return False
        self.add(part)
        return True

    def add(self, part: RobotHW) -> None:
        """Take one more robot in, ``part``."""
        self.parts.append(part)
        self.register_interface_manager(part)

    def read(self, time: float, period: float) -> None:
        for part in self.parts:
            part.read(time, period)

    def write(self, time: float, period: float) -> None:
        for part in self.parts:
            part.write(time, period)

    def prepare_switch(self, start: Sequence[ControllerInfo], stop: Sequence[ControllerInfo]) -> bool:
        return all(part.prepare_switch(_concerning(part, start), _concerning(part, stop)) for part in self.parts)

    def do_switch(self, start: Sequence[ControllerInfo], stop: Sequence[ControllerInfo]) -> None:
        for part in self.parts:
            part.do_switch(_concerning(part, start), _concerning(part, stop))

    def switch_result(self, controller: ControllerInfo | None = None) -> SwitchState:
        """ERROR if any part has one, else ONGOING while any part is at it."""
        results = []
        for part in self.parts:
            concerned = None if controller is None else next(iter(_concerning(part, [controller])), None)
            if controller is None or concerned is not None:
                results.append(part.switch_result(concerned))
        if SwitchState.ERROR in results:
            return SwitchState.ERROR
        return SwitchState.ONGOING if SwitchState.ONGOING in results else SwitchState.DONE


def _concerning(part: RobotHW, controllers: Sequence[ControllerInfo]) -> list[ControllerInfo]:
    """The controllers with claims on this part, cut down to these; a controller without any claim concerns all."""
    result = []
    for controller in controllers:
        if not any(claimed.resources for claimed in controller.claimed_resources):
            result.append(controller)
            continue
        claims = []
        for claimed in controller.claimed_resources:
            interface = part.get(claimed.hardware_interface)
            owned = tuple(name for name in claimed.resources if interface is not None and name in interface)
            if owned:
                claims.append(InterfaceResources(claimed.hardware_interface, owned))
        if claims:
            result.append(replace(controller, claimed_resources=tuple(claims)))
    return result
