#!/usr/bin/env python3
"""Trajectories through actions: late, refusing, failing, stalling and dying controllers."""

import subprocess
import sys
import unittest
from pathlib import Path

import rospkg
import rospy
import rostest
from actionlib_msgs.msg import GoalStatus
from moveit_msgs.msg import ExecuteTrajectoryAction, ExecuteTrajectoryGoal, MoveItErrorCodes, RobotTrajectory
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from trajectory_msgs.msg import JointTrajectoryPoint

sys.path.insert(0, rospkg.RosPack().get_path("moveit_ros_move_group") + "/test")
from client import HOME, JOINTS, PATIENCE, Goal, wait_until  # noqa: E402

Codes = MoveItErrorCodes
NEAR = [0.5] + HOME[1:]
TOLERANCES = {f"joint_{number}": number / 100 for number in range(1, 7)}  # actions.yaml lists them from the last joint to the first


def trajectory(seconds, names=JOINTS, start=HOME, end=NEAR):
    message = RobotTrajectory()
    message.joint_trajectory.joint_names = list(names)
    for share in range(11):
        message.joint_trajectory.points.append(
            JointTrajectoryPoint(
                positions=[a + (b - a) * share / 10 for a, b in zip(start, end)],
                velocities=[0.0] * len(names),
                time_from_start=rospy.Duration(seconds * share / 10),
            )
        )
    return message


def execute(message):
    return Goal("execute_trajectory", ExecuteTrajectoryAction, ExecuteTrajectoryGoal(message))


class SimpleManager(unittest.TestCase):
    def setUp(self):
        self.robot = None

    def tearDown(self):
        if self.robot is not None:
            self.robot.kill()
            self.robot.wait(PATIENCE)

    def start(self, mode="follow", **more):
        rospy.set_param("/pretend_controller", {"mode": mode, **more})
        self.robot = subprocess.Popen([sys.executable, str(Path(__file__).with_name("pretend_controller.py"))])
        rospy.wait_for_message("joint_states", JointState, PATIENCE)

    def expect(self, message, status, code, *words):
        found, result, text = execute(message).result()
        self.assertEqual((found, result.error_code.val), (status, code), text)
        for word in words:
            self.assertIn(word, text)
        self.assertNotIn("\n", text)

    def test_a_controller_that_comes_late_is_used_when_it_comes(self):
        rospy.wait_for_service("get_planning_scene", timeout=PATIENCE)
        elsewhere = rospy.Publisher("/arm/joint_states", JointState, queue_size=1)
        self.expect(
            trajectory(0.5), GoalStatus.ABORTED, Codes.CONTROL_FAILED, "Nobody publishes /joint_states", "joint_states:=/arm/joint_states"
        )
        elsewhere.unregister()
        self.expect(trajectory(0.5), GoalStatus.ABORTED, Codes.CONTROL_FAILED, "Nobody publishes /joint_states: start the robot")
        self.start()
        self.expect(trajectory(0.5), GoalStatus.SUCCEEDED, Codes.SUCCESS)
        sent = rospy.get_param("/pretend_controller/goal")
        self.assertEqual((sent["joints"], sent["goal_time"], sent["tolerances"]), (sorted(JOINTS), 0.5, TOLERANCES))

    def test_joints_come_in_alphabetical_order(self):
        self.start()
        names = list(reversed(JOINTS))
        self.expect(trajectory(0.5, names, HOME[::-1], NEAR[::-1]), GoalStatus.SUCCEEDED, Codes.SUCCESS)
        self.assertEqual(rospy.get_param("/pretend_controller/goal")["joints"], sorted(JOINTS))

    def test_a_gripper_gets_the_last_point(self):
        self.start()
        self.expect(trajectory(0.5, ["finger_joint"], [0.0], [0.03]), GoalStatus.SUCCEEDED, Codes.SUCCESS)
        self.assertEqual(rospy.get_param("/pretend_controller/grip"), [0.03, 5.0])

    def test_what_is_sent_while_it_starts_anew_is_not_lost(self):
        """The node that died has left connections to its topics in the client."""
        self.start()
        self.expect(trajectory(0.5, ["finger_joint"], [0.0], [0.03]), GoalStatus.SUCCEEDED, Codes.SUCCESS)
        self.tearDown()
        self.start(late=1.5)
        self.expect(trajectory(0.5, ["finger_joint"], [0.0], [0.02]), GoalStatus.SUCCEEDED, Codes.SUCCESS)
        self.tearDown()
        self.start(late=1.5)
        self.expect(trajectory(0.5), GoalStatus.SUCCEEDED, Codes.SUCCESS)

    def test_a_refusal_and_a_failure_say_why(self):
        self.start("reject")
        self.expect(trajectory(1.0), GoalStatus.ABORTED, Codes.CONTROL_FAILED, "arm_controller", "INVALID_JOINTS", "not mine")
        rospy.set_param("/pretend_controller/mode", "abort")
        self.expect(trajectory(1.0), GoalStatus.ABORTED, Codes.CONTROL_FAILED, "PATH_TOLERANCE_VIOLATED", "joint_1 is late")

    def test_a_controller_that_takes_too_long_is_stopped(self):
        self.start("stall")
        self.expect(trajectory(0.5), GoalStatus.ABORTED, Codes.TIMED_OUT, "taking too long", "arm_controller")
        rospy.set_param("/pretend_controller/mode", "follow")
        self.expect(trajectory(0.5), GoalStatus.SUCCEEDED, Codes.SUCCESS)

    def test_a_controller_that_dies_in_motion_is_noticed(self):
        self.start("stall")
        goal = execute(trajectory(60.0))
        wait_until(lambda: "MONITOR" in goal.states, "the execution")
        wait_until(lambda: rospy.has_param("/pretend_controller/goal"), "the controller to have it")
        self.robot.kill()
        began = rospy.get_time()
        status, result, text = goal.result()
        self.assertEqual((status, result.error_code.val), (GoalStatus.ABORTED, Codes.CONTROL_FAILED), text)
        self.assertIn("has gone away", text)
        self.assertLess(rospy.get_time() - began, 30.0)  # not the 73 s that it was allowed to take

    def test_stop_ends_it_preempted(self):
        self.start("stall")
        goal = execute(trajectory(60.0))
        wait_until(lambda: "MONITOR" in goal.states, "the execution")
        publisher = rospy.Publisher("trajectory_execution_event", String, queue_size=1)
        wait_until(publisher.get_num_connections, "the listener")
        publisher.publish("stop")
        status, result, _ = goal.result()
        self.assertEqual((status, result.error_code.val), (GoalStatus.PREEMPTED, Codes.PREEMPTED))

    def test_two_controllers_move_together(self):
        self.start()
        names = ["finger_joint"] + JOINTS
        both = trajectory(0.5, names, [0.0] + HOME, [0.01] + NEAR)
        self.expect(both, GoalStatus.SUCCEEDED, Codes.SUCCESS)
        self.assertEqual(rospy.get_param("/pretend_controller/grip")[0], 0.01)


if __name__ == "__main__":
    rospy.init_node("simple_rostest")
    rostest.rosrun("moveit_simple_controller_manager", "simple_controller_manager", SimpleManager)
