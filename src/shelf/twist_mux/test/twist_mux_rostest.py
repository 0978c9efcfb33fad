#!/usr/bin/env python3
"""twist_mux.launch on the wire: two sources, a lock, the joystick's relay."""

import queue
import unittest

import actionlib
import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Twist
from std_msgs.msg import Bool
from twist_mux_msgs.msg import JoyPriorityAction, JoyPriorityGoal, JoyTurboAction, JoyTurboGoal
from visualization_msgs.msg import Marker


def forward(speed):
    twist = Twist()
    twist.linear.x = speed
    return twist


class TwistMux(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.driven, cls.status = queue.Queue(), queue.Queue()
        rospy.Subscriber("cmd_vel", Twist, cls.driven.put)
        rospy.Subscriber("/diagnostics", DiagnosticArray, cls.status.put)
        cls.publishers = {
            name: rospy.Publisher(name, kind, queue_size=10, latch=kind is Bool)
            for name, kind in (("nav_vel", Twist), ("input_joy/cmd_vel", Twist), ("stop", Bool))
        }
        while any(publisher.get_num_connections() == 0 for publisher in cls.publishers.values()):
            rospy.rostime.wallsleep(0.02)
        rospy.wait_for_message("text_marker", Marker, 60)

    def send_until(self, name, message, speed):
        """Sends again until the robot is told the speed; the topics share no order."""
        for _ in range(600):
            self.publishers[name].publish(message)
            try:
                if abs(self.driven.get(timeout=0.1).linear.x - speed) < 1e-9:
                    return
            except queue.Empty:
                pass
        self.fail(f"the robot was never told to drive at {speed} m/s")

    def report(self, key, wanted):
        while True:
            for status in self.status.get(timeout=60).status:
                values = {pair.key: pair.value for pair in status.values}
                if status.name == "twist_mux: Twist mux status" and wanted in values.get(key, ""):
                    return values

    def test_priorities_lock_and_joystick(self):
        self.send_until("nav_vel", forward(0.25), 0.25)
        self.send_until("input_joy/cmd_vel", forward(1.0), 0.5 + 0.5 / 3)  # the second of four steps
        values = self.report("velocity joystick", " unmasked (listening to joy_vel @ 2.000000s with priority #100)")
        self.assertEqual(values["velocity navigation"], " unmasked (listening to nav_vel @ 0.000000s with priority #10)")

        turbo = actionlib.SimpleActionClient("joy_turbo_increase", JoyTurboAction)
        self.assertTrue(turbo.wait_for_server(rospy.Duration(60)))
        turbo.send_goal_and_wait(JoyTurboGoal(), rospy.Duration(60))
        self.send_until("input_joy/cmd_vel", forward(-1.0), -(0.25 + 2 * 0.25 / 3))

        self.publishers["stop"].publish(True)
        values = self.report("lock stop", " locked (listening to stop")
        self.assertEqual(values["current priority"], "255")
        self.assertIn(" masked", values["velocity navigation"])
        while not self.driven.empty():
            self.driven.get()
        for _ in range(20):
            self.publishers["nav_vel"].publish(forward(0.25))
        self.report("current priority", "255")
        self.report("current priority", "255")
        self.assertTrue(self.driven.empty(), "nothing passes a closed lock")

        self.publishers["stop"].publish(False)
        self.send_until("nav_vel", forward(0.125), 0.125)

        toggle = actionlib.SimpleActionClient("joy_priority_action", JoyPriorityAction)
        self.assertTrue(toggle.wait_for_server(rospy.Duration(60)))
        toggle.send_goal_and_wait(JoyPriorityGoal(), rospy.Duration(60))
        self.assertFalse(rospy.wait_for_message("joy_priority", Bool, 60).data)
        self.assertEqual(rospy.wait_for_message("text_marker", Marker, 60).text, "Autonomous")


if __name__ == "__main__":
    rospy.init_node("twist_mux_rostest")
    rostest.rosrun("twist_mux", "twist_mux_rostest", TwistMux)
