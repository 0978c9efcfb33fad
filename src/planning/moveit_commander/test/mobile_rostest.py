#!/usr/bin/env python3
"""A robot on a base that drives, and a joint that turns without end, as MoveGroupCommander and RobotCommander see them."""

import unittest

import moveit_commander
import numpy as np
import rospy
import rostest
from geometry_msgs.msg import Quaternion, Transform, TransformStamped, Vector3
from moveit_commander import MoveGroupCommander, MoveItCommanderException, RobotCommander
from moveit_msgs.msg import Constraints, JointConstraint, MotionPlanRequest, PositionIKRequest, RobotState
from moveit_msgs.msg import MoveItErrorCodes as Codes
from moveit_msgs.srv import GetMotionPlan, GetPositionFK, GetPositionIK
from sensor_msgs.msg import JointState
from std_msgs.msg import Header
from tf2_ros import StaticTransformBroadcaster

HOME = [0.0, -0.6, 1.6, 0.0, 1.0, 0.0]


def vector(pose):
    return [pose.position.x, pose.position.y, pose.position.z]


class Mobile(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.frames = StaticTransformBroadcaster()
        place = TransformStamped(header=Header(frame_id="odom", stamp=rospy.Time.now()), child_frame_id="world")
        place.transform.translation.x, place.transform.translation.y = 1.0, -0.5
        place.transform.rotation.z, place.transform.rotation.w = np.sin(0.15), np.cos(0.15)
        cls.frames.sendTransform(place)
        cls.arm = MoveGroupCommander("manipulator", wait_for_servers=60.0)
        cls.base = MoveGroupCommander("base")
        cls.robot = RobotCommander()

    def test_the_base_is_where_tf_has_it(self):
        np.testing.assert_allclose(self.base.get_current_joint_values(), [1.0, -0.5, 0.3], atol=1e-6)
        np.testing.assert_allclose(self.robot.get_joint("base").value(), [1.0, -0.5, 0.3], atol=1e-6)
        there = rospy.ServiceProxy("compute_fk", GetPositionFK)(Header(frame_id="odom"), ["hand"], RobotState(is_diff=True)).pose_stamped[0]
        for pose in (self.arm.get_current_pose("hand"), self.robot.get_link("hand").pose()):
            self.assertEqual(pose.header.frame_id, "odom")
            np.testing.assert_allclose(vector(pose.pose), vector(there.pose), atol=1e-4)
        state = self.robot.get_current_state().multi_dof_joint_state
        self.assertAlmostEqual(dict(zip(state.joint_names, state.transforms))["base"].translation.x, 1.0)

    def test_a_state_may_give_the_base_in_another_frame(self):
        """0.5 m ahead of where the base stands, (1, -0.5) turned by 0.3 rad; a frame that nobody knows is the robot's own."""
        state = RobotState(is_diff=True)
        state.multi_dof_joint_state.joint_names = ["base"]
        state.multi_dof_joint_state.transforms = [Transform(Vector3(0.5, 0.0, 0.0), Quaternion(0.0, 0.0, 0.0, 1.0))]
        for frame, there in (
            ("world", [1.0 + 0.5 * np.cos(0.3), -0.5 + 0.5 * np.sin(0.3), 0.3]),
            ("odom", [0.5, 0.0, 0.0]),
            ("", [0.5, 0.0, 0.0]),
            ("nowhere", [0.5, 0.0, 0.0]),
        ):
            state.multi_dof_joint_state.header.frame_id = frame
            pose = rospy.ServiceProxy("compute_fk", GetPositionFK)(Header(frame_id="odom"), ["world"], state).pose_stamped[0].pose
            found = [pose.position.x, pose.position.y, 2 * np.arctan2(pose.orientation.z, pose.orientation.w)]
            np.testing.assert_allclose(found, there, atol=1e-6, err_msg=frame)
        state.multi_dof_joint_state.header.frame_id = "world"
        self.base.set_workspace([-5, -5, 0, 5, 5, 0])
        self.base.set_start_state(state)
        self.base.set_joint_value_target([2.0, -0.5, 0.3])
        good, path, _, _ = self.base.plan()
        self.base.set_start_state_to_current_state()
        self.assertTrue(good)
        begin = path.multi_dof_joint_trajectory.points[0].transforms[0].translation
        np.testing.assert_allclose([begin.x, begin.y], [1.0 + 0.5 * np.cos(0.3), -0.5 + 0.5 * np.sin(0.3)], atol=1e-6)

    def test_a_line_from_where_the_hand_is(self):
        self.arm.set_joint_value_target(HOME)
        self.assertTrue(self.arm.go())
        down = self.arm.get_current_pose("hand").pose
        down.position.z -= 0.05
        path, share = self.arm.compute_cartesian_path([down], 0.01, 0.0)
        self.assertEqual(share, 1.0)
        rows = np.array([point.positions for point in path.joint_trajectory.points])
        self.assertLess(np.abs(np.diff(rows, axis=0)).max(), 0.2)

    def test_limits_of_the_base_and_limits_without_flags_count(self):
        """1 m at 0.2 m/s; 0.9 rad at 0.2 rad/s^2 takes 2 sqrt(0.9 / 0.2) s."""
        self.base.set_workspace([-5, -5, 0, 5, 5, 0])
        self.base.set_joint_value_target([2.0, -0.5, 0.3])
        good, path, _, _ = self.base.plan()
        self.assertTrue(good)
        self.assertGreaterEqual(path.multi_dof_joint_trajectory.points[-1].time_from_start.to_sec(), 5.0 - 1e-3)
        self.assertRaises(MoveItCommanderException, self.base.set_joint_value_target, [3.5, 0.0, 0.0])
        self.arm.set_joint_value_target([self.arm.get_current_joint_values()[0] + 0.9] + HOME[1:])
        good, path, _, _ = self.arm.plan()
        self.assertTrue(good)
        self.assertGreaterEqual(path.joint_trajectory.points[-1].time_from_start.to_sec(), 0.95 * 2 * np.sqrt(0.9 / 0.2))

    def test_workspaces(self):
        """As upstream a frame is not looked at, and nothing is inside corners the wrong way round; arms stand in no workspace."""

        def answer(low, high, group="base", frame=""):
            names = [f"base/{name}" for name in ("x", "y", "theta")] if group == "base" else self.arm.get_active_joints()
            goal = [2.0, -0.5, 0.3] if group == "base" else [0.5, *HOME[1:]]
            wanted = MotionPlanRequest(group_name=group, allowed_planning_time=5.0, start_state=RobotState(is_diff=True))
            wanted.goal_constraints = [Constraints(joint_constraints=[JointConstraint(n, v, 1e-3, 1e-3, 1.0) for n, v in zip(names, goal)])]
            wanted.workspace_parameters.header.frame_id = frame
            wanted.workspace_parameters.min_corner, wanted.workspace_parameters.max_corner = Vector3(*low), Vector3(*high)
            return rospy.ServiceProxy("plan_kinematic_path", GetMotionPlan)(wanted).motion_plan_response

        ends, low, high = float("nan"), (-5.0, -5.0, 0.0), (5.0, 5.0, 0.0)
        for name, code, asked in (
            ("none", Codes.SUCCESS, ((0, 0, 0), (0, 0, 0))),
            ("a plane", Codes.SUCCESS, (low, high)),
            ("a frame that is not known", Codes.SUCCESS, (low, high, "base", "nowhere")),
            ("corners the wrong way round", Codes.START_STATE_INVALID, (high, low)),
            ("one of them", Codes.START_STATE_INVALID, ((-5.0, 5.0, 0.0), (5.0, -5.0, 0.0))),
            ("no number", Codes.START_STATE_INVALID, ((ends, -5.0, 0.0), high)),
            ("around an arm", Codes.SUCCESS, (high, low, "manipulator")),
            ("the start is outside", Codes.SUCCESS, ((3.0, 3.0, 0.0), high)),
        ):
            found = answer(*asked)
            self.assertEqual(found.error_code.val, code, name)
            if code == Codes.SUCCESS and "manipulator" not in asked:
                last = found.trajectory.multi_dof_joint_trajectory.points[-1].transforms[0].translation
                np.testing.assert_allclose([last.x, last.y], [2.0, -0.5], atol=2e-3, err_msg=name)

    def test_a_joint_without_end_may_be_sent_anywhere(self):
        for target in (9.0, -4.0):
            self.arm.set_joint_value_target(dict(zip(self.arm.get_active_joints(), HOME[:5] + [target])))
            self.assertTrue(self.arm.go())
            turned = self.arm.get_current_joint_values()[5]
            self.assertAlmostEqual(np.cos(turned - target), 1.0, delta=1e-4)
        self.assertRaises(MoveItCommanderException, self.arm.set_joint_value_target, [9.0] + HOME[1:])

    def test_kinematics_lines_and_memory_of_a_joint_that_has_turned_far(self):
        names = self.arm.get_active_joints()
        for turned in (9.0, -4.0):
            start = RobotState(is_diff=True, joint_state=JointState(name=names, position=[*HOME[:5], turned]))
            there = rospy.ServiceProxy("compute_fk", GetPositionFK)(Header(frame_id="world"), ["hand"], start).pose_stamped[0]
            asked = PositionIKRequest(group_name="manipulator", robot_state=start, pose_stamped=there, timeout=rospy.Duration(1.0))
            found = rospy.ServiceProxy("compute_ik", GetPositionIK)(asked)
            self.assertEqual(found.error_code.val, Codes.SUCCESS)
            found = rospy.ServiceProxy("compute_fk", GetPositionFK)(Header(frame_id="world"), ["hand"], found.solution)
            np.testing.assert_allclose(vector(found.pose_stamped[0].pose), vector(there.pose), atol=1e-3)
            down = there.pose
            down.position.z -= 0.05
            self.arm.set_pose_reference_frame("world")
            self.arm.set_start_state(start)
            path, share = self.arm.compute_cartesian_path([down], 0.01, 0.0)
            self.arm.set_start_state_to_current_state()
            self.arm.set_pose_reference_frame("odom")
            rows = np.array([point.positions for point in path.joint_trajectory.points])
            self.assertEqual(share, 1.0)
            self.assertAlmostEqual(np.cos(rows[0, 5] - turned), 1.0, delta=1e-6)
            self.assertLess(np.abs(np.diff(rows, axis=0)).max(), 0.2)
            self.arm.remember_joint_values("spun", [*HOME[:5], turned])
            self.arm.set_named_target("spun")
            self.assertTrue(self.arm.go())
            self.assertAlmostEqual(np.cos(self.arm.get_current_joint_values()[5] - turned), 1.0, delta=1e-4)

    def test_a_value_within_the_tolerance_of_a_limit_is_taken(self):
        """As upstream: bounds are asked with the goal's joint tolerance."""
        self.arm.set_joint_value_target([3.1 + 5e-5] + HOME[1:])
        self.assertRaises(MoveItCommanderException, self.arm.set_joint_value_target, [3.1 + 2e-4] + HOME[1:])


if __name__ == "__main__":
    moveit_commander.roscpp_initialize([])
    rospy.init_node("mobile_rostest")
    rostest.rosrun("moveit_commander", "mobile", Mobile)
