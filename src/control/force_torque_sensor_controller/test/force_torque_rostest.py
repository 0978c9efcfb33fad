#!/usr/bin/env python3
"""What the force-torque controller publishes."""

import unittest

import rospy
from control_test_robots import client
from geometry_msgs.msg import WrenchStamped


class ForceTorque(unittest.TestCase):
    def test_every_sensor_at_the_rate(self):
        wrist, scales = (client.Topic(name, WrenchStamped) for name in ("/wrist", "/scales"))
        with client.running("forces"):
            wrist.next()
            client.sim_sleep(2.0)
            scales.next()
        force, torque = wrist.last.wrench.force, wrist.last.wrench.torque
        self.assertEqual((force.x, force.y, force.z, torque.x, torque.y, torque.z), (1.0, 2.0, 3.0, 4.0, 5.0, 6.0))
        self.assertEqual((scales.last.wrench.force.z, scales.last.wrench.torque.z), (-9.8, 0.0))
        self.assertEqual((wrist.last.header.frame_id, scales.last.header.frame_id), ("wrist_link", "scales_link"))
        stamps = [message.header.stamp.to_sec() for message in wrist.messages]
        self.assertAlmostEqual((stamps[-1] - stamps[0]) / (len(stamps) - 1), 0.05, delta=0.002)

    def test_a_rate_is_required(self):
        self.assertFalse(client.loads("no_rate"))


if __name__ == "__main__":
    import rostest

    rospy.init_node("force_torque")
    rostest.rosrun("force_torque_sensor_controller", "force_torque", "__main__")
