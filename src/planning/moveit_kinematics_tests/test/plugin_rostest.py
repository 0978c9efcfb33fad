#!/usr/bin/env python3
"""move_group solves with a compiled kinematics plugin, and with its own solver where one cannot be used."""

import math
import unittest

import rospy
import rostest
from geometry_msgs.msg import PoseStamped
from moveit_msgs.msg import Constraints, MoveItErrorCodes, OrientationConstraint, PositionConstraint
from moveit_msgs.srv import GetMotionPlan, GetMotionPlanRequest, GetPositionIK, GetPositionIKRequest
from shape_msgs.msg import SolidPrimitive

SHOULDER, ELBOW, LIFT, WRIST = "shoulder", "elbow", "lift", "wrist"


def pose(shoulder, elbow, lift, wrist):
    """Where the tool is with these values."""
    message = PoseStamped()
    message.header.frame_id = "base"
    message.pose.position.x = 0.3 * math.cos(shoulder) + 0.2 * math.cos(shoulder + elbow)
    message.pose.position.y = 0.3 * math.sin(shoulder) + 0.2 * math.sin(shoulder + elbow)
    message.pose.position.z = 0.4 + lift
    message.pose.orientation.z = math.sin((shoulder + elbow + wrist) / 2)
    message.pose.orientation.w = math.cos((shoulder + elbow + wrist) / 2)
    return message


class Plugin(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.wait_for_service("compute_ik", 60)
        cls.service = rospy.ServiceProxy("compute_ik", GetPositionIK)

    def solve(self, group, target, seed):
        request = GetPositionIKRequest()
        request.ik_request.group_name = group
        request.ik_request.pose_stamped = target
        request.ik_request.robot_state.joint_state.name = [SHOULDER, ELBOW, LIFT, WRIST]
        request.ik_request.robot_state.joint_state.position = seed
        request.ik_request.timeout = rospy.Duration(1.0)
        response = self.service(request)
        self.assertEqual(response.error_code.val, MoveItErrorCodes.SUCCESS)
        state = response.solution.joint_state
        values = dict(zip(state.name, state.position))
        return [values[name] for name in (SHOULDER, ELBOW, LIFT, WRIST)]

    def test_the_plugin_answers_as_its_parameter_says(self):
        """From a seed that is the goal itself, but with the elbow on the other side: only the plugin goes there."""
        goal = (0.4, 0.9, -0.1, 0.3)
        shoulder, elbow, lift, wrist = self.solve("one", pose(*goal), goal)
        self.assertAlmostEqual(elbow, -0.9, 6)
        reached, wanted = pose(shoulder, elbow, lift, wrist).pose, pose(*goal).pose
        for field in "xyz":
            self.assertAlmostEqual(getattr(reached.position, field), getattr(wanted.position, field), 6)

    def test_one_that_is_not_built_and_one_for_another_robot_are_replaced(self):
        goal = (0.4, 0.9, -0.1, 0.3)
        for group in ("two", "three"):
            for value, wanted in zip(self.solve(group, pose(*goal), goal), goal):
                self.assertAlmostEqual(value, wanted, 4)

    def test_goals_of_plans_are_the_plugin_s(self):
        plan = rospy.ServiceProxy("plan_kinematic_path", GetMotionPlan)
        plan.wait_for_service(30)
        target = pose(0.4, 0.9, -0.1, 0.3)
        position = PositionConstraint(link_name="tool", weight=1.0)
        position.header.frame_id = "base"
        position.constraint_region.primitives = [SolidPrimitive(SolidPrimitive.SPHERE, [1e-4])]
        position.constraint_region.primitive_poses = [target.pose]
        turn = OrientationConstraint(
            link_name="tool",
            orientation=target.pose.orientation,
            absolute_x_axis_tolerance=1e-3,
            absolute_y_axis_tolerance=1e-3,
            absolute_z_axis_tolerance=1e-3,
            weight=1.0,
        )
        turn.header.frame_id = "base"
        request = GetMotionPlanRequest()
        request.motion_plan_request.group_name = "one"
        request.motion_plan_request.allowed_planning_time = 5.0
        request.motion_plan_request.start_state.is_diff = True
        request.motion_plan_request.goal_constraints = [Constraints(position_constraints=[position], orientation_constraints=[turn])]
        response = plan(request).motion_plan_response
        self.assertEqual(response.error_code.val, MoveItErrorCodes.SUCCESS)
        joints = response.trajectory.joint_trajectory
        self.assertAlmostEqual(joints.points[-1].positions[joints.joint_names.index(ELBOW)], -0.9, 2)


if __name__ == "__main__":
    rospy.init_node("plugin_test")
    rostest.rosrun("moveit_kinematics_tests", "plugin", Plugin)
