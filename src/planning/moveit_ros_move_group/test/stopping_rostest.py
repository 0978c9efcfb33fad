#!/usr/bin/env python3
"""A motion is cancelled, or said to stop, while it is planned, executed, and between two plans."""
import sys
import unittest

import numpy as np
import rospkg
import rospy
import rostest
from actionlib_msgs.msg import GoalStatus
from moveit_msgs.msg import MoveGroupAction, MoveGroupGoal, MoveItErrorCodes
from moveit_msgs.srv import GetPositionFK, GetPositionFKRequest
from sensor_msgs.msg import JointState
from std_msgs.msg import String

sys.path.insert(0, rospkg.RosPack().get_path("moveit_ros_move_group") + "/test")
from client import HOME, JOINTS, LEFT, PATIENCE, Goal, apply, box, call, clear, move, request, wait_until  # noqa: E402

Codes = MoveItErrorCodes
LONG = 600.0  # s: planning that uses all its time ends only because it is stopped


def at(wanted):
    message = rospy.wait_for_message("joint_states", JointState, PATIENCE)
    return np.allclose([message.position[message.name.index(name)] for name in JOINTS], wanted, atol=0.02)


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
        rospy.sleep(0.5)
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
