#!/usr/bin/env python3
"""A group with two tips: a pose for each of them in one goal."""

import unittest

import moveit_commander
import numpy as np
import rospy
import rostest
from moveit_commander import MoveGroupCommander
from moveit_msgs.msg import MoveItErrorCodes, PositionIKRequest
from moveit_msgs.srv import GetPositionFK, GetPositionIK

LEFT, RIGHT = "left_hand", "right_hand"


def vector(pose):
    return np.array([pose.pose.position.x, pose.pose.position.y, pose.pose.position.z])


class TwoArms(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.both = MoveGroupCommander("both", wait_for_servers=60.0)

    def setUp(self):
        self.both.clear_pose_targets()
        self.both.set_named_target("bent")
        self.assertTrue(self.both.go())

    def moved(self, link, x=0.0, y=0.0, z=0.0):
        pose = self.both.get_current_pose(link)
        pose.pose.position.x, pose.pose.position.y, pose.pose.position.z = vector(pose) + [x, y, z]
        return pose

    def test_both_tips_reach_their_poses(self):
        wanted = {LEFT: self.moved(LEFT, -0.05, 0.1, 0.05), RIGHT: self.moved(RIGHT, -0.1, -0.05, 0.15)}
        for link, pose in wanted.items():
            self.both.set_pose_target(pose, link)
        self.assertTrue(self.both.go())
        for link, pose in wanted.items():
            there = self.both.get_current_pose(link)
            np.testing.assert_allclose(vector(there), vector(pose), atol=2e-3)
            turned = abs(
                np.dot(*([p.pose.orientation.x, p.pose.orientation.y, p.pose.orientation.z, p.pose.orientation.w] for p in (there, pose)))
            )
            self.assertGreater(turned, 0.99999)

    def test_one_tip_alone(self):
        pose = self.moved(RIGHT, -0.1, 0.0, 0.1)
        self.both.set_pose_target(pose, RIGHT)
        self.assertTrue(self.both.go())
        np.testing.assert_allclose(vector(self.both.get_current_pose(RIGHT)), vector(pose), atol=2e-3)

    def test_positions_of_both(self):
        wanted = {LEFT: vector(self.moved(LEFT, z=0.1)), RIGHT: vector(self.moved(RIGHT, y=0.1))}
        for link, position in wanted.items():
            self.both.set_position_target(list(position), link)
        self.assertTrue(self.both.go())
        for link, position in wanted.items():
            np.testing.assert_allclose(vector(self.both.get_current_pose(link)), position, atol=2e-3)

    def solve(self, **fields):
        wanted = PositionIKRequest(group_name="both", ik_link_names=[LEFT, RIGHT], timeout=rospy.Duration(1.0), **fields)
        wanted.robot_state.is_diff = True
        return rospy.ServiceProxy("compute_ik", GetPositionIK)(wanted)

    def test_compute_ik_shares_poses_out_among_the_arms(self):
        """kinematics.yaml has the arms and not the group of both: as upstream, the groups in it solve."""
        wanted = [self.moved(LEFT, -0.05, 0.05, 0.05), self.moved(RIGHT, -0.05, -0.05, 0.1)]
        answer = self.solve(pose_stamped_vector=wanted)
        self.assertEqual(answer.error_code.val, MoveItErrorCodes.SUCCESS)
        there = rospy.ServiceProxy("compute_fk", GetPositionFK)(wanted[0].header, [LEFT, RIGHT], answer.solution)
        for found, pose in zip(there.pose_stamped, wanted):
            np.testing.assert_allclose(vector(found), vector(pose), atol=1e-3)
        self.assertEqual(
            self.solve(pose_stamped_vector=[wanted[0], self.moved(RIGHT, x=5.0)]).error_code.val, MoveItErrorCodes.NO_IK_SOLUTION
        )
        self.assertEqual(self.solve(pose_stamped=wanted[0]).error_code.val, MoveItErrorCodes.NO_IK_SOLUTION)  # no solver for one alone

    def test_what_one_tip_cannot_reach_fails_the_goal(self):
        self.both.set_pose_target(self.moved(LEFT), LEFT)
        self.both.set_pose_target(self.moved(RIGHT, x=5.0), RIGHT)
        good, _, _, code = self.both.plan()
        self.assertFalse(good)
        self.assertEqual(code.val, MoveItErrorCodes.GOAL_STATE_INVALID)

    def test_a_path_keeps_away_from_the_other_arm(self):
        """Each tip goes to where the other one was; the bases are 0.8 m apart."""
        left, right = self.moved(LEFT), self.moved(RIGHT)
        left.pose.position.y, right.pose.position.y = -0.05, 0.05
        left.pose.position.x, right.pose.position.x = left.pose.position.x - 0.2, right.pose.position.x - 0.2
        left.pose.position.z += 0.2
        self.both.set_pose_target(left, LEFT)
        self.both.set_pose_target(right, RIGHT)
        self.assertTrue(self.both.go())
        np.testing.assert_allclose(vector(self.both.get_current_pose(LEFT)), vector(left), atol=2e-3)
        np.testing.assert_allclose(vector(self.both.get_current_pose(RIGHT)), vector(right), atol=2e-3)


if __name__ == "__main__":
    moveit_commander.roscpp_initialize([])
    rospy.init_node("two_arms_rostest")
    rostest.rosrun("moveit_commander", "two_arms", TwoArms)
