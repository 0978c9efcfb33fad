#!/usr/bin/env python3
"""The UR5 on its pedestal plans and moves in simulation, as the course types it."""

import sys
import threading
import unittest

import moveit_commander
import numpy as np
import rospy
import rostest
from control_msgs.msg import FollowJointTrajectoryActionGoal
from controller_manager_tests.client import ManagerClient
from geometry_msgs.msg import Pose
from moveit_msgs.msg import MoveItErrorCodes
from test_support.waiting import wait_until

JOINTS = ["shoulder_pan_joint", "shoulder_lift_joint", "elbow_joint", "wrist_1_joint", "wrist_2_joint", "wrist_3_joint"]
CLOSE = 0.01  # rad between where the arm was sent and where it is


class PlanningExecution(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scene = moveit_commander.PlanningSceneInterface()
        cls.arm = moveit_commander.MoveGroupCommander("manipulator", wait_for_servers=60.0)
        ManagerClient().wait_until_running("arm_controller")
        cls.goals = []
        cls.subscriber = rospy.Subscriber("/arm_controller/follow_joint_trajectory/goal", FollowJointTrajectoryActionGoal, cls.goals.append)

    def setUp(self):
        self.scene.clear()
        self.arm.set_start_state_to_current_state()
        self.arm.clear_pose_targets()
        self.arm.set_max_velocity_scaling_factor(1.0)
        self.arm.set_max_acceleration_scaling_factor(1.0)

    def assert_at(self, wanted):
        np.testing.assert_allclose(self.arm.get_current_joint_values(), wanted, atol=CLOSE)

    def go_home(self):
        self.arm.set_named_target("HomePose")
        self.assertTrue(self.arm.go(wait=True))
        home = self.arm.get_named_target_values("HomePose")
        self.assert_at([home[name] for name in JOINTS])

    def test_named_targets_are_reached(self):
        self.assertEqual(sorted(self.arm.get_named_targets()), ["AllZeros", "HomePose"])
        self.go_home()
        self.arm.set_named_target("AllZeros")
        self.assertTrue(self.arm.go(wait=True))
        self.assert_at([0.0] * 6)
        self.assertEqual(self.goals[-1].goal.trajectory.joint_names, sorted(JOINTS))

    def test_a_pose_is_reached_and_a_line_followed(self):
        self.go_home()
        pose = self.arm.get_current_pose().pose
        pose.position.y += 0.2
        self.arm.set_pose_target(pose)
        self.assertTrue(self.arm.go(wait=True))
        there = self.arm.get_current_pose().pose.position
        np.testing.assert_allclose([there.x, there.y, there.z], [pose.position.x, pose.position.y, pose.position.z], atol=0.005)
        down = Pose(pose.position, pose.orientation)
        down.position.z -= 0.1
        plan, fraction = self.arm.compute_cartesian_path([down], 0.01, 0.0)
        self.assertEqual(fraction, 1.0)
        self.assertTrue(self.arm.execute(plan, wait=True))
        self.assertAlmostEqual(self.arm.get_current_pose().pose.position.z, down.position.z, delta=0.005)

    def test_stop_ends_a_motion_midway(self):
        self.go_home()
        goal = self.arm.get_current_joint_values()
        goal[0] = 2.0
        self.arm.set_max_velocity_scaling_factor(0.1)
        self.arm.set_joint_value_target(goal)
        done = []
        mover = threading.Thread(target=lambda: done.append(self.arm.go(wait=True)))
        mover.start()
        while abs(self.arm.get_current_joint_values()[0]) < 0.1 and mover.is_alive():
            pass
        self.arm.stop()
        mover.join(30)
        self.assertEqual(done, [False])
        stopped = self.arm.get_current_joint_values()
        self.assertLess(stopped[0], 1.0)
        end = rospy.Time.now() + rospy.Duration(0.7)  # of simulated time, in which it would go on
        wait_until(lambda: rospy.Time.now() > end, "the time")
        np.testing.assert_allclose(self.arm.get_current_joint_values(), stopped, atol=2e-3, err_msg="it was still moving")

    def test_what_is_out_of_reach_fails_and_moves_nothing(self):
        self.go_home()
        before = self.arm.get_current_joint_values()
        self.arm.set_planning_time(1.0)
        self.arm.set_pose_target([3.0, 0.0, 1.0, 0.0, 0.0, 0.0])
        self.assertFalse(self.arm.go(wait=True))
        code = self.arm.plan()[3].val
        self.assertIn(code, (MoveItErrorCodes.GOAL_STATE_INVALID, MoveItErrorCodes.NO_IK_SOLUTION))
        self.arm.set_planning_time(5.0)
        self.assert_at(before)

    def test_a_box_in_the_way_is_gone_around(self):
        self.go_home()
        goal = self.arm.get_current_joint_values()
        goal[0] = 1.6
        self.arm.set_joint_value_target(goal)
        box = self.arm.get_current_pose()
        x, y = box.pose.position.x, box.pose.position.y
        box.pose.position.x = x * np.cos(0.8) - y * np.sin(0.8)
        box.pose.position.y = x * np.sin(0.8) + y * np.cos(0.8)
        box.pose.orientation.x = box.pose.orientation.y = box.pose.orientation.z = 0.0
        box.pose.orientation.w = 1.0
        self.scene.add_box("post", box, (0.1, 0.1, 0.3))
        good, plan, _, _ = self.arm.plan()
        self.assertTrue(good)
        column = plan.joint_trajectory.joint_names
        straight = all(
            np.allclose([point.positions[column.index(name)] for name in JOINTS[1:]], goal[1:], atol=0.02)
            for point in plan.joint_trajectory.points
        )
        self.assertFalse(straight, "the plan goes through the box")
        self.assertTrue(self.arm.execute(plan, wait=True))
        self.assert_at(goal)


if __name__ == "__main__":
    moveit_commander.roscpp_initialize(sys.argv)
    rospy.init_node("planning_execution_rostest")
    rostest.rosrun("myur5_moveit_config", "planning_execution", PlanningExecution)
