"""DefaultRobotHWSim: the joints of a model that have a transmission, as ros_control hardware."""

from __future__ import annotations

import math
import sys

import rospy
from control_toolbox import PidParameterError, RosPid, load_pid
from controller_interface import NodeHandle
from hardware_interface import (
    EffortJointInterface,
    JointCommandInterface,
    JointHandle,
    JointStateHandle,
    JointStateInterface,
    PositionJointInterface,
    VelocityJointInterface,
)
from joint_limits_interface import (
    DescriptionError,
    EffortJointSaturationHandle,
    EffortJointSoftLimitsHandle,
    JointDescription,
    JointLimits,
    PositionJointSaturationHandle,
    PositionJointSoftLimitsHandle,
    VelocityJointSaturationHandle,
    VelocityJointSoftLimitsHandle,
    limits_from_params,
    limits_from_urdf,
    read_joints,
    soft_limits_from_urdf,
)
from transmission_interface import TransmissionInfo

from .joint_sim import EffortMode, JointSim, Mode, PositionMode, PositionPidMode, VelocityMode, VelocityPidMode
from .robot_hw_sim import RobotHWSim
from .wiring import Wiring

_PREFIX = "hardware_interface/"

_INTERFACES: dict[str, type[JointCommandInterface]] = {
    "EffortJointInterface": EffortJointInterface,
    "PositionJointInterface": PositionJointInterface,
    "VelocityJointInterface": VelocityJointInterface,
}

_SATURATION = {
    EffortJointInterface: EffortJointSaturationHandle,
    PositionJointInterface: PositionJointSaturationHandle,
    VelocityJointInterface: VelocityJointSaturationHandle,
}
_SOFT = {
    EffortJointInterface: EffortJointSoftLimitsHandle,
    PositionJointInterface: PositionJointSoftLimitsHandle,
    VelocityJointInterface: VelocityJointSoftLimitsHandle,
}

#: A joint without limits still has handles: they keep NaN and infinities out.
_UNLIMITED = JointLimits(max_velocity=math.inf, max_effort=math.inf, has_velocity_limits=True, has_effort_limits=True)


