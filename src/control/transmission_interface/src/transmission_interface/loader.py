"""Transmissions of a URDF, brought to life between the actuators and the joint interfaces of a robot."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from math import nan

import rospy
from hardware_interface import (
    ActuatorStateInterface,
    EffortActuatorInterface,
    EffortJointInterface,
    HardwareInterface,
    JointHandle,
    JointStateHandle,
    JointStateInterface,
    PositionActuatorInterface,
    PositionJointInterface,
    ResourceError,
    RobotHW,
    VelocityActuatorInterface,
    VelocityJointInterface,
)
from plugin_loader import PluginClass, PluginError, find_plugins

from ._law import asked_for, known_interfaces
from .parser import TransmissionInfo, parse_transmissions
from .pipelines import TransmissionPipeline
from .transmissions import Transmission, TransmissionError

_KINDS: dict[str, tuple[type[HardwareInterface], type[HardwareInterface]]] = {
    "position": (PositionJointInterface, PositionActuatorInterface),
    "velocity": (VelocityJointInterface, VelocityActuatorInterface),
    "effort": (EffortJointInterface, EffortActuatorInterface),
}


@cache
def _transmission_types() -> dict[str, PluginClass]:
    """What packages export; looked for once per process."""
    types, problems = find_plugins("transmission_interface")
    for problem in problems:
        rospy.logwarn("transmission types: %s", problem)
    return types


class RobotTransmissions:
    """The pipelines of a robot; the driver propagates those that it needs."""

    def __init__(self) -> None:
        self.actuator_to_joint_state = TransmissionPipeline.of_states("joint")
        self.joint_to_actuator_state = TransmissionPipeline.of_states("actuator")
        self.joint_to_actuator_position = TransmissionPipeline.of_commands("actuator", "position")
        self.joint_to_actuator_velocity = TransmissionPipeline.of_commands("actuator", "velocity")
        self.joint_to_actuator_effort = TransmissionPipeline.of_commands("actuator", "effort")
        self.actuator_to_joint_position = TransmissionPipeline.of_commands("joint", "position")
        self.actuator_to_joint_velocity = TransmissionPipeline.of_commands("joint", "velocity")
        self.actuator_to_joint_effort = TransmissionPipeline.of_commands("joint", "effort")


class TransmissionInterfaceLoader:
    """Loads transmissions.

    :param robot_hw: has the actuator interfaces; gets the joint interfaces.
    :param transmissions: gets the pipelines.
    """

    def __init__(self, robot_hw: RobotHW, transmissions: RobotTransmissions):
        self._hw = robot_hw
        self._transmissions = transmissions
        self._types = _transmission_types()

    def load(self, urdf: str) -> bool:
        """Load all transmissions of ``urdf``, a text; stops at the first that fails (those before it stay).

        :return: True if there was at least one and all were loaded; an ERROR line says what was wrong.
        """
        try:
            infos, problems = parse_transmissions(urdf)
            for problem in problems:
                rospy.logerr("%s", problem)
            if not infos:
                raise TransmissionError("the robot description has no usable <transmission>")
            for info in infos:
                self.load_one(info)
        except TransmissionError as error:
            rospy.logerr("Loading transmissions: %s", error)
            return False
        return True

    def load_one(self, info: TransmissionInfo) -> None:
        """Load the transmission that ``info`` describes. :raises TransmissionError: it cannot be."""
        plugin = self._types.get(info.type)
        if plugin is None:
            raise TransmissionError(
                f"transmission '{info.name}': type '{info.type}' does not exist; there are: {', '.join(sorted(self._types)) or 'none'}"
            )
        try:
            transmission, actuator_order, joint_order = plugin.load().from_info(info)
        except PluginError as error:
            raise TransmissionError(f"transmission '{info.name}': {error}") from error
        listed = [joint.hardware_interfaces for joint in info.joints]
        interfaces = known_interfaces(info.name, listed)
        for name in sorted(set(listed[0]) - set(interfaces)):
            rospy.logwarn("transmission '%s': hardware interface '%s' is unknown and left out", info.name, name)
        actuators = [info.actuators[i].name for i in actuator_order]
        joints = [info.joints[i].name for i in joint_order]
        states = [self._joint_state(name) for name in joints]
        actuator_states = self._actuators(ActuatorStateInterface, actuators, info)
        pipelines = self._transmissions
        pipelines.actuator_to_joint_state.register(info.name, transmission, actuator_states, states)
        works, problems = False, []
        for kind, bidirectional in map(asked_for, interfaces):
            try:
                if kind != "state":
                    self._connect(kind, bidirectional, info, transmission, actuators, states)
            except TransmissionError as error:
                problems.append(error)
                continue
            works = True
            if bidirectional:
                pipelines.joint_to_actuator_state.register(info.name, transmission, actuator_states, states)
        if not works:
            raise problems[0]
        for problem in problems:
            rospy.logerr("%s", problem)

    def _connect(
        self,
        kind: str,
        bidirectional: bool,
        info: TransmissionInfo,
        transmission: Transmission,
        actuators: Sequence[str],
        states: Sequence[JointStateHandle],
    ) -> None:
        joint_interface, actuator_interface = _KINDS[kind]
        actuator_handles = self._actuators(actuator_interface, actuators, info)
        interface = self._interface(joint_interface)
        for state in states:
            if state.name not in interface:
                interface.register_handle(JointHandle(state, nan))
        by_name = {handle.name: handle for handle in interface.handles()}
        handles = [by_name[state.name] for state in states]
        pipelines = vars(self._transmissions)
        pipelines[f"joint_to_actuator_{kind}"].register(info.name, transmission, actuator_handles, handles)
        if bidirectional:
            pipelines[f"actuator_to_joint_{kind}"].register(info.name, transmission, actuator_handles, handles)

    def _interface(self, interface: type[HardwareInterface]) -> HardwareInterface:
        found = self._hw.get(interface)
        if found is None:
            found = interface()
            self._hw.register_interface(found)
        return found

    def _joint_state(self, name: str) -> JointStateHandle:
        interface = self._interface(JointStateInterface)
        if name not in interface:
            interface.register_handle(JointStateHandle(name, nan, nan, nan))
        return interface.get_handle(name)

    def _actuators(self, interface: type[HardwareInterface], names: Sequence[str], info: TransmissionInfo) -> list:
        found = self._hw.get(interface)
        if found is None:
            raise TransmissionError(
                f"transmission '{info.name}' needs actuators with {interface.type_name}, which this robot does not have"
            )
        try:
            return [found.get_handle(name) for name in names]
        except ResourceError as error:
            raise TransmissionError(f"transmission '{info.name}': {error}") from error
