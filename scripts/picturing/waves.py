"""Moves the four joints of the arm lab by sines, each a quarter of a period after the one before, until Ctrl-C."""

import math

import rospy
from std_msgs.msg import Float64

PERIOD, WIDTH = 8.0, 0.12  # s of simulated time, rad: just within the joints' 0.1 rad/s

rospy.init_node("waves")
publishers = [rospy.Publisher(f"/arm/joint{joint}_position_controller/command", Float64, queue_size=1) for joint in range(4)]
rate = rospy.Rate(100)  # as often as the simulator steps: each command is reached in the next step
while not rospy.is_shutdown():
    turn = 2 * math.pi * rospy.get_time() / PERIOD
    for joint, publisher in enumerate(publishers):
        publisher.publish(WIDTH * math.sin(turn - joint * math.pi / 2))
    try:
        rate.sleep()
    except rospy.ROSInterruptException:
        break
