"""The node teleop_turtle: a twist for each arrow key."""

import os
import select
import sys
import termios

import node_signals
import rospy
from geometry_msgs.msg import Twist

HELP = "Reading from keyboard\n---------------------------\nUse arrow keys to move the turtle. 'q' to quit."
#: What an arrow key sends last, after ESC and [: (forwards, turn to the left).
DIRECTIONS = {b"A": (1.0, 0.0), b"B": (-1.0, 0.0), b"C": (0.0, -1.0), b"D": (0.0, 1.0)}


class Keyboard:
    """Keys as they are typed, from a terminal, a pipe or a file. A context manager, which puts the terminal right again."""

    def __init__(self, descriptor: int):
        self._descriptor = descriptor
        self._settings: list | None = None

    def __enter__(self):
        try:
            self._settings = termios.tcgetattr(self._descriptor)
        except termios.error:  # no terminal
            return self
        raw = termios.tcgetattr(self._descriptor)
        raw[3] &= ~(termios.ICANON | termios.ECHO)
        termios.tcsetattr(self._descriptor, termios.TCSANOW, raw)
        return self

    def __exit__(self, *_):
        if self._settings is not None:
            termios.tcsetattr(self._descriptor, termios.TCSANOW, self._settings)

    def keys(self):
        """Byte after byte, until the input ends or the node is shut down."""
        while not rospy.is_shutdown():
            if select.select([self._descriptor], [], [], 0.1)[0]:
                key = os.read(self._descriptor, 1)
                if not key:
                    return
                yield key


def main() -> None:
    node_signals.init_node("teleop_turtle")
    angular, linear = (float(rospy.get_param(name, 2.0)) for name in ("scale_angular", "scale_linear"))
    publisher = rospy.Publisher("turtle1/cmd_vel", Twist, queue_size=1)
    print(HELP, flush=True)
    with Keyboard(sys.stdin.fileno()) as keyboard:
        for key in keyboard.keys():
            if key == b"q":
                return
            if key in DIRECTIONS:
                forwards, left = DIRECTIONS[key]
                twist = Twist()
                twist.linear.x, twist.angular.z = linear * forwards, angular * left
                publisher.publish(twist)
