#!/usr/bin/env python3
"""The simulated depth camera sees table, post and block; motions go round what nobody put into the planning scene."""

import sys
import time
import unittest

import moveit_commander
import numpy as np
import rospy
import rostest
from controller_manager_tests.client import ManagerClient
from gazebo_msgs.msg import ModelState
from gazebo_msgs.srv import SetModelState
from geometry_msgs.msg import Pose
from moveit_msgs.msg import PlanningSceneComponents
from moveit_msgs.srv import GetPlanningScene, GetStateValidity, GetStateValidityRequest
from myur5_pick_place import table

PATIENCE = 60.0  # wall s


def octomap():
    """The octomap of the planning scene, as a message."""
    wanted = PlanningSceneComponents(components=PlanningSceneComponents.OCTOMAP)
    return rospy.ServiceProxy("get_planning_scene", GetPlanningScene)(wanted).scene.world.octomap.octomap


class SeenByTheCamera(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.arm = moveit_commander.MoveGroupCommander("manipulator", wait_for_servers=60.0)
        ManagerClient().wait_until_running("arm_controller")
        cls.arm.set_max_velocity_scaling_factor(0.5)
        cls.arm.set_planning_time(10.0)
        end = time.monotonic() + PATIENCE
        while len(octomap().data) < 200 and time.monotonic() < end:
            time.sleep(0.2)

    def go(self, y):
        """The gripper 0.15 m above the table at y, pointing down."""
        self.arm.set_named_target("HomePose")
        pose = Pose(orientation=self.arm.get_current_pose().pose.orientation)
        pose.position.x, pose.position.y, pose.position.z = 0.55, y, 1.2
        self.arm.set_pose_target(pose)
        good = self.arm.go(wait=True)
        self.arm.clear_pose_targets()
        return good

    def test_the_robot_is_no_obstacle_and_the_post_is_gone_round(self):
        self.assertGreater(len(octomap().data), 200, "the octomap stays empty")
        self.assertAlmostEqual(octomap().resolution, 0.025)
        self.assertTrue(rospy.ServiceProxy("check_state_validity", GetStateValidity)(GetStateValidityRequest()).valid)
        post = table.position(table.model_pose("post"))
        for y in (-0.3, 0.3, -0.3):
            self.assertTrue(self.go(y), f"no way to y = {y}")
            np.testing.assert_allclose(self.arm.get_current_pose().pose.position.y, y, atol=0.005)
        np.testing.assert_allclose(table.position(table.model_pose("post")), post, atol=1e-6)

    def test_what_comes_in_the_way_of_a_motion_ends_it(self):
        self.assertTrue(self.go(-0.3))
        home = self.arm.get_named_target_values("HomePose")
        goal = self.arm.get_current_joint_values()
        goal[0] = home["shoulder_pan_joint"] - 2.4
        self.arm.set_max_velocity_scaling_factor(0.05)
        self.arm.set_joint_value_target(goal)
        self.assertTrue(self.arm.go(wait=False))
        start = self.arm.get_current_joint_values()[0]
        end = time.monotonic() + PATIENCE
        while abs(self.arm.get_current_joint_values()[0] - start) < 0.02:
            self.assertLess(time.monotonic(), end, "the arm does not move")
        # the post jumps in front of the hand, where only the camera can see it
        hand = self.arm.get_current_pose().pose.position
        angle = np.arctan2(hand.y, hand.x) - 0.55
        state = ModelState(model_name="post", reference_frame="world")
        state.pose.orientation.w = 1.0
        state.pose.position.x, state.pose.position.y, state.pose.position.z = 0.62 * np.cos(angle), 0.62 * np.sin(angle), 1.2
        rospy.ServiceProxy("/gazebo/set_model_state", SetModelState)(state)
        while self.arm.get_current_joint_values()[0] > goal[0] + 0.05:
            self.assertLess(time.monotonic(), end, "the motion neither ended nor arrived")
            before = self.arm.get_current_joint_values()[0]
            time.sleep(1.0)
            if abs(self.arm.get_current_joint_values()[0] - before) < 1e-4:
                break
        self.arm.set_max_velocity_scaling_factor(0.5)
        self.assertGreater(self.arm.get_current_joint_values()[0], goal[0] + 0.5, "the arm went on")


if __name__ == "__main__":
    moveit_commander.roscpp_initialize(sys.argv)
    rospy.init_node("octomap_rostest")
    rostest.rosrun("myur5_pick_place", "octomap", SeenByTheCamera)
