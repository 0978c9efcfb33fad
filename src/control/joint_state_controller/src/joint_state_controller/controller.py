"""JointStateController."""

from __future__ import annotations

from typing import Any

import rospy
from controller_interface import Controller, NodeHandle, RateGate, RealtimePublisher, to_stamp
from hardware_interface import JointStateInterface
from sensor_msgs.msg import JointState


class JointStateController(Controller):
    """Publishes ``joint_states`` in the robot's namespace.

    Parameters: ``publish_rate`` (Hz, required; 0 or less never publishes), ``joints`` (optional: which, and in which
    order; default all, sorted), ``extra_joints`` (optional list of {name, position, velocity, effort} added as
    constants, for joints that the robot has but nobody drives).
    """

    interface = JointStateInterface

    def init(self, hw: JointStateInterface, root_nh: NodeHandle, controller_nh: NodeHandle) -> None:
        rate = controller_nh.get_param("publish_rate", float)
        names = controller_nh.strings("joints", empty=True) if controller_nh.has_param("joints") else hw.names()
        self._joints = [hw.get_handle(name) for name in names]
        self._names = list(names)
        self._extra_position: list[float] = []
        self._extra_velocity: list[float] = []
        self._extra_effort: list[float] = []
        self._add_extra_joints(controller_nh)
        self._publisher = RealtimePublisher(root_nh, "joint_states", JointState, queue_size=4)
        self._gate = RateGate(rate)

    def _add_extra_joints(self, nh: NodeHandle) -> None:
        extra = nh.param("extra_joints", None)
        if extra is None:
            return
        if not isinstance(extra, list):
            rospy.logerr("parameter %s must be a list of maps with name, position, velocity, effort; ignored", nh.resolve("extra_joints"))
            return
        for index, entry in enumerate(extra):
            problem = self._problem(entry)
            if problem:
                rospy.logwarn("%s[%d] is ignored: %s", nh.resolve("extra_joints"), index, problem)
                continue
            self._names.append(entry["name"])
            self._extra_position.append(entry.get("position", 0.0))
            self._extra_velocity.append(entry.get("velocity", 0.0))
            self._extra_effort.append(entry.get("effort", 0.0))

    def _problem(self, entry: Any) -> str:
        if not isinstance(entry, dict):
            return f"it must be a map with name, position, velocity, effort, not {entry!r}"
        if not isinstance(entry.get("name"), str):
            return "it has no name"
        if entry["name"] in self._names:
            return f"joint '{entry['name']}' is there already"
        values: dict[str, Any] = {key: entry[key] for key in ("position", "velocity", "effort") if key in entry}
        wrong = [f"{key}: {value!r}" for key, value in values.items() if not isinstance(value, float)]
        return f"write numbers with a decimal point ({', '.join(wrong)})" if wrong else ""

    def starting(self, time: float) -> None:
        self._gate.resume(time)  # the first update publishes at once

    def update(self, time: float, period: float) -> None:
        if self._gate.due(time):
            self._publish(time)

    def _publish(self, time: float) -> None:
        if not self._publisher.has_subscribers:
            return
        joints = self._joints
        message = JointState()
        message.header.stamp = to_stamp(time)
        message.name = self._names
        message.position = [joint.position for joint in joints] + self._extra_position
        message.velocity = [joint.velocity for joint in joints] + self._extra_velocity
        message.effort = [joint.effort for joint in joints] + self._extra_effort
        self._publisher.publish(message)
