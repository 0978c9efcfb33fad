"""The node joy_node: publishes ``joy`` (sensor_msgs/Joy)."""

import glob
import math
import os
import select
import sys
import time
from fcntl import ioctl

import node_signals
import rospy
from node_signals.parameters import number
from sensor_msgs.msg import Joy

from .state import EVENT, State

_LOOK = 0.1  # s between two looks whether the node is being shut down
_RETRY = 1.0  # s
_NAME = 0x80006A13 | 128 << 16  # JSIOCGNAME(128)


def main() -> int:
    node_signals.init_node("joy_node")
    try:
        device = str(rospy.get_param("~dev", "/dev/input/js0"))
        name = str(rospy.get_param("~dev_name", ""))
        sticky = bool(rospy.get_param("~sticky_buttons", False))
        rate, pause = number("~autorepeat_rate", 0.0, 0.0), number("~coalesce_interval", 0.001, 0.0)
        deadzone = number("~deadzone", 0.05, 0.0)
        State(deadzone)
    except ValueError as error:
        print(f"joy_node: {error}", file=sys.stderr)
        return 1
    publisher = rospy.Publisher("joy", Joy, queue_size=1)
    told = False
    while not rospy.is_shutdown():
        path = _find(name) or device
        try:
            descriptor = os.open(path, os.O_RDONLY | os.O_NONBLOCK)
        except OSError as error:
            if not told:
                rospy.logerr("Couldn't open joystick %s. Will retry every second. (%s)", path, error.strerror)
                told = True
            _wait(_RETRY)
            continue
        rospy.loginfo("Opened joystick: %s. deadzone_: %f.", path, deadzone)
        told = False
        try:
            _relay(descriptor, State(deadzone, sticky), publisher, rate, pause)
        finally:
            os.close(descriptor)
        if not rospy.is_shutdown():
            rospy.logerr("The joystick %s is gone; waiting for it to come back.", path)
            told = True
            _wait(_RETRY)
    return 0


def _relay(descriptor: int, state: State, publisher, rate: float, pause: float) -> None:
    """Until the device is gone or the node shut down. Axes that move together within ``pause`` s make one message."""
    period = 1 / rate if rate > 0 else math.inf
    due, repeat = math.inf, time.monotonic() + period
    while not rospy.is_shutdown():
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
            _, value, kind, number = EVENT.unpack(data)
            now = time.monotonic()
            due = now if state.take(value, kind, number) else min(due, now + pause)
        now = time.monotonic()
        if now >= min(due, repeat):
            message = Joy(axes=state.axes, buttons=state.buttons)
            message.header.stamp = rospy.Time.now()
            try:
                publisher.publish(message)
            except rospy.ROSException:  # the node is being shut down
                return
            due, repeat = math.inf, now + period


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


def _wait(duration: float) -> None:
    end = time.monotonic() + duration
    while time.monotonic() < end and not rospy.is_shutdown():
        time.sleep(_LOOK)
