#!/usr/bin/env python3
"""Clients of a move_group in a namespace."""

import unittest

import rospy
import rostest
from geometry_msgs.msg import PoseStamped
from moveit_commander import MoveGroupCommander, PlanningSceneInterface, RobotCommander


class Namespace(unittest.TestCase):
    def test_everything_is_found_below_the_namespace(self):
        arm = MoveGroupCommander("manipulator", robot_description="/left/robot_description", ns="/left", wait_for_servers=60.0)
        arm.set_named_target("left")
        self.assertTrue(arm.go(wait=True))
        self.assertAlmostEqual(arm.get_current_joint_values()[0], 1.2, delta=0.01)
        robot = RobotCommander("/left/robot_description", "/left")
        self.assertAlmostEqual(robot.joint_1.value(), 1.2, delta=0.01)
        scene = PlanningSceneInterface(ns="/left")
        pose = PoseStamped()
        pose.pose.position.x, pose.pose.orientation.w = 2.0, 1.0
        scene.add_box("box", pose)
        self.assertEqual(scene.get_known_object_names(), ["box"])

    def test_names_that_scripts_and_subclasses_use(self):
        scene = PlanningSceneInterface(ns="/left", synchronous=False)
        self.assertEqual(scene._pub_co.resolved_name, "/left/collision_object")
        self.assertEqual(scene._pub_aco.resolved_name, "/left/attached_collision_object")
        self.assertEqual(scene._apply_planning_scene_diff.resolved_name, "/left/apply_planning_scene")


if __name__ == "__main__":
    rospy.init_node("namespace_rostest")
    rostest.rosrun("moveit_commander", "namespace", Namespace)
