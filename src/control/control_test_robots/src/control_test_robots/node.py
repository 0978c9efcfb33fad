"""Clock, controller manager and control loop around a TestRobot."""
from __future__ import annotations

import time as wall

import rospy
from controller_manager import ControllerManager
from rosgraph_msgs.msg import Clock
from std_srvs.srv import Empty, EmptyResponse

from .robot import TestRobot


def run() -> None:
    """Run until the node is shut down. Publishes /clock, which must be the only one."""
    robot = TestRobot(rospy.get_param("~", {}))
    dt = 1.0 / rospy.get_param("~rate", 100.0)
    speed = rospy.get_param("~speed", 10.0)

    def apply_faults(_request):
        robot.set_faults(rospy.get_param("~faults", {}))
        return EmptyResponse()

    rospy.Service("~apply_faults", Empty, apply_faults)
    clock = rospy.Publisher("/clock", Clock, queue_size=1)
    manager = ControllerManager(robot, "")
    cycle = 0
    due = wall.monotonic()
    while not rospy.is_shutdown():
        cycle += 1
        time = cycle * dt
        clock.publish(Clock(rospy.Time.from_sec(time)))
        robot.read(time, dt)
        manager.update(time, dt)
        robot.write(time, dt)
        if speed > 0.0:
            due = max(due + dt / speed, wall.monotonic() - 0.1)
            wall.sleep(max(0.0, due - wall.monotonic()))
