#!/usr/bin/env python3
"""A motion is cancelled, or said to stop, while it is planned, executed, and between two plans."""

import os
import sys
import unittest
import xmlrpc.client

import numpy as np
import rosgraph
import rospkg
import rospy
import rostest
from actionlib_msgs.msg import GoalStatus
from moveit_msgs.msg import (
    ExecuteTrajectoryAction,
    ExecuteTrajectoryActionGoal,
    ExecuteTrajectoryGoal,
    MoveGroupAction,
    MoveGroupActionGoal,
    MoveGroupGoal,
    MoveItErrorCodes,
)
from moveit_msgs.srv import GetPositionFK, GetPositionFKRequest
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from test_support.hearing import deliver, heard

sys.path.insert(0, rospkg.RosPack().get_path("moveit_ros_move_group") + "/test")
from client import HOME, JOINTS, LEFT, PATIENCE, Goal, apply, box, call, clear, move, plan, request, wait_until  # noqa: E402

Codes = MoveItErrorCodes
LONG = 600.0  # s: planning that uses all its time ends only because it is stopped


def at(wanted):
    message = rospy.wait_for_message("joint_states", JointState, PATIENCE)
    return np.allclose([message.position[message.name.index(name)] for name in JOINTS], wanted, atol=0.02)


def processor_time(node):
    """s that the process of a node has used."""
    pid = xmlrpc.client.ServerProxy(rosgraph.Master(rospy.get_name()).lookupNode(node)).getPid(rospy.get_name())[2]
    with open(f"/proc/{pid}/stat") as file:
        user, system = file.read().rpartition(")")[2].split()[11:13]
    return (int(user) + int(system)) / os.sysconf("SC_CLK_TCK")


