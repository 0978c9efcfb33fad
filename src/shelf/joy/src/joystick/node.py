"""The node joy_node: publishes ``joy`` (sensor_msgs/Joy), tells /diagnostics, lets motors turn by ``joy/set_feedback``."""

from __future__ import annotations

import glob
import math
import os
import select
import stat
import sys
import time
from collections import deque
from dataclasses import dataclass
from fcntl import ioctl

import diagnostic_updater
import node_signals
import rospy
from diagnostic_msgs.msg import DiagnosticStatus
from node_signals.parameters import ParameterError, number
from sensor_msgs.msg import Joy, JoyFeedback, JoyFeedbackArray

from .rumble import Rumble, event_device
from .state import EVENT, FULL, State

MOST_DEADZONE = 0.9

_LOOK = 0.1  # s between two looks whether the node is being shut down
_RETRY = 1.0  # s
_NAME = 0x80006A13 | 128 << 16  # JSIOCGNAME(128)


@dataclass(frozen=True)
class Settings:
    """Parameters of the node, in bounds."""

    device: str
    name: str
    motors: str
    sticky: bool
    trust: bool
    deadzone: float
    rate: float  # Hz
    pause: float  # s


def _settings() -> Settings:
    """:raises ParameterError: a parameter of another kind, in one line."""
    deadzone = number("~deadzone", 0.05)
    if deadzone >= 1:
        rospy.logwarn(
            "parameter ~deadzone is %g: it is a share of the throw, 0 to 0.9; taken for one of 32767, as it was long ago", deadzone
        )
        deadzone /= FULL
    if deadzone > MOST_DEADZONE:
        rospy.logwarn("parameter ~deadzone is %g, more than %g, which is taken", deadzone, MOST_DEADZONE)
        deadzone = MOST_DEADZONE
    rate, pause = number("~autorepeat_rate", 0.0), number("~coalesce_interval", 0.001)
    if pause > 0 and rate > 1 / pause:
        rospy.logwarn("parameter ~autorepeat_rate, %g Hz, is more than 1 / ~coalesce_interval, %g Hz", rate, 1 / pause)
    return Settings(
        device=str(rospy.get_param("~dev", "/dev/input/js0")),
        name=str(rospy.get_param("~dev_name", "")),
        motors=str(rospy.get_param("~dev_ff", "")),
        sticky=bool(rospy.get_param("~sticky_buttons", False)),
        trust=bool(rospy.get_param("~default_trig_val", False)),
        deadzone=_not_negative("deadzone", deadzone),
        rate=_not_negative("autorepeat_rate", rate),
        pause=_not_negative("coalesce_interval", pause),
    )


def _not_negative(name: str, value: float) -> float:
    if value < 0:
        rospy.logwarn("parameter ~%s is %g, less than 0, which is taken", name, value)
    return max(value, 0.0)


