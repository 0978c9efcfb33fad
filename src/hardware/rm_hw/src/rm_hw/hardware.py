"""RmRobotHW: the motors on the CAN buses as a robot of the control stack."""

from __future__ import annotations

import math
import os
import time as clock
from collections.abc import Callable
from typing import Any

import can
import rospkg
import rospy
import yaml
from hardware_interface import (
    ActuatorHandle,
    ActuatorStateHandle,
    ActuatorStateInterface,
    EffortActuatorInterface,
    EffortJointInterface,
    ImuSensorInterface,
    RobotHW,
)
from joint_limits_interface import (
    DescriptionError,
    EffortJointSaturationHandle,
    EffortJointSoftLimitsHandle,
    JointLimits,
    JointLimitsError,
    JointLimitsInterface,
    limits_from_params,
    limits_from_urdf,
    read_joints,
    soft_limits_from_params,
    soft_limits_from_urdf,
)
from realtime_tools import RealtimePublisher
from rm_msgs.msg import ActuatorState
from rm_msgs.srv import EnableImuTrigger, EnableImuTriggerResponse
from transmission_interface import RobotTransmissions, TransmissionInterfaceLoader

from rm_hw import frames
from rm_hw.actuator import WARM, Actuator
from rm_hw.can_bus import CanBus
from rm_hw.coefficients import ConfigError
from rm_hw.command_frames import CommandFrames
from rm_hw.config import Config, parse
from rm_hw.guard import Guard
from rm_hw.imu import Imu

_LOG = {"info": rospy.loginfo, "warn": rospy.logwarn, "error": rospy.logerr}
_PUBLISH_PERIOD = 0.01  # s
_COOLED = 5  # degrees Celsius below WARM before a motor is warned about again
_ARRAYS = (
    "name",
    "type",
    "bus",
    "id",
    "halted",
    "need_calibration",
    "calibrated",
    "calibration_reading",
    "position_raw",
    "velocity_raw",
    "temperature",
    "circle",
    "last_position_raw",
    "frequency",
    "position",
    "velocity",
    "effort",
    "commanded_effort",
    "executed_effort",
    "offset",
)


def report(level: str, text: str) -> None:
    """Log ``text``, a line. :param level: info, warn or error."""
    _LOG[level]("%s", text)


def package_coefficients() -> dict[str, dict]:
    """The table that comes with rm_hw."""
    path = os.path.join(rospkg.RosPack().get_path("rm_hw"), "config", "actuator_coefficient.yaml")
    with open(path) as file:
        return yaml.safe_load(file)["actuator_coefficient"]


class _Bus:
    """A CAN bus with who is on it."""

    def __init__(self, can_bus: CanBus, actuators: list[Actuator], imus: list[Imu]) -> None:
        self.can_bus = can_bus
        self.commands = CommandFrames(actuators)
        self.motors = {a.id: a for a in actuators if "cheetah" not in a.type}
        self.cheetahs = {a.id: a for a in actuators if "cheetah" in a.type}
        self.gyros = {imu.config.id: imu for imu in imus}
        self.accels = {imu.config.id + 1: imu for imu in imus}
        self._unknown: set[int] = set()

    def read(self, now: float) -> None:
        """Take all frames that have come. Of several from one motor the newest counts, the others only its turns."""
        newest: dict[tuple[int, int], can.Message] = {}
        for message in self.can_bus.receive():
            motor = message.data[0] if message.arbitration_id == frames.CHEETAH_REPLY_ID and message.data else 0
            overtaken = newest.get((message.arbitration_id, motor))
            newest[message.arbitration_id, motor] = message
            if overtaken is not None and overtaken.arbitration_id in self.motors:
                self._guarded(self._follow, overtaken, now)
        for message in newest.values():
            self._guarded(self._take, message, now)

    def _guarded(self, take: Callable[[can.Message, float], None], message: can.Message, now: float) -> None:
        try:
            take(message, now)
        except ValueError as error:
            rospy.logwarn_throttle(1.0, f"{self.can_bus.name}: frame 0x{message.arbitration_id:03X} ignored: {error}")

    def _follow(self, message: can.Message, now: float) -> None:
        self.motors[message.arbitration_id].follow(frames.unpack_feedback(bytes(message.data)).angle)

    def _take(self, message: can.Message, now: float) -> None:
        identifier, data, stamp = message.arbitration_id, bytes(message.data), message.timestamp
        if identifier in self.motors:
            self.motors[identifier].on_feedback(frames.unpack_feedback(data), stamp, now)
        elif identifier in self.gyros:
            self.gyros[identifier].on_gyro(frames.unpack_imu_gyro(data), stamp)
        elif identifier in self.accels:
            self.accels[identifier].on_accel(frames.unpack_imu_accel(data))
        elif identifier == frames.CHEETAH_REPLY_ID:
            reply = frames.unpack_cheetah_reply(data)
            if reply.motor_id in self.cheetahs:
                self.cheetahs[reply.motor_id].on_cheetah(reply, stamp, now)
        elif identifier not in self._unknown:
            self._unknown.add(identifier)
            report(
                "error",
                f"Can not find defined device, id: 0x{identifier:X} on bus: {self.can_bus.name}; if it is "
                "a motor of yours, add it to rm_hw/actuators",
            )

    def write(self, now: float) -> None:
        if self.can_bus.connected:
            for identifier, data in self.commands.build(now):
                self.can_bus.send(identifier, data)

    def switch_off(self) -> None:
        for identifier, data in self.commands.zero():
            self.can_bus.send(identifier, data)


