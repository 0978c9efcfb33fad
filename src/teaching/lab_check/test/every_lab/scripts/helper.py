#!/usr/bin/env python3
"""A latched topic, one at 10 Hz, a service that refuses False, an action that refuses negative goals; complains when it is told to."""

import actionlib
import rospy
from actionlib.msg import TestAction, TestResult
from std_msgs.msg import Empty, Float64, String
from std_srvs.srv import SetBool, SetBoolResponse


def serve(goal):
    if goal.goal < 0:
        server.set_aborted(TestResult(0), "a goal must not be negative")
    else:
        rospy.sleep(0.3)
        server.set_succeeded(TestResult(2 * goal.goal))


rospy.init_node("helper")
rospy.Publisher("news", String, latch=True, queue_size=1).publish("here")
rospy.Subscriber("complain", Empty, lambda _: rospy.logerr("something is wrong"))
rospy.Service("allow", SetBool, lambda request: SetBoolResponse(request.data, "yes" if request.data else "no"))
server = actionlib.SimpleActionServer("double", TestAction, serve, False)
server.start()
tick = rospy.Publisher("tick", Float64, queue_size=10)
rate = rospy.Rate(10)
while not rospy.is_shutdown():
    tick.publish(rospy.get_time())
    try:
        rate.sleep()
    except rospy.ROSInterruptException:
        break
