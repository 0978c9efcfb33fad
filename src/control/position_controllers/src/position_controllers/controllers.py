"""Forwarding of positions (rad or m). A controller starts with the position that the joint has, so nothing jumps."""

from forward_command_controller import ForwardCommandController, ForwardJointGroupCommandController
from hardware_interface import JointHandle, PositionJointInterface


class JointPositionController(ForwardCommandController):
    """One joint."""

    interface = PositionJointInterface

    def first_command(self, joint: JointHandle) -> float:
        return joint.position


class JointGroupPositionController(ForwardJointGroupCommandController):
    """Several joints."""

    interface = PositionJointInterface

    def first_command(self, joint: JointHandle) -> float:
        return joint.position
