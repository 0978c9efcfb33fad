#!/usr/bin/env python3
"""Parameters as configurations of Melodic have them, directly below move_group."""

import unittest

import rospy
import rostest
from client import HOME, LEFT, call, move, plan
from geometry_msgs.msg import Point, Pose, PoseStamped, Quaternion
from moveit_msgs.msg import Constraints, MoveItErrorCodes, OrientationConstraint, PositionConstraint, RobotState
from moveit_msgs.srv import ExecuteKnownTrajectory, GetCartesianPath, GetCartesianPathRequest, QueryPlannerInterfaces
from shape_msgs.msg import SolidPrimitive


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
        self.assertEqual(
            call("execute_kinematic_path", ExecuteKnownTrajectory, found.trajectory, True).error_code.val,
            MoveItErrorCodes.CONTROL_FAILED,
            "the robot is no longer where the trajectory starts",
        )
        self.assertEqual(move(HOME).result()[1].error_code.val, MoveItErrorCodes.SUCCESS)

    def test_where_only_positions_count_orientations_are_free(self):
        """The hand far out, pointing back at the robot: out of reach, but for its position."""
        there = PoseStamped(pose=Pose(Point(0.75, 0.0, 0.35), Quaternion(0.0, -0.707, 0.0, 0.707)))
        there.header.frame_id = "world"
        goal = Constraints(
            position_constraints=[PositionConstraint(header=there.header, link_name="hand", weight=1.0)],
            orientation_constraints=[
                OrientationConstraint(
                    header=there.header,
                    link_name="hand",
                    orientation=there.pose.orientation,
                    weight=1.0,
                    absolute_x_axis_tolerance=1e-3,
                    absolute_y_axis_tolerance=1e-3,
                    absolute_z_axis_tolerance=1e-3,
                )
            ],
        )
        region = goal.position_constraints[0].constraint_region
        region.primitives, region.primitive_poses = [SolidPrimitive(SolidPrimitive.SPHERE, [1e-3])], [there.pose]
        found = plan(goal_constraints=[goal])
        self.assertEqual(found.error_code.val, MoveItErrorCodes.SUCCESS)
        line = call(
            "compute_cartesian_path",
            GetCartesianPath,
            GetCartesianPathRequest(
                start_state=RobotState(is_diff=True), group_name="manipulator", link_name="hand", max_step=0.02, waypoints=[there.pose]
            ),
        )
        self.assertEqual(line.fraction, 1.0)


if __name__ == "__main__":
    rospy.init_node("melodic_rostest")
    rostest.rosrun("moveit_ros_move_group", "melodic", Melodic)
