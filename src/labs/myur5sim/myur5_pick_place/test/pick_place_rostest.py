#!/usr/bin/env python3
"""The gripper picks the block up and puts it down elsewhere: in the simulator, not only in the planning scene."""

import sys
import unittest

import actionlib
import moveit_commander
import numpy as np
import rospy
import rostest
from controller_manager_tests.client import ManagerClient
from dynamic_reconfigure.client import Client
from moveit_msgs.msg import MoveItErrorCodes
from moveit_msgs.srv import GraspPlanning, GraspPlanningRequest
from myur5_pick_place import table
from object_recognition_msgs.msg import ObjectRecognitionAction, ObjectRecognitionGoal
from test_support.waiting import wait_until

THERE = (0.5, 0.3, 0.9605)  # m, a hair above the table


class PickPlace(unittest.TestCase):
    def recognize(self):
        """As RViz's Detect does."""
        client = actionlib.SimpleActionClient("recognize_objects", ObjectRecognitionAction)
        self.assertTrue(client.wait_for_server(rospy.Duration(30)))
        client.send_goal(ObjectRecognitionGoal())  # its own wait misses a result that comes before send_goal() returns
        wait_until(lambda: client.get_state() == actionlib.GoalStatus.SUCCEEDED, "what is recognized")

    def planned(self, scene, name):
        """As RViz's Pick does."""
        rospy.wait_for_service("plan_grasps", 30)
        target = scene.get_objects([name])[name]
        return rospy.ServiceProxy("plan_grasps", GraspPlanning)(GraspPlanningRequest(group_name="manipulator", target=target))

    def test_the_block_is_carried_round_the_post(self):
        Client("/gazebo", timeout=30).update_configuration({"max_update_rate": 4000.0})  # four times real time
        scene = moveit_commander.PlanningSceneInterface()
        arm = moveit_commander.MoveGroupCommander("manipulator", wait_for_servers=60.0)
        ManagerClient().wait_until_running("arm_controller")
        arm.set_max_velocity_scaling_factor(1.0)
        arm.set_planning_time(20.0)
        self.recognize()
        self.assertEqual(set(scene.get_known_object_names()), set(table.SIZES))
        arm.set_support_surface_name("table")
        start, post = table.position(table.model_pose("block")), table.position(table.model_pose("post"))
        np.testing.assert_allclose(start, (0.5, -0.3, 0.96), atol=2e-3)

        self.assertEqual(self.planned(scene, "table").error_code.val, MoveItErrorCodes.FAILURE, "too wide for the gripper")
        self.assertEqual(arm.pick("block", self.planned(scene, "block").grasps), MoveItErrorCodes.SUCCESS)
        self.assertIn("block", scene.get_attached_objects())
        self.recognize()
        self.assertNotIn("block", scene.get_known_object_names(), "in the hand, and not in the world beside it")
        lifted = table.position(table.model_pose("block"))
        self.assertGreater(lifted[2], start[2] + 0.08, "the block was not lifted")
        np.testing.assert_allclose(lifted[:2], start[:2], atol=0.01)
        hand = arm.get_current_pose().pose
        self.assertAlmostEqual(hand.position.z - lifted[2], 0.02 + table.REACH, delta=0.005)

        self.assertTrue(arm.place("block", table.places(*THERE)))
        self.assertFalse(scene.get_attached_objects())
        put = table.position(table.model_pose("block"))
        np.testing.assert_allclose(put, (*THERE[:2], 0.96), atol=5e-3)
        known = scene.get_object_poses(["block"])["block"].position
        np.testing.assert_allclose((known.x, known.y, known.z), put, atol=5e-3)
        np.testing.assert_allclose(table.position(table.model_pose("post")), post, atol=1e-6)
        arm.set_named_target("HomePose")
        self.assertTrue(arm.go(wait=True))
        np.testing.assert_allclose(table.position(table.model_pose("block")), put, atol=1e-3)


if __name__ == "__main__":
    moveit_commander.roscpp_initialize(sys.argv)
    rospy.init_node("pick_place_rostest")
    rostest.rosrun("myur5_pick_place", "pick_place", PickPlace)
