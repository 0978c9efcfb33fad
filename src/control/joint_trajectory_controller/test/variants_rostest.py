#!/usr/bin/env python3
"""What only some of the trajectory controllers do: partial goals, wrapped encoders, other outputs; what is refused."""

import math

import rospy
from actionlib_msgs.msg import GoalStatus
from control_msgs.msg import FollowJointTrajectoryResult as Result
from control_test_robots import client
from trajectory_client import EPS, TrajectoryCase

REST = [0.0, 0.0]


class PartialGoals(TrajectoryCase):
    controller = "partial"
    joints = ("p1", "p2")

    def test_topic_moves_the_named_joint_alone(self):
        self.publish((0.3, [0.5], [0.0]), joints=["p2"])
        self.wait_still_at([0.0, 0.5])

    def test_action_moves_the_named_joint_alone(self):
        self.assertEqual(self.send((0.3, [0.5], [0.0]), joints=["p1"]).finish()[0], GoalStatus.SUCCEEDED)
        self.assertStates(self.state.next().actual.positions, [0.5, 0.0])

    def test_unknown_and_missing_names_are_still_refused(self):
        self.assertEqual(self.send((0.3, [0.5]), joints=["elbow"]).finish()[1], Result.INVALID_JOINTS)
        self.assertEqual(self.send((0.3, [0.5], [0.0]), joints=["p1", "p2"]).finish()[1], Result.INVALID_GOAL)

    def test_values_of_joints_that_are_not_named_are_left_out(self):
        self.assertEqual(self.send((0.3, [0.5, 0.9], REST), joints=["p2"]).finish()[0], GoalStatus.SUCCEEDED)
        self.assertStates(self.state.next().actual.positions, [0.0, 0.5])

    def test_joint_left_out_goes_on_with_its_motion(self):
        self.publish((1.0, [1.0, 1.0], REST))
        self.wait_moved()
        self.publish((0.3, [0.5], [0.0]), joints=["p1"])
        self.wait_still_at([0.5, 1.0])

    def test_partial_goal_replaces_a_whole_one_and_waits_for_the_other_joint(self):
        whole = self.send((1.0, [1.0, 1.0], REST))
        self.wait_moved()
        partial = self.send((0.2, [0.5], [0.0]), joints=["p1"])
        self.assertEqual(whole.finish()[0], GoalStatus.PREEMPTED)
        self.assertEqual(partial.finish()[0], GoalStatus.SUCCEEDED)
        self.assertStates(self.state.next().actual.positions, [0.5, 1.0])

    def test_partial_topic_replaces_an_action(self):
        whole = self.send((1.0, [1.0, 1.0], REST))
        self.wait_moved()
        self.publish((0.2, [0.5], [0.0]), joints=["p2"])
        self.assertEqual(whole.finish()[0], GoalStatus.PREEMPTED)
        self.wait_still_at([1.0, 0.5])

    def test_old_partial_trajectory_is_ignored(self):
        goal = self.send((0.6, [1.0, 1.0], REST))
        self.wait_moved()
        old = self.send((0.1, [0.0]), joints=["p1"], stamp=rospy.get_time() - 0.5)
        self.assertEqual(old.finish()[0], GoalStatus.REJECTED)
        self.assertEqual(goal.finish()[0], GoalStatus.SUCCEEDED)
        self.assertStates(self.state.next().actual.positions, [1.0, 1.0])

    def test_goal_stamped_in_the_future_is_active_at_once_and_moves_later(self):
        start = rospy.get_time() + 5.0
        goal = self.send((0.0, [0.0], [0.0]), (0.3, [0.5], [0.0]), joints=["p1"], stamp=start).wait_active()
        self.assertLess(rospy.get_time(), start)
        self.assertEqual(goal.finish()[0], GoalStatus.SUCCEEDED)
        self.assertGreaterEqual(rospy.get_time(), start + 0.3)

        def moving():
            return [s.header.stamp.to_sec() for s in self.state.messages if s.desired.positions[0] > 0.001]

        client.wait_until(moving, "states of the motion, which come on a topic of their own", 10)
        self.assertGreaterEqual(moving()[0], start - 0.011)
        self.assertStates(self.state.next().actual.positions, [0.5, 0.0])


class WrappedEncoders(TrajectoryCase):
    controller = "wrapping"
    joints = ("w1", "w2")

    def faults(self):
        return {"w1": {"wrap": True}, "w2": {"wrap": True}}

    def wait_still_at(self, positions, timeout=30.0):
        """The controller may have started anywhere: compare angles."""

        def there():
            state = self.state.next()
            return all(
                abs(math.remainder(a - p, 2 * math.pi)) < EPS and abs(v) < EPS
                for p, a, v in zip(positions, state.actual.positions, state.actual.velocities)
            )

        client.wait_until(there, f"joints to rest at {positions}", timeout)

    def test_position_error_does_not_jump_where_the_encoder_does(self):
        goal = self.send((1.0, [3.0, -3.0], [1.0, -1.0]), (1.5, [3.5, -3.5], [1.0, -1.0]), (2.0, [4.0, -4.0], REST))
        self.assertEqual(goal.finish()[0], GoalStatus.SUCCEEDED)
        reported = [state.actual.positions[0] for state in self.state.messages]
        self.assertLess(min(reported), -2.0)  # it did wrap
        self.assertLess(max(abs(e) for s in self.state.messages for e in s.error.positions), 0.7)


