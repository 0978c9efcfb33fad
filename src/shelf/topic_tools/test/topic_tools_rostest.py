#!/usr/bin/env python3
"""The nodes of topic_tools on the wire, each started as launch files do."""

import queue
import subprocess
import unittest

import rospy
import rostest
from geometry_msgs.msg import Pose, Twist
from std_msgs.msg import Float64, String
from topic_tools.srv import DemuxSelect, MuxAdd, MuxList, MuxSelect


def publisher(topic, kind):
    made = rospy.Publisher(topic, kind, queue_size=50)
    while not made.get_num_connections():
        rospy.rostime.wallsleep(0.02)
    return made


def type_in(*words):
    typed = ["rosrun", "topic_tools", *words]
    return subprocess.run(typed, check=True, capture_output=True, text=True, timeout=30).stdout


class Ear(queue.Queue):
    def __init__(self, topic, kind):
        super().__init__()
        self._subscriber = rospy.Subscriber(topic, kind, self.put)

    def after(self, send, wanted):
        """Sends again, as connections come up in any order, until something heard is ``wanted``."""
        for _ in range(300):
            send()
            try:
                while True:
                    message = self.get(timeout=0.1)
                    if wanted(message):
                        return message
            except queue.Empty:
                pass
        raise AssertionError("never heard")


class TopicTools(unittest.TestCase):
    def test_transform_and_relay_field(self):
        place = rospy.Publisher("place", Pose, queue_size=5)
        distance, twist = Ear("distance", Float64), Ear("twist", Twist)
        pose = Pose()
        pose.position.x, pose.position.y = 3.0, 4.0
        distance.after(lambda: place.publish(pose), lambda m: m.data == 5.0)
        made = twist.after(lambda: place.publish(pose), lambda m: True)
        self.assertEqual((made.linear.x, made.linear.y, made.linear.z, made.angular.z), (3.0, 0.0, 0.5, 4.0))

    def test_mux(self):
        left, right, chosen = publisher("left", String), publisher("right", String), Ear("chosen", String)

        def send():
            left.publish("l")
            right.publish("r")

        chosen.after(send, lambda m: m.data == "l")
        rospy.wait_for_service("mux/select", 30)
        self.assertEqual(rospy.ServiceProxy("mux/select", MuxSelect)("right").prev_topic, rospy.resolve_name("left"))
        chosen.after(send, lambda m: m.data == "r")
        rospy.ServiceProxy("mux/add", MuxAdd)("third")
        said = type_in("mux_list", "mux")
        listed = rospy.ServiceProxy("mux/list", MuxList)().topics
        self.assertIn(rospy.resolve_name("third"), listed)
        self.assertIn("third", said)
        type_in("mux_select", "mux", "left")
        chosen.after(send, lambda m: m.data == "l")

    def test_demux(self):
        one_way, near, far = publisher("one_way", String), Ear("near", String), Ear("far", String)
        near.after(lambda: one_way.publish("n"), lambda m: m.data == "n")
        rospy.wait_for_service("demux/select", 30)
        rospy.ServiceProxy("demux/select", DemuxSelect)("far")
        far.after(lambda: one_way.publish("f"), lambda m: m.data == "f")

    def test_relay_throttle_drop(self):
        odd_one = publisher("odd_one", String)
        passed, rare, halved = Ear("passed_on", String), Ear("rare", String), Ear("halved", String)
        for ear in (passed, rare, halved):
            ear.after(lambda: odd_one.publish("go"), lambda m: True)
        for number in range(20):  # one by one: the queues behind them are short
            odd_one.publish(str(number))
            while passed.get(timeout=10).data != str(number):
                pass

        def numbers(ear):
            """What came of them, before the end."""
            found = []
            ear.after(lambda: odd_one.publish("end"), lambda m: found.append(m.data) or m.data == "end")
            return [int(word) for word in found if word.isdigit()]

        self.assertEqual(len(numbers(halved)), 10)
        self.assertLess(len(numbers(rare)), 4)


if __name__ == "__main__":
    rospy.init_node("topic_tools_rostest")
    rostest.rosrun("topic_tools", "topic_tools", TopicTools)
