#!/usr/bin/env python3
"""Rangers over a board of this test: its service for pins, and what the pins read."""

import subprocess
import unittest

import rospy
import rostest
from arbotix_msgs.msg import Analog
from arbotix_msgs.srv import SetupChannel, SetupChannelResponse
from sensor_msgs.msg import Range


class RangersTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.asked = {}

        def take(request):
            cls.asked[request.topic_name] = (request.pin, request.rate)
            return SetupChannelResponse()

        cls.service = rospy.Service("arbotix/SetupAnalogIn", SetupChannel, take)

    def measured(self, channel, topic, value):
        publisher = rospy.Publisher(f"arbotix/{channel}", Analog, queue_size=1)
        end = rospy.get_time() + 20
        while not publisher.get_num_connections():
            self.assertLess(rospy.get_time(), end, "nobody asks for the pin")
            rospy.sleep(0.01)
        timer = rospy.Timer(rospy.Duration(0.05), lambda _event: publisher.publish(Analog(value=value)))
        message = rospy.wait_for_message(topic, Range, 20)
        timer.shutdown()
        return message

    def test_infrared(self):
        message = self.measured("front", "ir_range", 16)  # 8 of the 10 bits: 64
        self.assertEqual(self.asked["front"], (3, 20))
        self.assertAlmostEqual(message.range, 1.0, places=6)
        self.assertEqual((message.radiation_type, round(message.min_range, 6), round(message.max_range, 6)), (Range.INFRARED, 0.1, 0.8))

    def test_sonar(self):
        message = self.measured("back", "sonar_range", 128)
        self.assertEqual(self.asked["back"], (5, 10))
        self.assertAlmostEqual(message.range, 6.35, places=5)
        self.assertEqual(message.radiation_type, Range.ULTRASOUND)

    def test_a_wrong_parameter_is_one_line(self):
        for parameters, said in (
            ([], "parameter /bad/name is not set"),
            (["_name:=x", "_pin:=-1"], "parameter /bad/pin must be a whole number from 0 to 255, it is -1"),
        ):
            command = ["rosrun", "arbotix_sensors", "ir_ranger.py", "__name:=bad", *parameters]
            ended = subprocess.run(command, capture_output=True, text=True, timeout=30)
            self.assertEqual(ended.returncode, 1, said)
            self.assertIn(said, ended.stderr)


if __name__ == "__main__":
    rospy.init_node("rangers_rostest")
    rostest.rosrun("arbotix_sensors", "rangers", RangersTest)