class EffortController(TrajectoryCase):
    controller = "effort"
    joints = ("e1", "e2")
    home = (0.0, 4.0)

    def test_reaches_its_goal_through_torques(self):
        self.assertEqual(self.send((1.0, [0.5, 4.5], REST)).finish()[0], GoalStatus.SUCCEEDED)
        client.sim_sleep(1.0)
        self.assertStates(self.state.next().actual.positions, [0.5, 4.5])

    def test_prismatic_error_is_not_taken_for_an_angle(self):
        client.set_faults(e2={"upper_bound": 4.0})
        goal = self.send((1.0, [0.0, 8.0], REST))
        status, code, text = goal.finish()
        self.assertEqual((status, code), (GoalStatus.ABORTED, Result.GOAL_TOLERANCE_VIOLATED))
        self.assertRegex(text, r"^e2 goal error 4\.0")  # upstream's wrapped error would be -2.28


class PosVelAcc(TrajectoryCase):
    controller = "pos_vel_acc"
    joints = ("a1", "a2")

    def test_commands_all_three(self):
        goal = self.send((0.5, [0.5, 0.1], REST, REST))
        self.assertEqual(goal.finish()[0], GoalStatus.SUCCEEDED)
        self.assertStates(self.state.next().actual.positions, [0.5, 0.1])
        self.assertGreater(max(state.actual.velocities[0] for state in self.state.messages), 1.5)

    def test_hardware_without_a_position_commands_nothing_and_refuses_goals(self):
        client.set_faults(a1={"nan": True})
        client.switch(stop=[self.controller])
        client.switch([self.controller])
        status, _, text = self.send((0.3, [0.5, 0.1], REST)).finish()
        self.assertEqual(status, GoalStatus.REJECTED)
        self.assertIn("has not reported where the joints are", text)
        client.set_faults()
        self.state.next()
        self.assertEqual(self.send((0.3, [0.5, 0.1], REST)).finish()[0], GoalStatus.SUCCEEDED)

    def test_position_lost_on_the_way_aborts(self):
        goal = self.send((1.0, [0.5, 0.1], REST), path=[("a1", 0.1, 0, 0)])
        self.wait_moved()
        client.set_faults(a1={"nan": True})
        status, code, text = goal.finish()
        self.assertEqual((status, code), (GoalStatus.ABORTED, Result.PATH_TOLERANCE_VIOLATED))
        self.assertIn("a1 path error nan", text)


class Reset(TrajectoryCase):
    controller = "ramp"
    joints = ("s1", "s2")

    def test_goals_are_reached_after_time_began_anew(self):
        self.assertEqual(self.send((0.5, [0.5, 0.1], REST)).finish()[0], GoalStatus.SUCCEEDED)
        client.sim_sleep(2.0)
        client.reset()
        self.state.clear()
        feedback = self.listen_to_feedback()
        goal = self.send((0.5, [-0.5, 0.2], REST), stamp=rospy.get_time() + 1.0)
        self.assertEqual(goal.finish()[0], GoalStatus.SUCCEEDED)
        self.assertStates(self.state.next().actual.positions, [-0.5, 0.2])
        client.wait_until(lambda: len(feedback.messages) >= 5, "feedback")


class PosVel(TrajectoryCase):
    controller = "pos_vel"
    joints = ("d1", "d2")

    def test_reaches_its_goal(self):
        self.assertEqual(self.send((0.5, [0.5, 0.1], REST)).finish()[0], GoalStatus.SUCCEEDED)
        self.assertStates(self.state.next().actual.positions, [0.5, 0.1])


class Refused(TrajectoryCase):
    """Parameters with which the controller must not load; none of them may take the manager down."""

    controller = "position"
    joints = ("p1", "p2")

    def test_wrong_parameters(self):
        for name in (
            "no_joints",
            "unknown_joint",
            "not_in_hardware",
            "no_gains",
            "no_rate",
            "repeated",
            "endless_gain",
            "endless_feed_forward",
        ):
            with self.subTest(name):
                self.assertFalse(client.loads(name))
        self.assertEqual(self.send((0.3, [0.5, 0.1], REST)).finish()[0], GoalStatus.SUCCEEDED)


del TrajectoryCase  # imported, not a test of its own

if __name__ == "__main__":
    import rostest

    rospy.init_node("trajectory_variants")
    rostest.rosrun("joint_trajectory_controller", "trajectory_variants", "__main__")
