#!/usr/bin/env python3
"""The names that programs of others import, beside a driver's parameters. Angles are worked out here from degrees and ticks."""

import math
import types
import unittest

import rospy
import rostest
from arbotix_msgs.msg import Analog, Digital
from arbotix_python.controllers import Controller
from arbotix_python.io import AnalogSensor, DigitalSensor, DigitalServo
from arbotix_python.joints import *  # noqa: F403 - as programs of others do
from arbotix_python.publishers import DiagnosticsPublisher, JointStatePublisher
from arbotix_python.servo_controller import DynamixelServo, HobbyServo
from diagnostic_msgs.msg import DiagnosticArray
from sensor_msgs.msg import JointState
from test_support import wait_until

URDF = """<robot name="arm"><link name="a"/><transmission name="t"><joint name="other" type="revolute"/></transmission>
<joint name="pan" type="revolute"><limit lower="-1" upper="2" effort="1" velocity="1"/></joint>
<joint name="lift" type="prismatic"><limit lower="0.2" upper="0.6" effort="1" velocity="1"/></joint>
<joint name="upper" type="revolute"><limit upper="1.5" effort="1" velocity="1"/></joint>
<joint name="wheel" type="continuous"/><joint name="plate" type="fixed"/><joint name="broken" type="revolute"/>
<joint name="words" type="revolute"><limit lower="low" upper="high"/></joint></robot>"""


class Board:
    """Pins, without a board."""

    fake = True

    def __init__(self):
        self.written = []

    def setDigital(self, *values):
        self.written.append(values)

    def getDigital(self, pin):
        return 255 if pin == 3 else -1

    def getAnalog(self, pin, length=1):
        return 100 * length


class Names(unittest.TestCase):
    def setUp(self):
        rospy.set_param("/robot_description", URDF)

    def hear(self, topic, kind):
        messages = []
        subscriber = rospy.Subscriber(topic, kind, messages.append)
        self.addCleanup(subscriber.unregister)
        return messages

    def test_joints_of_the_description(self):
        found = getJointsFromURDF()  # noqa: F405
        self.assertEqual(sorted(found), ["lift", "pan", "upper", "wheel"])
        self.assertEqual(found["pan"], {"min": -1.0, "max": 2.0, "zero": 0, "value": 0})
        self.assertAlmostEqual(found["lift"]["zero"], 0.4)
        self.assertEqual((found["upper"]["min"], found["upper"]["max"]), (0.0, 1.5))
        self.assertEqual((found["wheel"]["min"], found["wheel"]["max"]), (-math.pi, math.pi))

    def test_no_description(self):
        for text in (None, "<robot", 5):
            rospy.set_param("/robot_description", text) if text else rospy.delete_param("/robot_description")
            self.assertEqual(getJointsFromURDF(), {})  # noqa: F405

    def test_limits_are_of_parameters_then_the_description_then_defaults(self):
        known = getJointsFromURDF()  # noqa: F405
        for name, wanted in (
            ("nobody", (math.radians(-150), math.radians(150))),
            ("pan", (-1.0, 2.0)),
            ("old", (math.radians(-10), math.radians(20))),
            ("both", (math.radians(-40), math.radians(20))),
            ("lift", (0.25, 0.6)),
            ("bad", (math.radians(-150), math.radians(150))),
        ):
            got = getJointLimits(name, known)  # noqa: F405
            for value, number in zip(got, wanted):
                self.assertAlmostEqual(value, number, msg=name)
        self.assertEqual(getJointLimits("nobody", {}, 0, 180), (0.0, math.pi))  # noqa: F405

    def test_servos_answer_to_their_names(self):
        servo = DynamixelServo(Board(), "bus")
        self.assertIsInstance(servo, Joint)  # noqa: F405
        tick = math.radians(300) / 1024
        self.assertEqual(servo.setControlOutput(100 * tick), 612)
        self.assertAlmostEqual(servo.ticksToAngle(servo.angleToTicks(-100 * tick)), -100 * tick)
        self.assertIsNone(servo.interpolate(10.0))  # moves, without a board
        self.assertAlmostEqual(servo.position, 100 * tick, delta=tick / 2)
        servo.setCurrentFeedback(412)
        self.assertAlmostEqual(servo.position, -100 * tick)
        self.assertEqual((servo.getDiagnostics().name, servo.getDiagnostics().message), ("bus", "OK"))
        servo.enable(types.SimpleNamespace(enable=False))
        self.assertEqual(servo.setControlOutput(0.5), -1)
        self.assertEqual(HobbyServo(Board(), "pulse").setControlOutput(0.0), 1500)

    def test_what_is_published(self):
        joint = Joint(None, "elbow")  # noqa: F405
        joint.position, joint.velocity = 0.5, -0.25
        wheels = Controller(Board(), "base")
        wheels.joint_names, wheels.joint_positions, wheels.joint_velocities = ["left"], [7.0], [1.0]
        states, reports = self.hear("joint_states", JointState), self.hear("diagnostics", DiagnosticArray)
        publishers = JointStatePublisher(), DiagnosticsPublisher()

        def came():
            for publisher in publishers:
                publisher.update([joint], [wheels])
            return states and reports

        wait_until(came)
        self.assertEqual(
            (states[0].name, list(states[0].position), list(states[0].velocity)), (["elbow", "left"], [0.5, 7.0], [-0.25, 1.0])
        )
        self.assertEqual([each.name for each in reports[0].status], ["base"])

    def test_pins(self):
        board = Board()
        digital, analog = self.hear("~button", Digital), self.hear("~light", Analog)
        pins = [
            DigitalSensor("button", 3, 0, 100, board),
            AnalogSensor("light", 1, 0, 100, 2, board),
            DigitalServo("lamp", 5, 1, 100, board),
        ]
        self.assertEqual(board.written, [(3, 0, 0), (1, 0, 0), (5, 1, 0)])
        lamp = rospy.Publisher("~lamp", Digital, queue_size=1, latch=True)
        self.addCleanup(lamp.unregister)
        lamp.publish(Digital(value=0, direction=255))

        def done():
            for pin in pins:
                pin.update()
            return digital and analog and (5, 0, 255) in board.written

        wait_until(done)
        self.assertEqual((digital[0].value, analog[0].value), (255, 200))


if __name__ == "__main__":
    rospy.init_node("names_rostest")
    rostest.rosrun("arbotix_python", "names", Names)
