"""Forwarding of one command or of one per joint."""

from __future__ import annotations

import rospy
from controller_interface import Controller, NodeHandle
from hardware_interface import JointCommandInterface, JointHandle
from std_msgs.msg import Float64, Float64MultiArray


class ForwardCommandController(Controller):
    """Parameter ``joint``; topic ``command`` (std_msgs/Float64)."""

    def init(self, hw: JointCommandInterface, root_nh: NodeHandle, controller_nh: NodeHandle) -> None:
        self.joint: JointHandle = hw.get_handle(controller_nh.get_param("joint", str))
        self._command = 0.0
        controller_nh.subscriber("command", Float64, self._receive)

    def _receive(self, message: Float64) -> None:
        self._command = message.data

    def first_command(self, joint: JointHandle) -> float:
        """The command to ``joint`` that is in force from the start until a message comes."""
        return 0.0

    def starting(self, time: float) -> None:
        self._command = self.first_command(self.joint)

    def update(self, time: float, period: float) -> None:
        self.joint.command = self._command


class ForwardJointGroupCommandController(Controller):
    """Parameter ``joints``; topic ``command`` (std_msgs/Float64MultiArray, one value per joint in that order)."""

    def init(self, hw: JointCommandInterface, root_nh: NodeHandle, controller_nh: NodeHandle) -> None:
        self.joints: list[JointHandle] = [hw.get_handle(name) for name in controller_nh.strings("joints")]
        self._commands = [0.0] * len(self.joints)
        self._topic = controller_nh.resolve("command")
        controller_nh.subscriber("command", Float64MultiArray, self._receive)

    def _receive(self, message: Float64MultiArray) -> None:
        if len(message.data) != len(self.joints):
            rospy.logerr(
                "Dimension of command (with size %d) does not match number of joints (%d)! Not executing! (%s)",
                len(message.data),
                len(self.joints),
                self._topic,
            )
            return
        self._commands = list(message.data)

    def first_command(self, joint: JointHandle) -> float:
        """The command of ``joint`` in force from the start until a message comes."""
        return 0.0

    def starting(self, time: float) -> None:
        self._commands = [self.first_command(joint) for joint in self.joints]

    def update(self, time: float, period: float) -> None:
        for joint, command in zip(self.joints, self._commands):
            joint.command = command