class RmRobotHW(RobotHW):
    """See the module docstring. Between :meth:`init` and :meth:`close` a guard process watches over the motors."""

    def __init__(self) -> None:
        super().__init__()
        self.config = Config()
        self._actuators: list[tuple[Actuator, ActuatorStateHandle, ActuatorHandle]] = []
        self._buses: list[_Bus] = []
        self._imus: dict[str, Imu] = {}
        self._joints: list = []
        self._limits = JointLimitsInterface()
        self._transmissions = RobotTransmissions()
        self._warned_warm: set[str] = set()
        self._next_publish = 0.0
        self._guard: Guard | None = None
        self._part: Any = None  # an RmControlPart, once a compiled controller is loaded

    def init(self, root_nh, robot_hw_nh) -> bool:
        """Set up from parameters.

        :raises ConfigError: they cannot be used; one line.
        """
        params = rospy.get_param(robot_hw_nh.namespace, {})
        self.config = parse(params if isinstance(params, dict) else {}, package_coefficients())
        for level, text in self.config.lines:
            report(level, text)
        self._make_actuators()
        self._make_imus()
        self._load_description(root_nh)
        self._publisher = RealtimePublisher(root_nh, "actuator_states", ActuatorState, queue_size=10)
        self._service = robot_hw_nh.service("imu_trigger", EnableImuTrigger, self._enable_imu_trigger)
        for bus in self.config.buses:
            can_bus = CanBus(bus.name, bus.interface, bus.channel, report, bus.bitrate)
            self._buses.append(
                _Bus(
                    can_bus,
                    [a for a, _, _ in self._actuators if a.bus == bus.name],
                    [imu for imu in self._imus.values() if imu.config.bus == bus.name],
                )
            )
            can_bus.start()
        self._guard = Guard(
            [(bus.interface, bus.channel, bus.bitrate, made.commands.zero()) for bus, made in zip(self.config.buses, self._buses)]
        )
        return True

    def _make_actuators(self) -> None:
        states, efforts = ActuatorStateInterface(), EffortActuatorInterface()
        for c in self.config.actuators:
            actuator = Actuator(c.name, c.type, c.bus, c.id, c.coefficients, c.need_calibration, c.cutoff, c.timeout)
            state = ActuatorStateHandle(c.name)
            handle = ActuatorHandle(state)
            states.register_handle(state)
            efforts.register_handle(handle)
            self._actuators.append((actuator, state, handle))
        self.register_interface(states)
        self.register_interface(efforts)

    def _make_imus(self) -> None:
        interface = ImuSensorInterface()
        for config in self.config.imus:
            imu = self._imus[config.name] = Imu(config)
            interface.register_handle(imu.handle)
        self.register_interface(interface)

    def _load_description(self, root_nh) -> None:
        urdf = rospy.get_param("/robot_description", None)
        if not isinstance(urdf, str) or not urdf.strip():
            raise ConfigError(
                "parameter /robot_description is empty: load the URDF in the launch file, before rm_hw "
                'starts: <param name="robot_description" command="$(find xacro)/xacro FILE"/>'
            )
        if not TransmissionInterfaceLoader(self, self._transmissions).load(urdf):
            actuators = ", ".join(a.name for a, _, _ in self._actuators) or "none"
            raise ConfigError(f"the transmissions of /robot_description cannot be used (see above); configured actuators: {actuators}")
        effort_joints = self.get(EffortJointInterface)
        self._joints = effort_joints.handles() if effort_joints else []
        try:
            descriptions = read_joints(urdf)
            for joint in self._joints:
                joint.command = 0.0
                self._limit(joint, descriptions.get(joint.name), root_nh)
        except (DescriptionError, JointLimitsError) as error:
            raise ConfigError(str(error)) from None

    def _limit(self, joint, description, root_nh) -> None:
        limits = limits_from_urdf(description) if description else None
        limits = limits_from_params(root_nh, joint.name, limits or JointLimits()) or limits
        if limits is None:
            report(
                "warn",
                f"joint '{joint.name}' has no <limit> in the URDF and no joint_limits/{joint.name}: only the motor limits its effort",
            )
            return
        soft = soft_limits_from_params(root_nh, joint.name)
        if soft is None and description:
            soft = soft_limits_from_urdf(description)
        self._limits.register_handle(
            EffortJointSoftLimitsHandle(joint, limits, soft) if soft else EffortJointSaturationHandle(joint, limits)
        )

    def compiled_part(self) -> Any:
        """The interfaces of rm_common."""
        try:
            from rm_hw.rm_control import RmControlPart
        except ImportError:  # built without what compiled controllers need
            return None
        self._part = RmControlPart([actuator for actuator, _, _ in self._actuators], self._imus)
        return self._part.robot

    def read(self, time: float, period: float) -> None:
        """Frames to joint states; all joint efforts are set to zero, so that a joint without controller gets none."""
        now = clock.monotonic()
        part = self._part
        if part is not None:
            part.take()
        for bus in self._buses:
            bus.read(now)
        for actuator, state, _ in self._actuators:
            line = actuator.check(now)
            if line:
                report("error" if actuator.halted else "info", line)
            self._watch_temperature(actuator)
            state.position, state.velocity, state.effort = actuator.position, actuator.velocity, actuator.effort
        if part is not None:
            part.show()
        self._transmissions.actuator_to_joint_state.propagate()
        for joint in self._joints:
            joint.command = 0.0

    def write(self, time: float, period: float) -> None:
        """Joint efforts, limited, to frames."""
        for joint in self._joints:
            if not math.isfinite(joint.command):
                rospy.logerr_throttle(
                    1.0,
                    f"the command to joint '{joint.name}' is {joint.command}: sending 0 Nm "
                    "instead; look for a division by zero or an unset value in its controller",
                )
                joint.command = 0.0
        efforts = self._transmissions.joint_to_actuator_effort
        efforts.propagate()
        for actuator, _, handle in self._actuators:
            actuator.commanded_effort = handle.command
        self._limits.enforce_limits(period)
        efforts.propagate()
        now = clock.monotonic()
        for actuator, _, handle in self._actuators:
            actuator.executed_effort = 0.0 if actuator.halted else handle.command
        for bus in self._buses:
            bus.write(now)
        if now >= self._next_publish:
            self._next_publish = max(now, self._next_publish + _PUBLISH_PERIOD)
            self._publish()

    def switch_off(self) -> None:
        """Zero current to every motor, now."""
        for bus in self._buses:
            bus.switch_off()

    def close(self) -> None:
        """Switch off and leave the buses."""
        self.switch_off()
        for bus in self._buses:
            bus.can_bus.close()
        if self._guard:
            self._guard.dismiss()

    def _publish(self) -> None:
        if not self._publisher.has_subscribers:
            return
        message = ActuatorState(stamp=[rospy.Time.from_sec(a.stamp) for a, _, _ in self._actuators])
        for name in _ARRAYS:
            setattr(message, name, [getattr(a, name) for a, _, _ in self._actuators])
        self._publisher.publish(message)

    def _watch_temperature(self, actuator: Actuator) -> None:
        if actuator.temperature > WARM and actuator.name not in self._warned_warm:
            self._warned_warm.add(actuator.name)
            report(
                "warn",
                f"actuator '{actuator.name}' is at {actuator.temperature} C: above 99 C it is disabled; lower the load or let it rest",
            )
        elif actuator.temperature < WARM - _COOLED:
            self._warned_warm.discard(actuator.name)

    def _enable_imu_trigger(self, request) -> EnableImuTriggerResponse:
        imu = self._imus.get(request.imu_name)
        bus = next((b for b in self._buses if imu and b.can_bus.name == imu.config.bus), None)
        if imu is None or bus is None:
            report("error", f"there is no IMU '{request.imu_name}'; there are: {', '.join(self._imus) or 'none'}")
            return EnableImuTriggerResponse(False)
        return EnableImuTriggerResponse(bus.can_bus.send(imu.config.id + 2, bytes((request.enable_trigger,))))
