"""Forwarding of efforts (Nm or N), and PID control of positions and velocities."""

from __future__ import annotations

import rospy
from control_msgs.msg import JointControllerState
from control_toolbox import load_pid
from controller_interface import Controller, InitError, NodeHandle, RealtimePublisher, to_stamp
from forward_command_controller import ForwardCommandController, ForwardJointGroupCommandController
from hardware_interface import EffortJointInterface, JointCommandInterface, JointHandle
from joint_limits_interface import DescriptionError, JointDescription, read_joints
from std_msgs.msg import Float64

#: The state topic gets every n-th update.
_STATE_DIVIDER = 10


class JointEffortController(ForwardCommandController):
    """One joint."""

    interface = EffortJointInterface


class JointGroupEffortController(ForwardJointGroupCommandController):
    """Several joints."""

    interface = EffortJointInterface


def describe_joints(nh: NodeHandle, names: list[str]) -> list[JointDescription]:
    """Joints ``names`` in the closest ``robot_description`` above ``nh``.

    :raises InitError: no description, or a joint is not in it.
    """
    place = nh.search_param("robot_description")
    if place is None:
        raise InitError(f"Could not find parameter robot_description in {nh.namespace} or any namespace above it")
    try:
        joints = read_joints(str(rospy.get_param(place)))
    except DescriptionError as error:
        raise InitError(f"parameter {place}: {error}") from None
    missing = [name for name in names if name not in joints]
    if missing:
        raise InitError(f"Could not find joint '{missing[0]}' in the urdf of {place}; it has: {', '.join(sorted(joints)) or 'no joints'}")
    return [joints[name] for name in names]


class _PidController(Controller):
    """One joint under a PID: parameters ``joint`` and ``pid/...``, topics ``command`` and ``state``."""

    def init(self, hw: JointCommandInterface, root_nh: NodeHandle, controller_nh: NodeHandle) -> None:
        self.joint: JointHandle = hw.get_handle(controller_nh.get_param("joint", str))
        self.prepare(controller_nh)
        self._pid = load_pid(controller_nh.sub("pid"))
        self._target = 0.0
        self._updates = 0
        self._state = RealtimePublisher(controller_nh, "state", JointControllerState, queue_size=1)
        controller_nh.subscriber("command", Float64, self._receive)

    def prepare(self, controller_nh: NodeHandle) -> None:
        """What a kind of controller needs before its gains are read."""

    def _receive(self, message: Float64) -> None:
        self._target = message.data

    def _publish(self, time: float, period: float, target: float, value: float, value_dot: float, error: float, command: float) -> None:
        """To be called every update; every tenth goes out, the first included."""
        due = self._updates % _STATE_DIVIDER == 0
        self._updates += 1
        if not due or not self._state.has_subscribers:
            return
        gains = self._pid.gains
        message = JointControllerState(
            set_point=target,
            process_value=value,
            process_value_dot=value_dot,
            error=error,
            time_step=period,
            command=command,
            p=gains.p,
            i=gains.i,
            d=gains.d,
            i_clamp=gains.i_max,
            antiwindup=gains.antiwindup,
        )
        message.header.stamp = to_stamp(time)
        self._state.publish(message)


class PidPositionController(_PidController):
    """Drives one joint to a position; the PID's output is whatever the interface commands."""

    def prepare(self, controller_nh: NodeHandle) -> None:
        """Read how the joint may move, from the robot's description as ``controller_nh`` finds it."""
        (self._description,) = describe_joints(controller_nh, [self.joint.name])

    def starting(self, time: float) -> None:
        self._target = self._description.clamp(self.joint.position)
        self._pid.reset()

    def update(self, time: float, period: float) -> None:
        target = self._description.clamp(self._target)
        position = self.joint.state.position
        error = self._description.error(position, target)
        command = self._pid.compute_command(error, period)
        self.joint.command = command
        self.joint.slope = self._pid.slope_of_position(period)
        self._publish(time, period, target, position, self.joint.state.velocity, error, command)


class JointPositionController(PidPositionController):
    """Drives one joint to a position by efforts."""

    interface = EffortJointInterface


class JointVelocityController(_PidController):
    """Drives one joint at a velocity by efforts."""

    interface = EffortJointInterface

    def starting(self, time: float) -> None:
        self._target = 0.0
        self._pid.reset()

    def update(self, time: float, period: float) -> None:
        target = self._target
        velocity = self.joint.state.velocity
        error = target - velocity
        command = self._pid.compute_command(error, period)
        self.joint.command = command
        self.joint.slope = self._pid.slope_of_velocity(period)
        self._publish(time, period, target, velocity, 0.0, error, command)


class JointGroupPositionController(ForwardJointGroupCommandController):
    """Drives several joints to positions by efforts: parameters ``joints`` and ``<joint>/pid/...``."""

    interface = EffortJointInterface

    def init(self, hw: JointCommandInterface, root_nh: NodeHandle, controller_nh: NodeHandle) -> None:
        names = controller_nh.strings("joints")
        self._descriptions = describe_joints(controller_nh, names)
        self._pids = [load_pid(controller_nh.sub(f"{name}/pid")) for name in names]
        super().init(hw, root_nh, controller_nh)

    def starting(self, time: float) -> None:
        self._commands = [description.clamp(joint.position) for joint, description in zip(self.joints, self._descriptions)]
        for pid in self._pids:
            pid.reset()

    def update(self, time: float, period: float) -> None:
        for joint, description, pid, command in zip(self.joints, self._descriptions, self._pids, self._commands):
            error = description.error(joint.state.position, description.clamp(command))
            joint.command = pid.compute_command(error, period)
            joint.slope = pid.slope_of_position(period)
