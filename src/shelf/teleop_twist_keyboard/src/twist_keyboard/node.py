"""The node teleop_twist_keyboard: keys in, cmd_vel out."""

import os
import select
import sys
import termios
import threading
import tty

import node_signals
import rospy
from geometry_msgs.msg import Twist, TwistStamped
from node_signals.parameters import number

from .driving import HELP, Driver

CTRL_C = "\x03"
_LOOK = 0.1  # s between two looks whether the node is being shut down


class Keyboard:
    """Keys from a terminal as they are typed, from a pipe one after the other. A context manager."""

    def __init__(self, descriptor: int):
        self._descriptor = descriptor
        self._settings: list | None = None

    def __enter__(self):
        if os.isatty(self._descriptor):
            self._settings = termios.tcgetattr(self._descriptor)
            tty.setcbreak(self._descriptor, termios.TCSADRAIN)
            mode = termios.tcgetattr(self._descriptor)
            mode[tty.LFLAG] &= ~termios.ISIG  # Ctrl-C comes as a key
            termios.tcsetattr(self._descriptor, termios.TCSADRAIN, mode)
        return self

    def __exit__(self, *_):
        if self._settings is not None:
            termios.tcsetattr(self._descriptor, termios.TCSADRAIN, self._settings)

    def read(self, timeout: float) -> str:
        """The next key; "" if none came within ``timeout`` (s), Ctrl-C at the end of the input."""
        if not select.select([self._descriptor], [], [], timeout)[0]:
            return ""
        return os.read(self._descriptor, 1).decode("latin-1") or CTRL_C


class Sender:
    """Publishes the newest velocities when they change, and again at a rate if one is given."""

    def __init__(self, rate: float, frame_id: str | None = None):
        """:param rate: Hz; 0 publishes changes only
        :param frame_id: of TwistStamped; None publishes Twist
        """
        self._frame_id = frame_id
        self._publisher = rospy.Publisher("cmd_vel", Twist if frame_id is None else TwistStamped, queue_size=1)
        self._lock = threading.Lock()
        self._velocities = (0.0, 0.0, 0.0), 0.0
        self._timer = rospy.Timer(rospy.Duration(1 / rate), self._publish, reset=True) if rate > 0 else None

    def wait_for_subscribers(self) -> bool:
        """False when the node was shut down before one came."""
        turn = 0
        while self._publisher.get_num_connections() == 0 and not rospy.is_shutdown():
            if turn % 25 == 20:
                print(f"Waiting for subscriber to connect to {self._publisher.name}", flush=True)
            turn += 1
            rospy.rostime.wallsleep(_LOOK)
        return not rospy.is_shutdown()

    def send(self, linear: tuple, angular: float) -> None:
        """Publish ``linear``, (x, y, z) m/s, and ``angular``, rad/s about z."""
        self._velocities = linear, angular
        self._publish()

    def stop(self) -> None:
        """The last word: zero."""
        if self._timer:
            self._timer.shutdown()
        self.send((0.0, 0.0, 0.0), 0.0)

    def _publish(self, _event=None) -> None:
        twist = Twist()
        with self._lock:
            (twist.linear.x, twist.linear.y, twist.linear.z), twist.angular.z = self._velocities
            message = twist
            if self._frame_id is not None:
                message = TwistStamped(twist=twist)
                message.header.stamp, message.header.frame_id = rospy.Time.now(), self._frame_id
            try:
                self._publisher.publish(message)
            except rospy.ROSException:  # the node is being shut down
                pass


def main() -> int:
    node_signals.init_node("teleop_twist_keyboard")
    try:
        speed, turn, speed_limit, turn_limit, rate, key_timeout = (
            number("~" + name, default, least=0.0)
            for name, default in (
                ("speed", 0.5),
                ("turn", 1.0),
                ("speed_limit", 1000.0),
                ("turn_limit", 1000.0),
                ("repeat_rate", 0.0),
                ("key_timeout", 0.0),
            )
        )
    except ValueError as error:
        print(f"teleop_twist_keyboard: {error}", file=sys.stderr)
        return 1
    sender = Sender(rate, str(rospy.get_param("~frame_id", "")) if rospy.get_param("~stamped", False) else None)
    driver = Driver(speed, turn, speed_limit, turn_limit)
    if not sender.wait_for_subscribers():
        return 0
    with Keyboard(sys.stdin.fileno()) as keyboard:
        sender.send(driver.linear, driver.angular)
        print(HELP)
        print(driver.status(), flush=True)
        for key in _keys(keyboard, key_timeout):
            new, text = driver.press(key)
            if text:
                print(text, flush=True)
            if new:
                sender.send(driver.linear, driver.angular)
        sender.stop()
    return 0


def _keys(keyboard: Keyboard, timeout: float):
    """Keys until Ctrl-C or the end of the node; "" after each timeout (s; 0: never) without one."""
    waited = 0.0
    while not rospy.is_shutdown():
        step = min(_LOOK, timeout - waited) if timeout > 0 else _LOOK
        key = keyboard.read(step)
        waited = 0.0 if key else waited + step
        if key == CTRL_C:
            return
        if key or timeout > 0 and waited >= timeout - 1e-9:
            waited = 0.0
            yield key