class DefaultRobotHWSim(RobotHWSim):
    """Position, velocity and effort commands for every joint that has a transmission."""

    def __init__(self) -> None:
        super().__init__()
        self._states = JointStateInterface()
        self._commands = {interface: interface() for interface in _INTERFACES.values()}
        self._joints: dict[str, JointSim] = {}
        self._writers: tuple[JointSim, ...] = ()
        self._wiring = Wiring(())
        self._without_gains: list[str] = []  # joints that follow their commands exactly
        self._e_stop = False

    def init_sim(self, robot_namespace: str, model_nh: NodeHandle, model, urdf: str | None, transmissions: list[TransmissionInfo]) -> bool:
        try:
            descriptions = read_joints(urdf) if urdf else {}
        except DescriptionError as error:
            rospy.logerr("model '%s': %s; the limits of its joints are not known", model.name, error)
            descriptions = {}
        for interface in (self._states, *self._commands.values()):
            self.register_interface(interface)
        for transmission in transmissions:
            self._add(transmission, model_nh, model, descriptions)
        if self._without_gains:
            rospy.loginfo(
                "nothing is wrong with joints without a p gain: %s follow their commands exactly; set p, i and d in "
                "a namespace above if a PID should drive its joint by forces",
                ", ".join(self._without_gains),
            )
        self._writers = tuple(self._joints.values())
        self._wiring = Wiring(self._writers)
        self.on_drive(*(sim.joint for sim in self._writers if not isinstance(sim.mode, EffortMode)))  # which hold without a controller
        if not self._writers:
            rospy.logwarn("model '%s': no joint has a transmission that can be used, so controllers find no joints", model.name)
        return True

    # -- set-up -------------------------------------------------------------------------------------------------------

    def _add(self, transmission: TransmissionInfo, nh: NodeHandle, model, descriptions: dict[str, JointDescription]) -> None:
        if len(transmission.joints) != 1:
            rospy.logwarn(
                "Transmission '%s' (%s) has %d joints; it is left out: the simulation, as Gazebo's, drives joints "
                "directly; for it, give each of %s a SimpleTransmission of its own",
                transmission.name,
                transmission.type,
                len(transmission.joints),
                ", ".join(j.name for j in transmission.joints),
            )
            return
        info = transmission.joints[0]
        where = f"transmission '{transmission.name}', joint '{info.name}'"
        joint = model.joints.get(info.name)
        if joint is None:
            rospy.logerr(
                "%s: the model '%s' has no such joint (a fixed joint is merged into its parent link); it has: "
                "%s. The other transmissions work.",
                where,
                model.name,
                ", ".join(model.joints) or "none",
            )
            return
        for written in info.hardware_interfaces:
            interface = self._interface_of(written, where)
            if interface is not None:
                self._add_mode(interface, joint, where, nh, descriptions.get(info.name, JointDescription(info.name, "")))

    @staticmethod
    def _interface_of(written: str, where: str) -> type[JointCommandInterface] | None:
        name = written[len(_PREFIX) :] if written.startswith(_PREFIX) else written
        interface = _INTERFACES.get(name)
        if interface is None:
            rospy.logerr(
                "%s: hardware interface '%s' cannot be simulated and is left out; possible are %s",
                where,
                written,
                ", ".join(_PREFIX + known for known in _INTERFACES),
            )
        elif name == written:
            rospy.logwarn(
                "Deprecated syntax, please prepend 'hardware_interface/' to '%s' within the <hardwareInterface> tag of %s.", written, where
            )
        return interface

    def _add_mode(self, interface: type[JointCommandInterface], joint, where: str, nh: NodeHandle, description: JointDescription) -> None:
        sim = self._joints.get(description.name)
        if sim is None:
            state = JointStateHandle(description.name, joint.position(), joint.velocity())
            self._states.register_handle(state)
            sim = self._joints[description.name] = JointSim(joint, state)
        if interface.type_name in sim.modes:
            rospy.logwarn("%s: %s is there already from another transmission of this joint; one is enough", where, interface.type_name)
            return
        handle = JointHandle(sim.state, 0.0)
        self._commands[interface].register_handle(handle)
        sim.add(interface.type_name, self._make_mode(interface, joint, handle, nh, description))

    def _make_mode(
        self, interface: type[JointCommandInterface], joint, handle: JointHandle, nh: NodeHandle, description: JointDescription
    ) -> Mode:
        hard = limits_from_urdf(description)
        hard = limits_from_params(nh, description.name, hard or JointLimits()) or hard
        soft = soft_limits_from_urdf(description)
        limits = _limit_handle(interface, handle, hard, soft)
        effort_limit = hard.max_effort if hard and hard.has_effort_limits else sys.float_info.max
        _warn_of_zero_limits(description, hard, interface)
        _warn_of_zero_gains(description, hard, soft, interface)
        if interface is EffortJointInterface:
            return EffortMode(joint, handle, limits, effort_limit)
        pid = _load_gains(nh.sub(f"gazebo_ros_control/pid_gains/{description.name}"), description.name)
        if pid is None and description.name not in self._without_gains:
            self._without_gains.append(description.name)
        if interface is PositionJointInterface:
            if pid is None:
                return PositionMode(joint, handle, limits)
            return PositionPidMode(joint, handle, limits, pid, description, effort_limit)
        if pid is None:
            return VelocityMode(joint, handle, limits, effort_limit)
        return VelocityPidMode(joint, handle, limits, effort_limit, pid)

    # -- every step ----------------------------------------------------------------------------------------------------

    def read_sim(self, time: float, period: float) -> None:
        self._wiring.read()

    def write_sim(self, time: float, period: float) -> None:
        self._wiring.write(period)

    def e_stop_active(self, active: bool) -> None:
        if active is not self._e_stop:
            self._e_stop = active
            for sim in self._writers:
                sim.mode.press(active)
            self._wiring.stop(active)

    def reset_sim(self) -> None:
        self.read_sim(0.0, 0.0)
        for sim in self._writers:
            for mode in sim.modes.values():
                mode.limits.reset()

    def do_switch(self, start, stop) -> None:
        driven = []
        for controller in start:
            for claimed in controller.claimed_resources:
                for name in claimed.resources:
                    sim = self._joints.get(name)
                    if sim is not None and claimed.hardware_interface in sim.modes:
                        sim.modes[claimed.hardware_interface].handle.slope = 0.0  # the law of whoever commanded before
                        sim.switch(claimed.hardware_interface)
                        driven.append(sim.joint)
        self.on_drive(*driven)
        self._wiring.engage()


