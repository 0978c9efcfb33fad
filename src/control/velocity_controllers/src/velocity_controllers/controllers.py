"""Forwarding of velocities (rad/s or m/s), and position control by velocities."""

from effort_controllers import PidPositionController
from forward_command_controller import ForwardCommandController, ForwardJointGroupCommandController
from hardware_interface import VelocityJointInterface


class JointVelocityController(ForwardCommandController):
    """One joint."""

    interface = VelocityJointInterface


class JointGroupVelocityController(ForwardJointGroupCommandController):
    """Several joints."""

    interface = VelocityJointInterface


class JointPositionController(PidPositionController):
    """A PID on the position error gives the velocity of one joint."""

    interface = VelocityJointInterface
