#!/usr/bin/env python3
"""The trajectory controllers in C++ do what those in Python do, and can be derived from."""

import rospy
import trajectories_rostest as behaviour
import variants_rostest as variants
from actionlib_msgs.msg import GoalStatus
from control_msgs.msg import FollowJointTrajectoryResult as Result
from control_test_robots import client
from trajectory_client import TrajectoryCase

REST = [0.0, 0.0]


class Position(behaviour.PositionController):
    controller = "compiled_position"


class Ramp(behaviour.RampController):
    controller = "compiled_ramp"


class Velocity(behaviour.VelocityController):
    controller = "compiled_velocity"


class PartialGoals(variants.PartialGoals):
    controller = "compiled_partial"


class WrappedEncoders(variants.WrappedEncoders):
    controller = "compiled_wrapping"


class Effort(variants.EffortController):
    controller = "compiled_effort"


class PosVel(variants.PosVel):
    controller = "compiled_pos_vel"


class PosVelAcc(variants.PosVelAcc):
    controller = "compiled_pos_vel_acc"


class Reset(variants.Reset):
    controller = "compiled_ramp"


class Refused(TrajectoryCase):
    """Parameters with which the controller must not load; none of them may take the manager down."""

    controller = "compiled_position"
    joints = ("p1", "p2")

    def test_wrong_parameters(self):
        for name in ("no_joints", "unknown_joint", "not_in_hardware", "no_gains", "no_rate", "repeated", "endless_feed_forward"):
            with self.subTest(name):
                self.assertFalse(client.loads(f"compiled_{name}"))
        self.assertEqual(self.send((0.3, [0.5, 0.1], REST)).finish()[0], GoalStatus.SUCCEEDED)


class Scaled(TrajectoryCase):
    """A derived class with an update of its own."""

    controller = "compiled_scaled"
    joints = ("p1", "p2")

    def test_takes_twice_the_time_and_the_timer_tells_of_the_end(self):
        begin = rospy.get_time()
        goal = self.send((0.5, [0.5, -0.4], REST))
        self.assertEqual(goal.finish(), (GoalStatus.SUCCEEDED, Result.SUCCESSFUL, ""))
        self.assertGreaterEqual(rospy.get_time() - begin, 1.0)
        self.assertStates(self.state.next().actual.positions, [0.5, -0.4])

    def test_a_cancelled_goal_stops(self):
        goal = self.send((2.0, [2.0, 2.0], REST))
        self.wait_moved()
        goal.cancel()
        self.assertEqual(goal.finish()[0], GoalStatus.PREEMPTED)
        self.assertLess(max(self.wait_at_rest()), 1.9)


class Guarded(TrajectoryCase):
    """A derived class that adds something to each update, and takes no commands from the topic."""

    controller = "compiled_guarded"
    joints = ("p1", "p2")

    def setUp(self):
        super().setUp()
        client.wait_until(lambda: self.command.get_num_connections() > 0, "the subscriber")

    def test_what_is_too_fast_is_stopped_where_it_is(self):
        self.assertEqual(self.send((1.0, [1.0, 1.0], REST)).finish()[0], GoalStatus.SUCCEEDED)
        self.setUp()
        goal = self.send((0.08, [3.0, 1.0], REST))  # 56 rad/s half way
        self.assertEqual(goal.finish()[0], GoalStatus.PREEMPTED)
        self.assertTrue(0.2 < self.wait_at_rest()[0] < 1.5, self.positions())

    def test_the_topic_moves_nothing(self):
        self.publish((0.1, [1.0, 1.0], REST))
        self.assertEqual(self.send((0.5, [0.2, 0.1], REST)).finish()[0], GoalStatus.SUCCEEDED)
        self.assertStates(self.state.next().actual.positions, [0.2, 0.1])


del TrajectoryCase  # imported, not a test of its own

if __name__ == "__main__":
    import rostest

    rospy.init_node("compiled_trajectories")
    rostest.rosrun("joint_trajectory_controller", "compiled_trajectories", "__main__")
