"""Clock, controller manager and control loop around a TestRobot."""

from __future__ import annotations

import threading
import time as wall

import rospy
from controller_manager import ControllerManager
from realtime_tools import make_prompt
from rosgraph_msgs.msg import Clock
from std_srvs.srv import Empty, EmptyResponse, Trigger, TriggerResponse

from .robot import TestRobot

#: Cycles that one call of ~advance makes.
ADVANCE = 2


class TestRobotNode:
    """Publishes /clock, which must be the only one.

    Time goes on by itself at parameter ``speed``, and by ADVANCE cycles with every call of the service ``~advance``: a
    test that waits for something calls it over and over, so that simulated time runs as fast as the machine can, but
    never ahead of the test, however busy the machine is.
    """

    __test__ = False  # not a test case, whatever pytest thinks of the name

    def __init__(self) -> None:
        self._robot = TestRobot(rospy.get_param("~", {}))
        self._dt = 1.0 / rospy.get_param("~rate", 100.0)
        self._pause = self._dt / rospy.get_param("~speed", 1.0)
        self._granted = 0
        self._resetting = False
        self._changed = threading.Condition()
        self._cycle = 0
        self._clock = make_prompt(rospy.Publisher("/clock", Clock, queue_size=10), 10)
        self._manager = ControllerManager(self._robot, "")
        rospy.Service("~apply_faults", Empty, self._apply_faults)
        rospy.Service("~advance", Trigger, self._advance)
        rospy.Service("~reset", Empty, self._reset)

    def run(self) -> None:
        """Make cycles until the node is shut down."""
        while not rospy.is_shutdown():
            with self._changed:
                self._changed.wait_for(lambda: self._granted > 0 or self._resetting, self._pause)
                if self._resetting:  # between two cycles: no controller sees half of it
                    self._begin_anew()
            self._make_cycle()
            with self._changed:
                self._granted = max(0, self._granted - 1)
                self._changed.notify_all()
            wall.sleep(0.0002)  # threads that receive messages get their turn
        self._manager.shutdown()

    def _make_cycle(self) -> None:
        self._cycle += 1
        time = self._cycle * self._dt
        self._clock.publish(Clock(rospy.Time.from_sec(time)))
        self._robot.read(time, self._dt)
        self._manager.update(time, self._dt)
        self._robot.write(time, self._dt)

    def _advance(self, _request) -> TriggerResponse:
        """Answers the time, in s: a client's own clock and topics may lag behind it."""
        with self._changed:
            self._granted += ADVANCE
            self._changed.notify_all()
            self._changed.wait_for(lambda: self._granted == 0 or rospy.is_shutdown(), 5.0)
        return TriggerResponse(True, repr(self._cycle * self._dt))

    def _reset(self, _request) -> EmptyResponse:
        """As when a simulation is reset: time begins anew, the joints are where they began."""
        with self._changed:
            self._resetting = True
            self._changed.notify_all()
            self._changed.wait_for(lambda: not self._resetting or rospy.is_shutdown(), 5.0)
        return EmptyResponse()

    def _begin_anew(self) -> None:
        self._cycle = 0
        for joint in self._robot.joints.values():
            joint.reset()
        self._resetting = False
        self._changed.notify_all()

    def _apply_faults(self, _request) -> EmptyResponse:
        self._robot.set_faults(rospy.get_param("~faults", {}))
        return EmptyResponse()