def _limit_handle(interface: type[JointCommandInterface], handle: JointHandle, hard: JointLimits | None, soft):
    """The handle that enforces the limits of a joint; a joint without complete limits gets one that only stops NaN."""
    if hard is None:
        hard, soft = _UNLIMITED, None
    velocity = hard.has_velocity_limits
    effort = hard.has_effort_limits
    needed = {EffortJointInterface: velocity and effort, VelocityJointInterface: velocity}.get(interface, True)
    if not needed:
        rospy.logwarn(
            "joint '%s' lacks the velocity%s limits that enforcing its limits needs; it is not limited",
            handle.name,
            " and effort" if interface is EffortJointInterface else "",
        )
        hard, soft = _UNLIMITED, None
    if soft is not None and (velocity or interface is VelocityJointInterface):
        return _SOFT[interface](handle, hard, soft)
    return _SATURATION[interface](handle, hard)


def _warn_of_zero_limits(description: JointDescription, hard: JointLimits | None, interface: type[JointCommandInterface]) -> None:
    """A limit of 0 means just that, and is mostly a forgotten value."""
    if hard is None:
        return
    if hard.has_velocity_limits and hard.max_velocity == 0.0:
        rospy.logwarn(
            "joint '%s' has a velocity limit of 0: it cannot move; write <limit velocity=\"...\"> in rad/s or m/s", description.name
        )
    if hard.has_effort_limits and hard.max_effort == 0.0 and interface is not PositionJointInterface:
        rospy.logwarn(
            "joint '%s' has an effort limit of 0: no force can move it; write <limit effort=\"...\"> in Nm or N", description.name
        )


def _warn_of_zero_gains(description: JointDescription, hard: JointLimits | None, soft, interface: type[JointCommandInterface]) -> None:
    """The gains of a ``<safety_controller>`` are how much a joint may move at all: 0 is mostly a forgotten value as well."""
    if soft is None or hard is None:
        return
    if soft.k_velocity == 0.0 and interface is EffortJointInterface:
        rospy.logwarn(
            "joint '%s' has a <safety_controller> with k_velocity 0: no force can move it; write how many Nm per rad/s (N per "
            "m/s) it may brake with, or leave the <safety_controller> out",
            description.name,
        )
    elif soft.k_position == 0.0 and hard.has_position_limits:
        rospy.logwarn(
            "joint '%s' has a <safety_controller> with k_position 0: it cannot move; write how many rad/s per rad (m/s per m) "
            "it may approach its soft limits with, or leave the <safety_controller> out",
            description.name,
        )


def _load_gains(nh: NodeHandle, joint: str) -> RosPid | None:
    """The PID of a joint, or None, which is a good way to drive it too."""
    if not nh.has_param("p"):
        rospy.loginfo("No p gain specified for pid.  Namespace: %s", nh.namespace)
        return None
    try:
        return load_pid(nh)
    except PidParameterError as error:
        rospy.logerr("%s; joint '%s' follows its commands exactly instead", error, joint)
        return None
