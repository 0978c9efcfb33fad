#!/usr/bin/env python3
"""move_group with parameters of wrong kinds: each is told of, and it plans with what is left."""

import unittest

import rospy
import rostest
from moveit_msgs.msg import Constraints, JointConstraint, MotionPlanRequest, MoveItErrorCodes
from moveit_msgs.srv import GetMotionPlan


class HalfWritten(unittest.TestCase):
    def test_it_plans_all_the_same(self):
        rospy.wait_for_service("plan_kinematic_path", 40)
        plan = rospy.ServiceProxy("plan_kinematic_path", GetMotionPlan)
        goal = Constraints(
            joint_constraints=[
                JointConstraint(f"joint_{i + 1}", value, 1e-3, 1e-3, 1.0) for i, value in enumerate((1.2, -0.6, 1.6, 0.0, 1.0, 0.0))
            ]
        )
        request = MotionPlanRequest(group_name="manipulator", goal_constraints=[goal], allowed_planning_time=5.0)
        request.start_state.joint_state.name = [f"joint_{i + 1}" for i in range(6)]
        request.start_state.joint_state.position = [0.0, -0.6, 1.6, 0.0, 1.0, 0.0]
        self.assertEqual(plan(request).motion_plan_response.error_code.val, MoveItErrorCodes.SUCCESS)


if __name__ == "__main__":
    rospy.init_node("half_written_test")
    rostest.rosrun("moveit_ros_move_group", "half_written", HalfWritten)
