#!/usr/bin/env python3
"""Parameters as configurations of Melodic have them, directly below move_group."""
import unittest

import rospy
import rostest
from client import HOME, LEFT, call, move, plan
from moveit_msgs.msg import MoveItErrorCodes
from moveit_msgs.srv import ExecuteKnownTrajectory, QueryPlannerInterfaces


class Melodic(unittest.TestCase):
    def test_one_pipeline_without_a_name(self):
        found = call("query_planner_interface", QueryPlannerInterfaces).planner_interfaces
        self.assertEqual([(entry.name, entry.pipeline_id) for entry in found], [("OMPL", "")])
        self.assertIn("manipulator[RRTConnectkConfigDefault]", found[0].planner_ids)
        self.assertEqual(rospy.get_param("/move_group/default_planning_pipeline"), "")

    def test_it_plans_and_moves_though_the_default_planner_is_none(self):
        self.assertEqual(plan(LEFT).error_code.val, MoveItErrorCodes.SUCCESS)
        for goal in (LEFT, HOME):
            moved = move(goal, planner_id="RRTConnectkConfigDefault").result()[1]
            self.assertEqual(moved.error_code.val, MoveItErrorCodes.SUCCESS)

    def test_old_configurations_ask_for_a_service_that_executes(self):
        found = plan(LEFT)
        answer = call("execute_kinematic_path", ExecuteKnownTrajectory, found.trajectory, True)
        self.assertEqual(answer.error_code.val, MoveItErrorCodes.SUCCESS)
        self.assertEqual(call("execute_kinematic_path", ExecuteKnownTrajectory, found.trajectory, True).error_code.val,
                         MoveItErrorCodes.CONTROL_FAILED, "the robot is no longer where the trajectory starts")
        self.assertEqual(move(HOME).result()[1].error_code.val, MoveItErrorCodes.SUCCESS)


if __name__ == "__main__":
    rospy.init_node("melodic_rostest")
    rostest.rosrun("moveit_ros_move_group", "melodic", Melodic)