class Node:
    """:raises ParameterError: a parameter of another kind, in one line."""

    def __init__(self) -> None:
        self._settings = _settings()
        self._device = self._settings.device
        self._publisher = rospy.Publisher("joy", Joy, queue_size=1)
        self._motors: Rumble | None = None
        self._wishes: deque[JoyFeedback] = deque(maxlen=100)
        self._open, self._events, self._published, self._since = False, 0, 0, rospy.get_time()
        self._updater = diagnostic_updater.Updater()
        self._updater.setHardwareID("none")
        self._updater.add("Joystick Driver Status", self._diagnose)
        self._feedback = rospy.Subscriber("joy/set_feedback", JoyFeedbackArray, lambda told: self._wishes.extend(told.array), queue_size=10)

    def run(self) -> None:
        """Until the node is shut down."""
        told = False
        self._updater.force_update()
        while not rospy.is_shutdown():
            self._device = _find(self._settings.name) or self._settings.device
            try:
                descriptor = _opened(self._device)
            except OSError as error:
                if not told:
                    rospy.logerr("Couldn't open joystick %s. Will retry every second. (%s)", self._device, error.strerror)
                    told = True
                self._wait(_RETRY)
                continue
            rospy.loginfo("Opened joystick: %s. deadzone_: %f.", self._device, self._settings.deadzone)
            told, self._open = False, True
            self._updater.force_update()
            self._motors = self._find_motors()
            try:
                self._relay(descriptor)
            finally:
                os.close(descriptor)
                self._open = False
                self._forget_motors()
            if not rospy.is_shutdown():
                rospy.logerr("The joystick %s is gone; waiting for it to come back.", self._device)
                told = True
                self._updater.force_update()
                self._wait(_RETRY)

    def _relay(self, descriptor: int) -> None:
        """Until the device is gone or the node shut down. Axes that move together within the pause make one message."""
        state = State(self._settings.deadzone, self._settings.sticky, self._settings.trust)
        period = 1 / self._settings.rate if self._settings.rate > 0 else math.inf
        due, repeat = math.inf, time.monotonic() + period
        while not rospy.is_shutdown():
            self._updater.update()
            self._play()
            wait = min(due, repeat) - time.monotonic()
            if select.select([descriptor], [], [], min(max(wait, 0.0), _LOOK))[0]:
                try:
                    data = os.read(descriptor, EVENT.size)
                except BlockingIOError:
                    continue
                except OSError:
                    return
                if len(data) < EVENT.size:
                    return
                self._events += 1
                _, value, kind, place = EVENT.unpack(data)
                now = time.monotonic()
                due = now if state.take(value, kind, place) else min(due, now + self._settings.pause)
            now = time.monotonic()
            if now >= min(due, repeat):
                if not self._publish(state):
                    return
                due, repeat = math.inf, now + period

    def _publish(self, state: State) -> bool:
        message = Joy(axes=state.axes, buttons=state.buttons)
        message.header.stamp, message.header.frame_id = rospy.Time.now(), self._device
        try:
            self._publisher.publish(message)
        except rospy.ROSException:  # the node is being shut down
            return False
        self._published += 1
        return True

    def _find_motors(self) -> Rumble | None:
        path = self._settings.motors or event_device(self._device)
        try:
            return Rumble.of(path) if path else None
        except OSError as error:
            if self._settings.motors:
                rospy.logwarn("no force feedback by %s (parameter ~dev_ff): %s", path, error.strerror)
            return None

    def _play(self) -> None:
        while self._wishes:
            wish = self._wishes.popleft()
            if self._motors is not None and wish.type == JoyFeedback.TYPE_RUMBLE:
                self._motors.set(wish.id, wish.intensity)
        try:
            if self._motors is not None:
                self._motors.play()
        except OSError as error:
            rospy.logwarn("force feedback of %s has ended: %s", self._device, error.strerror)
            self._forget_motors()

    def _forget_motors(self) -> None:
        motors, self._motors = self._motors, None
        if motors is not None:
            motors.close()

    def _diagnose(self, status: diagnostic_updater.DiagnosticStatusWrapper) -> diagnostic_updater.DiagnosticStatusWrapper:
        now = rospy.get_time()
        passed = now - self._since
        status.summary(*((DiagnosticStatus.OK, "OK") if self._open else (DiagnosticStatus.ERROR, "Joystick not open.")))
        for name, value in {
            "topic": self._publisher.resolved_name,
            "device": self._device,
            "device name": self._settings.name,
            "dead zone": self._settings.deadzone,
            "autorepeat rate (Hz)": self._settings.rate,
            "coalesce interval (s)": self._settings.pause,
            "recent joystick event rate (Hz)": self._events / passed if passed > 0 else 0.0,
            "recent publication rate (Hz)": self._published / passed if passed > 0 else 0.0,
            "subscribers": self._publisher.get_num_connections(),
            "default trig val": self._settings.trust,
            "sticky buttons": self._settings.sticky,
        }.items():
            status.add(name, str(value))
        self._events, self._published, self._since = 0, 0, now
        return status

    def _wait(self, duration: float) -> None:
        end = time.monotonic() + duration
        while time.monotonic() < end and not rospy.is_shutdown():
            time.sleep(_LOOK)
            self._updater.update()


def main() -> int:
    node_signals.init_node("joy_node")
    try:
        node = Node()
    except ParameterError as error:
        print(f"joy_node: {error}", file=sys.stderr)
        return 1
    node.run()
    return 0


def _opened(path: str) -> int:
    """Opened, a device twice: the kernel's first events are then those of now, not of when it was closed last."""
    descriptor = os.open(path, os.O_RDONLY | os.O_NONBLOCK)
    if stat.S_ISCHR(os.fstat(descriptor).st_mode):
        os.close(descriptor)
        descriptor = os.open(path, os.O_RDONLY | os.O_NONBLOCK)
    return descriptor


def _find(name: str) -> str | None:
    """The device whose joystick calls itself so."""
    for path in sorted(glob.glob("/dev/input/js*")) if name else ():
        try:
            descriptor = os.open(path, os.O_RDONLY | os.O_NONBLOCK)
        except OSError:
            continue
        try:
            text = bytearray(128)
            ioctl(descriptor, _NAME, text)
            if name in text.split(b"\0", 1)[0].decode("utf-8", "replace"):
                return path
        except OSError:
            pass
        finally:
            os.close(descriptor)
    return None
