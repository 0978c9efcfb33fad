#!/usr/bin/env python3
"""A robot on a base that flies, as MoveGroupCommander and RobotCommander see it: seven variables, and limits of some of them."""

import unittest

import moveit_commander
import numpy as np
import rospy
import rostest
from geometry_msgs.msg import TransformStamped
from moveit_commander import MoveGroupCommander, RobotCommander
from std_msgs.msg import Header
from tf2_ros import StaticTransformBroadcaster

PLACE = [1.0, -0.5, 0.4, 0.0, 0.0, np.sin(0.15), np.cos(0.15)]


class Floating(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.frames = StaticTransformBroadcaster()
        place = TransformStamped(header=Header(frame_id="odom", stamp=rospy.Time.now()), child_frame_id="world")
        place.transform.translation.x, place.transform.translation.y, place.transform.translation.z = PLACE[:3]
        place.transform.rotation.z, place.transform.rotation.w = PLACE[5:]
        cls.frames.sendTransform(place)
        cls.base = MoveGroupCommander("base", wait_for_servers=60.0)
        cls.robot = RobotCommander()

    def test_the_base_is_where_tf_has_it(self):
        np.testing.assert_allclose(self.base.get_current_joint_values(), PLACE, atol=1e-6)
        np.testing.assert_allclose(self.robot.get_joint("base").value(), PLACE, atol=1e-6)
        pose = self.robot.get_link("world").pose()
        self.assertEqual(pose.header.frame_id, "odom")
        self.assertAlmostEqual(pose.pose.position.z, 0.4, delta=1e-6)

    def test_limits_of_its_variables_count(self):
        """1 m up at 0.1 m/s takes 10 s; 1 m ahead at 0.2 m/s takes 5 s."""
        for axis, seconds in ((2, 10.0), (0, 5.0)):
            target = list(PLACE)
            target[axis] += 1.0
            self.base.set_joint_value_target(target)
            good, path, _, _ = self.base.plan()
            self.assertTrue(good)
            last = path.multi_dof_joint_trajectory.points[-1]
            self.assertGreaterEqual(last.time_from_start.to_sec(), seconds - 1e-3)
            self.assertAlmostEqual([last.transforms[0].translation.x, 0, last.transforms[0].translation.z][axis], target[axis], delta=2e-3)
        high = [*PLACE[:2], 2.5, *PLACE[3:]]
        self.assertRaises(moveit_commander.MoveItCommanderException, self.base.set_joint_value_target, high)


if __name__ == "__main__":
    moveit_commander.roscpp_initialize([])
    rospy.init_node("floating_rostest")
    rostest.rosrun("moveit_commander", "floating", Floating)
