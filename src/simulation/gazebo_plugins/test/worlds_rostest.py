#!/usr/bin/env python3
"""The worlds of range_world.launch and elevator_world.launch, with their plugins."""

import unittest

import rospy
import rostest
from gazebo_msgs.srv import GetJointProperties, GetLinkState
from gazebo_ros.srv import StepWorld
from listening import Ear, Mouth, until
from sensor_msgs.msg import Range
from std_msgs.msg import Bool, String


class Worlds(unittest.TestCase):
    def simulator(self, namespace):
        """Its step function."""
        rospy.wait_for_message(f"{namespace}/gazebo/ready", Bool, 60)
        step = rospy.ServiceProxy(f"{namespace}/gazebo/step", StepWorld, persistent=True)
        return lambda seconds: self.assertTrue(step(round(seconds * 1000)).success)

    def test_range(self):
        step = self.simulator("/range")
        for topic, distance in (("sonar", 0.225), ("sonar2", 0.75)):
            with Ear(f"/range/{topic}", Range, "/range/gazebo") as ear:
                step(0.2)
                message = ear.wait(1)[0]
            self.assertAlmostEqual(message.range, distance, delta=0.01)
            self.assertEqual((message.header.frame_id, message.field_of_view), (topic + "_link", 0.5))

    def test_elevator(self):
        step = self.simulator("/elevator")
        joint = rospy.ServiceProxy("/elevator/gazebo/get_joint_properties", GetJointProperties)
        link = rospy.ServiceProxy("/elevator/gazebo/get_link_state", GetLinkState)

        def height():
            return link("elevator::cabin", "").link_state.pose.position.z

        step(0.1)
        self.assertAlmostEqual(height(), 0.0, places=4)
        mouth = Mouth("/elevator/elevator", String)
        mouth.say("2")
        until(lambda: (step(0.1), height())[1] > 0.01, "departure")
        step(8.0)
        self.assertAlmostEqual(height(), 6.0, places=3)
        self.assertAlmostEqual(joint("elevator::door").position[0], 1.0, places=3)  # open
        step(11.0)
        self.assertAlmostEqual(joint("elevator::door").position[0], 0.0, places=3)
        mouth.say("1")
        until(lambda: (step(0.1), height())[1] < 5.99, "way down")
        step(5.0)
        self.assertAlmostEqual(height(), 3.0, places=3)


if __name__ == "__main__":
    rospy.init_node("worlds_test", disable_rostime=True)
    rostest.rosrun("gazebo_plugins", "worlds", Worlds)
