#!/usr/bin/env python3
"""Simulated servos: single commands at limited speed, whole ticks, torque services, trajectories."""

import math
import unittest

import actionlib
import rospy
import rostest
from actionlib_msgs.msg import GoalStatus
from arbotix_msgs.srv import Enable, Relax
from control_msgs.msg import FollowJointTrajectoryAction, FollowJointTrajectoryGoal
from ros_helpers import Collector, RunningClock
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64
from trajectory_msgs.msg import JointTrajectoryPoint

PAN_TICK = math.radians(300) / 1024
TILT_TICK = math.radians(360) / 4096


def place_of(state, joint):
    return state.position[state.name.index(joint)]


class Servos(unittest.TestCase):
    def setUp(self):
        self.states = Collector("/joint_states", JointState)
        self.client = actionlib.SimpleActionClient("/head/follow_joint_trajectory", FollowJointTrajectoryAction)
        self.client.wait_for_server()

    def tearDown(self):
        self.states.close()

    def arrive(self, joint, angle, tick):
        self.states.messages.clear()
        return self.states.wait_for(lambda m: abs(place_of(m, joint) - angle) <= tick / 2 + 1e-9, "%s at %s" % (joint, angle))

    def publisher(self, joint):
        publisher = rospy.Publisher("/%s/command" % joint, Float64, queue_size=1, latch=True)
        self.addCleanup(publisher.unregister)
        return publisher

    def goal(self, *points, joints=("pan", "tilt")):
        goal = FollowJointTrajectoryGoal()
        goal.trajectory.joint_names = joints
        goal.trajectory.points = [JointTrajectoryPoint(positions=places, time_from_start=rospy.Duration(time)) for time, places in points]
        return goal

    def test_command_at_limited_speed(self):
        self.publisher("pan").publish(-1.0)
        self.arrive("pan", -1.0, PAN_TICK)
        start = self.states.messages[-1].header.stamp
        self.publisher("pan").publish(1.0)
        state = self.arrive("pan", 1.0, PAN_TICK)
        self.assertGreater((state.header.stamp - start).to_sec(), 2.0 / math.radians(60) - 0.3)
        ticks = place_of(state, "pan") / PAN_TICK
        self.assertAlmostEqual(ticks, round(ticks), places=6)

    def test_no_number_is_ignored(self):
        pan = self.publisher("pan")
        pan.publish(float("nan"))
        pan.publish(0.5)
        self.arrive("pan", 0.5, PAN_TICK)

    def test_range_ends_the_motion(self):
        self.publisher("tilt").publish(9.0)
        self.arrive("tilt", math.pi, 2 * TILT_TICK)
        self.publisher("tilt").publish(0.0)
        self.arrive("tilt", 0.0, TILT_TICK)

    def test_disabled_servo_takes_no_commands(self):
        self.publisher("tilt").publish(0.0)
        self.arrive("tilt", 0.0, TILT_TICK)
        rospy.wait_for_service("/tilt/enable", 60)
        enable = rospy.ServiceProxy("/tilt/enable", Enable)
        self.assertFalse(enable(False).state)
        self.publisher("tilt").publish(0.7)
        self.publisher("pan").publish(-0.2)
        self.assertAlmostEqual(place_of(self.arrive("pan", -0.2, PAN_TICK), "tilt"), 0.0, places=6)
        self.assertTrue(enable(True).state)
        rospy.ServiceProxy("/servos/relax_all", Relax)()
        self.publisher("tilt").publish(0.3)
        self.arrive("tilt", 0.3, TILT_TICK)

    def test_trajectory(self):
        self.assertEqual(
            self.client.send_goal_and_wait(self.goal((1.0, (0.4, -0.4)), (2.0, (-0.3, 0.6))), rospy.Duration(300)), GoalStatus.SUCCEEDED
        )
        state = self.arrive("tilt", 0.6, TILT_TICK)
        self.assertAlmostEqual(place_of(state, "pan"), -0.3, delta=PAN_TICK)
        most = max(place_of(m, "pan") for m in self.states.messages)
        self.assertLessEqual(most, 0.4 + PAN_TICK)

    def test_bad_goals_are_refused(self):
        nan, far = float("nan"), 1e308
        for goal in (
            self.goal((1.0, (0.1,)), joints=("pan",)),
            self.goal(),
            self.goal((1.0, (0.1,))),
            self.goal((1.0, (nan, 0.1))),
            self.goal((1.0, (0.1, far))),
            self.goal((-1e9, (0.1, 0.1))),
            self.goal((1.0, (0.1, 0.1)), (0.5, (0.2, 0.2))),
        ):
            self.assertEqual(self.client.send_goal_and_wait(goal, rospy.Duration(300)), GoalStatus.ABORTED)

    def test_cancel(self):
        self.client.send_goal(self.goal((500.0, (1.0, 1.0))))
        while self.client.get_state() == GoalStatus.PENDING:
            rospy.sleep(0.1)
        self.client.cancel_goal()
        self.assertTrue(self.client.wait_for_result(rospy.Duration(300)))
        self.assertEqual(self.client.get_state(), GoalStatus.PREEMPTED)


if __name__ == "__main__":
    rospy.init_node("servos_rostest")
    clock = RunningClock()
    rostest.rosrun("arbotix_python", "servos", Servos)
    clock.stop()
