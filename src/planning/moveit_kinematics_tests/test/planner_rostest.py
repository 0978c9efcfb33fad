#!/usr/bin/env python3
"""move_group plans with a compiled planner and a compiled request adapter of another package."""

import actionlib
import rospy
import rostest
import test_support
from actionlib_msgs.msg import GoalStatus
from moveit_msgs.msg import Constraints, JointConstraint, MotionPlanRequest, MoveGroupAction, MoveGroupGoal, MoveItErrorCodes
from moveit_msgs.srv import GetMotionPlan, QueryPlannerInterfaces
from test_support.waiting import wait_until

JOINTS, GOAL = ("shoulder", "elbow", "lift", "wrist"), (0.5, 0.8, -0.1, 0.4)


def request(pipeline="straight", planner="", group="one", joints=JOINTS):
    goal = Constraints(joint_constraints=[JointConstraint(name, value, 1e-3, 1e-3, 1.0) for name, value in zip(joints, GOAL)])
    return MotionPlanRequest(group_name=group, pipeline_id=pipeline, planner_id=planner, goal_constraints=[goal], allowed_planning_time=5.0)


class Planner(test_support.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.wait_for_service("plan_kinematic_path", 60)
        cls.service = rospy.ServiceProxy("plan_kinematic_path", GetMotionPlan)

    def plan(self, *args, **kwargs):
        return self.service(request(*args, **kwargs)).motion_plan_response

    def test_the_path_is_the_planners_timed_by_the_adapters(self):
        response = self.plan()
        self.assertEqual(response.error_code.val, MoveItErrorCodes.SUCCESS)
        points = response.trajectory.joint_trajectory.points
        self.assertEqual(len(points), 11)
        columns = [response.trajectory.joint_trajectory.joint_names.index(name) for name in JOINTS]
        for step, point in enumerate(points):
            for column, value in zip(columns, GOAL):
                self.assertAlmostEqual(point.positions[column], value * step / 10, 6)
        times = [point.time_from_start.to_sec() for point in points]
        self.assertTrue(all(a < b for a, b in zip(times, times[1:])), times)

    def test_a_compiled_adapter_goes_round_the_planner_of_this_workspace(self):
        response = self.plan(pipeline="ompl")
        self.assertEqual(response.error_code.val, MoveItErrorCodes.SUCCESS)
        times = [point.time_from_start.to_sec() for point in response.trajectory.joint_trajectory.points]
        self.assertEqual(times, [float(i) for i in range(len(times))])

    def test_what_goes_wrong_in_the_planner_stays_there(self):
        for kwargs in (
            dict(planner="throw"),
            dict(joints=("no_such_joint",)),
            dict(pipeline="absent"),
            dict(pipeline="unready"),
            dict(group="legs"),
        ):
            with self.subTest(**kwargs):
                self.assertEqual(self.plan(**kwargs).error_code.val, MoveItErrorCodes.FAILURE)
        self.assertEqual(self.plan().error_code.val, MoveItErrorCodes.SUCCESS)

    def test_it_is_listed(self):
        found = rospy.ServiceProxy("query_planner_interface", QueryPlannerInterfaces)().planner_interfaces
        listed = {one.pipeline_id: (one.name, one.planner_ids) for one in found}
        self.assertEqual(listed["straight"], ("STRAIGHT", ["straight"]))

    def test_cancelling_ends_it(self):
        client = actionlib.SimpleActionClient("move_group", MoveGroupAction)
        self.assertTrue(client.wait_for_server(rospy.Duration(20)))
        goal = MoveGroupGoal(request=request(planner="sleep"))
        goal.planning_options.plan_only = True
        states = []
        client.send_goal(goal, feedback_cb=lambda feedback: states.append(feedback.state))
        wait_until(lambda: "PLANNING" in states, "planning")
        client.cancel_goal()
        self.assertTrue(client.wait_for_result(rospy.Duration(10)))
        self.assertEqual(client.get_state(), GoalStatus.PREEMPTED)


if __name__ == "__main__":
    rospy.init_node("planner_test")
    rostest.rosrun("moveit_kinematics_tests", "planner", Planner)