class Stopping(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.event = rospy.Publisher("trajectory_execution_event", String, queue_size=1)
        wait_until(cls.event.get_num_connections, "the listener")

    def setUp(self):
        clear()
        self.assertEqual(move(HOME).result()[1].error_code.val, Codes.SUCCESS)

    def tearDown(self):
        clear()

    def ended(self, goal, status, code, *words):
        found, result, text = goal.result()
        self.assertEqual((found, result.error_code.val), (status, code), text)
        self.assertTrue(all(word in text for word in words), text)
        self.assertNotIn("\n", text)

    def planning(self, plan_only):
        goal = move(LEFT, plan_only, planner_id="RRTstar", allowed_planning_time=LONG)
        wait_until(lambda: "PLANNING" in goal.states, "planning")
        begin = processor_time("/move_group")
        wait_until(lambda: processor_time("/move_group") > begin + 0.3, "a search that is under way")
        return goal

    def test_cancel_while_planning_only(self):
        goal = self.planning(plan_only=True)
        goal.cancel()
        self.ended(goal, GoalStatus.PREEMPTED, Codes.PREEMPTED, "cancelled")

    def test_cancel_while_planning_to_move(self):
        goal = self.planning(plan_only=False)
        goal.cancel()
        self.ended(goal, GoalStatus.PREEMPTED, Codes.PREEMPTED, "stopped before the execution")
        self.assertTrue(at(HOME))

    def test_stop_while_planning_to_move(self):
        goal = self.planning(plan_only=False)
        self.event.publish("stop")
        self.ended(goal, GoalStatus.PREEMPTED, Codes.PREEMPTED, "stopped before the execution")
        self.assertTrue(at(HOME))

    def test_cancel_and_stop_while_moving(self):
        goal = move(LEFT, max_velocity_scaling_factor=0.05)
        wait_until(lambda: not at(HOME), "a motion")
        goal.cancel()
        self.ended(goal, GoalStatus.PREEMPTED, Codes.PREEMPTED, "stopped while executing")
        goal = move(LEFT, max_velocity_scaling_factor=0.05)
        wait_until(lambda: "MONITOR" in goal.states, "the execution")
        self.event.publish("stop")
        self.ended(goal, GoalStatus.ABORTED, Codes.CONTROL_FAILED, "said to stop")  # upstream's code
        self.assertFalse(at(LEFT))

    def overtaken(self, name, kind, action_goal, goal):
        """The result of a goal that says that it is from before a stop, and comes after it."""
        ended = []
        results = rospy.Subscriber(name + "/result", kind().action_result.__class__, ended.append)
        goals = rospy.Publisher(name + "/goal", action_goal, queue_size=1)
        wait_until(lambda: goals.get_num_connections() and heard([results]), "move_group")
        message = action_goal(goal=goal)
        message.goal_id.stamp = rospy.Time.now()
        message.goal_id.id = f"overtaken {name} {message.goal_id.stamp}"
        deliver(self.event, "stop")
        goals.publish(message)
        wait_until(lambda: [result for result in ended if result.status.goal_id.id == message.goal_id.id], "a result")
        results.unregister()
        goals.unregister()
        return ended[-1].result

    def test_a_stop_that_overtakes_its_goal(self):
        message = MoveGroupGoal(request=request(LEFT))
        diff = message.planning_options.planning_scene_diff
        diff.is_diff = diff.robot_state.is_diff = True
        for _ in range(5):
            result = self.overtaken("move_group", MoveGroupAction, MoveGroupActionGoal, message)
            self.assertEqual(result.error_code.val, Codes.PREEMPTED)
        path = plan(LEFT).trajectory
        for _ in range(5):
            result = self.overtaken(
                "execute_trajectory", ExecuteTrajectoryAction, ExecuteTrajectoryActionGoal, ExecuteTrajectoryGoal(trajectory=path)
            )
            self.assertEqual(result.error_code.val, Codes.PREEMPTED)
        self.assertTrue(at(HOME))

    def test_a_stop_or_a_cancel_right_after_the_goal(self):
        for _ in range(10):
            goal = move(LEFT)
            self.event.publish("stop")
            self.assertIn(goal.result()[1].error_code.val, (Codes.PREEMPTED, Codes.CONTROL_FAILED))
            goal = move(LEFT)
            goal.cancel()
            # An actionlib client takes a status from before the goal for the loss of it when it has cancelled it already.
            self.assertIn(goal.result()[0], (GoalStatus.PREEMPTED, GoalStatus.RECALLED, GoalStatus.LOST))
        for _ in range(25):  # as many states of the joints as half a second has
            self.assertTrue(at(HOME))

    def test_a_goal_that_comes_after_a_stop(self):
        deliver(self.event, "stop")
        self.ended(move(LEFT), GoalStatus.SUCCEEDED, Codes.SUCCESS)

    def test_cancel_between_two_plans(self):
        message = MoveGroupGoal(request=request(LEFT, max_velocity_scaling_factor=0.05))
        options = message.planning_options
        options.planning_scene_diff.is_diff = options.planning_scene_diff.robot_state.is_diff = True
        options.replan, options.replan_attempts, options.replan_delay = True, 5, LONG
        goal = Goal("move_group", MoveGroupAction, message)
        ask = GetPositionFKRequest(fk_link_names=["hand"])
        ask.robot_state.joint_state = JointState(name=JOINTS, position=[0.9] + HOME[1:])
        there = call("compute_fk", GetPositionFK, ask).pose_stamped[0].pose.position
        wait_until(lambda: not at(HOME), "a motion")
        apply(box("post", there.x, there.y, there.z))
        still = []

        def rests():
            now = rospy.wait_for_message("joint_states", JointState, PATIENCE).position
            still.append(now)
            return len(still) > 10 and np.allclose(still[-1], still[-10], atol=1e-4)

        wait_until(rests, "the arm to be stopped by the post")
        self.assertFalse(at(LEFT))
        goal.cancel()
        self.ended(goal, GoalStatus.PREEMPTED, Codes.PREEMPTED, "stopped before the execution")


if __name__ == "__main__":
    rospy.init_node("stopping_rostest")
    rostest.rosrun("moveit_ros_move_group", "stopping", Stopping)
