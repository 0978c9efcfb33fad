#!/usr/bin/env python3
"""parameter_bridge, static_bridge and --print-pairs as ROS 2's documentation shows them; skipped where ROS 2 is not installed."""

import signal
import subprocess
import unittest

import rospy
import rostest
from ros1_bridge.link import HINT, prefix
from ros2_side import PATIENCE, Other, wait
from std_msgs.msg import Float64, String
from std_srvs.srv import SetBool, SetBoolResponse
from test_support import never

TWO = "00010000 04000000 74776f00".replace(" ", "")  # a std_msgs/msg/String of "two" in CDR


@unittest.skipIf(prefix() is None, HINT)
class Programs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.other = Other()

    @classmethod
    def tearDownClass(cls):
        cls.other.process.kill()

    def start(self, *words):
        process = subprocess.Popen(
            ["rosrun", "ros1_bridge", *words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, start_new_session=True
        )

        def end():
            process.send_signal(signal.SIGINT)
            output, _ = process.communicate(timeout=30)
            self.assertNotIn("Traceback", output)

        self.addCleanup(end)

    def set(self, **parameters):
        for name, value in parameters.items():
            rospy.set_param(name, value)
            self.addCleanup(rospy.delete_param, name)

    def assert_passes(self, topic):
        """A text each way."""
        publisher, came = rospy.Publisher(topic, String, queue_size=1), []
        subscriber = rospy.Subscriber(topic, String, lambda message: came.append(message.data))
        self.addCleanup(publisher.unregister)
        self.addCleanup(subscriber.unregister)
        self.other.do("hear", topic=topic, kind="String")
        self.other.do("advertise", topic=topic, kind="String")
        one = bytes.fromhex("00010000 04000000 6f6e6500")
        wait(lambda: publisher.publish("one") or one in [data[: len(one)] for data in self.other.heard(topic)], f"{topic} in ROS 2")
        wait(lambda: self.other.do("publish", topic=topic, data=TWO) or "two" in came, f"{topic} in ROS 1")

    def assert_serves_ros1(self, name):
        """A service of ROS 1, called in ROS 2."""
        service = rospy.Service(name, SetBool, lambda request: SetBoolResponse(request.data, "of ROS 1"))
        self.addCleanup(service.shutdown)
        self.other.do("call", name=name, value=True)
        self.assertEqual(self.other.answer(called=name), {"called": name, "success": True, "message": "of ROS 1"})

    def test_what_parameters_name_is_bridged_and_nothing_else(self):
        self.set(
            topics=[
                {"topic": "/chatter", "type": "std_msgs/msg/String", "queue_size": 1},
                {"topic": "/kept", "type": "std_msgs/msg/String", "queue_size": 1, "qos": {"durability": "transient_local", "depth": 1}},
            ],
            services_2_to_1=[{"service": "/of_ros1", "type": "std_srvs/SetBool"}],  # called from ROS 2; a type of ROS 1
            services_1_to_2=[{"service": "/of_ros2", "type": "std_srvs/srv/SetBool"}],  # called from ROS 1; a type of ROS 2
        )
        self.start("parameter_bridge")
        self.assert_passes("/chatter")
        self.assert_serves_ros1("/of_ros1")
        self.other.do("serve", name="/of_ros2")
        rospy.wait_for_service("/of_ros2", PATIENCE)
        answer = rospy.ServiceProxy("/of_ros2", SetBool)(False)
        self.assertEqual((answer.success, answer.message), (True, "of ROS 2"))

        kept = rospy.Publisher("/kept", String, queue_size=1, latch=True)
        kept.publish("one")
        self.other.do("hear", topic="/kept", kind="String", profile="latched")
        wait(lambda: self.other.heard("/kept"), "what is latched")
        another = rospy.Publisher("/another", Float64, queue_size=1, latch=True)
        another.publish(1.0)
        self.other.do("hear", topic="/another", kind="Float64")
        never(lambda: self.other.heard("/another"), "a topic that is not named", 2.0)

    def test_the_parameters_may_have_other_names(self):
        self.set(mine=[{"topic": "/by_option", "type": "std_msgs/msg/String", "queue_size": 1}])
        self.set(calls=[{"service": "/by_option_too", "package": "std_srvs", "type": "SetBool"}])  # as it was once written
        self.start("parameter_bridge", "--topics", "mine", "--services-2-to-1", "calls")
        self.assert_passes("/by_option")
        self.assert_serves_ros1("/by_option_too")

    def test_the_static_bridge_has_chatter(self):
        self.start("static_bridge")
        self.assert_passes("/chatter")

    def test_the_pairs_are_printed(self):
        done = subprocess.run(["rosrun", "ros1_bridge", "dynamic_bridge", "--print-pairs"], capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        messages, _, services = done.stdout.partition("Supported ROS 2 <=> ROS 1 service type conversion pairs:\n")
        self.assertTrue(messages.startswith("Supported ROS 2 <=> ROS 1 message type conversion pairs:\n"), messages[:200])
        for two, one in (
            ("std_msgs/msg/String", "std_msgs/String"),
            ("builtin_interfaces/msg/Time", "std_msgs/Time"),
            ("builtin_interfaces/msg/Duration", "std_msgs/Duration"),
            ("rcl_interfaces/msg/Log", "rosgraph_msgs/Log"),
            ("sensor_msgs/msg/JointState", "sensor_msgs/JointState"),
            ("tf2_msgs/msg/TFMessage", "tf2_msgs/TFMessage"),
        ):
            self.assertIn(f"  - '{two}' (ROS 2) <=> '{one}' (ROS 1)\n", messages)
        self.assertIn("  - 'std_srvs/srv/SetBool' (ROS 2) <=> 'std_srvs/SetBool' (ROS 1)\n", services)
        self.assertNotIn("gazebo_msgs", done.stdout)


if __name__ == "__main__":
    rospy.init_node("programs_rostest")
    rostest.rosrun("ros1_bridge", "programs", Programs)
