#!/usr/bin/env python3
"""w drives on, s stops, q ends."""

import sys
import termios
import tty

import rospy
from geometry_msgs.msg import Twist

rospy.init_node("keys")
drive = rospy.Publisher("cmd_vel", Twist, queue_size=10)
tty.setcbreak(sys.stdin.fileno())
assert termios.tcgetattr(sys.stdin.fileno())
for key in iter(lambda: sys.stdin.read(1), ""):
    if key == "q":
        print("bye")
        break
    twist = Twist()
    twist.linear.x = 0.2 if key == "w" else 0.0
    drive.publish(twist)
