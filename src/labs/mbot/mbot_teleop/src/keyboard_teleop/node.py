"""The node mbot_teleop: keys in, /cmd_vel out."""

import sys

import rospy
from geometry_msgs.msg import Twist

from .driving import HELP, Driver
from .keyboard import Keyboard

CTRL_C = "\x03"


def main():
    # without rospy's signal handling Ctrl-C ends the loop below, which still can send the last zero
    rospy.init_node("mbot_teleop", disable_signals=True)
    publisher = rospy.Publisher("/cmd_vel", Twist, queue_size=5)
    driver = Driver()
    print(HELP)
    print(driver.status(), flush=True)
    try:
        with Keyboard(sys.stdin.fileno()) as keyboard:
            while not (keyboard.ended and driver.at_rest()):
                key = keyboard.read()
                if key == CTRL_C or rospy.is_shutdown():
                    break
                text = driver.turn(key)
                if text:
                    print(text, flush=True)
                publisher.publish(_twist(driver.linear, driver.angular))
    except KeyboardInterrupt:
        pass
    finally:
        publisher.publish(_twist(0, 0))
        rospy.signal_shutdown("teleop ended")


def _twist(linear, angular):
    twist = Twist()
    twist.linear.x = linear
    twist.angular.z = angular
    return twist
