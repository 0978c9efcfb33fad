#!/usr/bin/env python3
"""Behaviour of the trajectory controllers over their topics, action and service."""

import math

import rospy
from actionlib_msgs.msg import GoalStatus
from control_msgs.msg import FollowJointTrajectoryResult as Result
from control_test_robots import client
from rosgraph_msgs.msg import Log
from trajectory_client import EPS, Goal, TrajectoryCase
from trajectory_msgs.msg import JointTrajectory

REST = [0.0, 0.0]
TARGET = [0.5, -0.4]
LONG = (8.0, [2.0, 2.0], [0.0, 0.0])  # under way still when a loaded machine comes to stop it


class Behaviour:
    """What all variants have in common; mixed into one TestCase per variant."""

    def test_state_topic_consistency(self):
        self.publish((0.3, TARGET, REST))
        state = self.state.next()
        self.assertEqual(state.joint_names, list(self.joints))
        self.assertGreater(state.header.stamp.to_sec(), 0.0)
        for point in (state.desired, state.actual, state.error):
            self.assertEqual((len(point.positions), len(point.velocities), len(point.effort)), (2, 2, 0))
        self.assertEqual([len(p.accelerations) for p in (state.desired, state.actual, state.error)], [2, 0, 0])

    def test_query_state_consistency(self):
        self.publish((0.3, TARGET, REST))
        self.wait_still_at(TARGET)
        answer = self.query_state(rospy.Time.now())
        self.assertEqual(list(answer.name), list(self.joints))
        self.assertStates(answer.position, TARGET)
        self.assertStates(answer.velocity, REST)
        self.assertStates(answer.acceleration, REST)

    def test_query_state_sees_the_future_and_refuses_the_past(self):
        start = rospy.get_time() + 5.0
        self.publish((0.0, REST, REST), (1.0, TARGET, REST), stamp=start)
        end = rospy.Time.from_sec(start + 1.5)
        client.wait_until(lambda: abs(self.query_state(end).position[0] - TARGET[0]) < 1e-6, "the trajectory to be known")
        self.assertStates(self.query_state(rospy.Time.from_sec(start + 0.5)).position, [0.25, -0.2])
        self.assertRaises(rospy.ServiceException, self.query_state, rospy.Time(0, 1))

    def test_invalid_goals_are_rejected_and_say_why(self):
        j1, j2 = self.joints
        point = (0.5, TARGET)
        for code, text, goal in (
            (Result.INVALID_JOINTS, f"missing: {j2}", self.send((0.5, [0.5]), joints=[j1])),
            (Result.INVALID_JOINTS, "unknown: elbow", self.send(point, joints=[j1, "elbow"])),
            (Result.INVALID_GOAL, "0 positions for 2 joints", self.send((0.5, []))),
            (Result.INVALID_GOAL, "1 positions for 2 joints", self.send((0.5, [0.5]))),
            (Result.INVALID_GOAL, "1 velocities for 2 joints", self.send((0.5, TARGET, [0.0]))),
            (Result.INVALID_GOAL, "strictly increasing", self.send(point, point)),
            (Result.INVALID_GOAL, "not finite", self.send((0.5, [math.nan, 0.0]))),
            (Result.INVALID_GOAL, "Dropping all 1 trajectory points", self.send((0.0, TARGET))),
            (Result.INVALID_JOINTS, "joint_names is empty", Goal(self.action, JointTrajectory())),
        ):
            status, got, message = goal.finish()
            self.assertEqual((status, got), (GoalStatus.REJECTED, code), message)
            self.assertIn(text, message)
        self.assertStates(self.state.next().desired.positions, REST)

    def test_topic_trajectory(self):
        self.publish((0.2, [0.2, -0.1], [1.0, -1.0]), (0.5, TARGET, REST))
        self.wait_still_at(TARGET)
        self.assertStates(self.state.last.error.positions, REST)
        self.assertStates(self.state.last.error.velocities, REST)

    def test_action_trajectory_succeeds_with_feedback(self):
        feedback = self.listen_to_feedback()
        goal = self.send((0.2, [0.2, -0.1], [1.0, -1.0]), (0.5, TARGET, REST))
        self.assertEqual(goal.finish(), (GoalStatus.SUCCEEDED, Result.SUCCESSFUL, ""))
        self.assertStates(self.state.next().actual.positions, TARGET)
        client.wait_until(lambda: len(feedback.messages) >= 5, "feedback of 20 Hz for half a second")
        self.assertEqual(feedback.last.feedback.joint_names, list(self.joints))
        self.assertEqual(len(feedback.last.feedback.desired.accelerations), 2)

    def test_joint_order_of_the_message_is_respected(self):
        self.send((0.3, [-0.4, 0.5], REST), joints=reversed(self.joints)).finish()
        self.assertStates(self.state.next().actual.positions, TARGET)

    def test_continuous_joints_take_the_short_way(self):
        self.assertEqual(self.send((0.5, [4.5 * math.pi, -1.75 * math.pi], REST)).finish()[0], GoalStatus.SUCCEEDED)
        self.assertStates(self.state.next().actual.positions, [0.5 * math.pi, 0.25 * math.pi])

    def test_half_a_turn_goes_in_the_commanded_direction(self):
        self.send((0.5, [math.pi, -math.pi], REST)).finish()
        self.assertStates(self.state.next().actual.positions, [math.pi, -math.pi])
        self.send((0.5, [-math.pi, math.pi], REST)).finish()
        self.assertStates(self.state.next().actual.positions, [math.pi, -math.pi])  # same angles: no motion
        self.send((0.5, REST, REST)).finish()
        self.assertStates(self.state.next().actual.positions, REST)

    def test_topic_replaces_topic(self):
        self.publish((2.0, [2.0, 2.0], REST))
        self.wait_moved()
        self.publish((0.3, TARGET, REST))
        self.wait_still_at(TARGET)

    def test_action_replaces_action(self):
        first = self.send((2.0, [2.0, 2.0], REST))
        self.wait_moved()
        second = self.send((0.3, TARGET, REST))
        self.assertEqual(first.finish()[:2], (GoalStatus.PREEMPTED, 0))
        self.assertEqual(second.finish()[0], GoalStatus.SUCCEEDED)
        self.assertStates(self.state.next().actual.positions, TARGET)

    def test_action_replaces_topic(self):
        self.publish((2.0, [2.0, 2.0], REST))
        self.wait_moved()
        self.assertEqual(self.send((0.3, TARGET, REST)).finish()[0], GoalStatus.SUCCEEDED)
        self.assertStates(self.state.next().actual.positions, TARGET)

    def test_topic_replaces_action(self):
        goal = self.send((2.0, [2.0, 2.0], REST))
        self.wait_moved()
        self.publish((0.3, TARGET, REST))
        self.assertEqual(goal.finish()[0], GoalStatus.PREEMPTED)
        self.wait_still_at(TARGET)

    def test_rejected_goal_leaves_the_active_one_alone(self):
        goal = self.send((1.0, TARGET, REST))
        self.wait_moved()
        self.assertEqual(self.send((0.5, [0.0])).finish()[0], GoalStatus.REJECTED)
        self.publish((0.5, [0.0]))
        self.assertEqual(goal.finish()[0], GoalStatus.SUCCEEDED)
        self.assertStates(self.state.next().actual.positions, TARGET)

    def assertStoppedOnTheWay(self):
        for position in self.wait_at_rest():
            self.assertTrue(0.05 < position < 1.9, position)

    def test_empty_topic_cancels_topic(self):
        self.publish(LONG)
        self.wait_moved()
        self.publish()
        self.assertStoppedOnTheWay()

    def test_empty_topic_cancels_action(self):
        goal = self.send((2.0, [2.0, 2.0], REST))
        self.wait_moved()
        self.publish()
        self.assertEqual(goal.finish()[0], GoalStatus.PREEMPTED)
        self.assertStoppedOnTheWay()

    def test_empty_action_cancels_topic(self):
        self.publish((2.0, [2.0, 2.0], REST))
        self.wait_moved()
        self.assertEqual(self.send().finish()[0], GoalStatus.SUCCEEDED)
        self.assertStoppedOnTheWay()

    def test_empty_action_cancels_action(self):
        first = self.send((2.0, [2.0, 2.0], REST))
        self.wait_moved()
        second = self.send()
        self.assertEqual(first.finish()[0], GoalStatus.PREEMPTED)
        self.assertEqual(second.finish()[0], GoalStatus.SUCCEEDED)
        self.assertStoppedOnTheWay()

    def test_cancelled_goal_stops(self):
        goal = self.send(LONG)
        self.wait_moved()
        goal.cancel()
        self.assertEqual(goal.finish()[0], GoalStatus.PREEMPTED)
        self.assertStoppedOnTheWay()

    def test_stopping_the_controller_preempts_and_commands_are_refused_then(self):
        goal = self.send(LONG)
        self.wait_moved()
        client.switch(stop=[self.controller])
        self.assertEqual(goal.finish()[0], GoalStatus.PREEMPTED)
        status, code, text = self.send((0.5, TARGET, REST)).finish()
        self.assertEqual((status, code), (GoalStatus.REJECTED, Result.INVALID_GOAL))
        self.assertIn("not running", text)
        self.assertRaises(rospy.ServiceException, self.query_state, rospy.Time.now())
        client.switch([self.controller])
        self.assertStoppedOnTheWay()

    def test_old_topic_trajectory_is_ignored_with_a_warning(self):
        log = client.Topic("/rosout", Log)
        log.clear()  # latched: the last line of an earlier test comes first
        self.publish((1.0, TARGET, REST))
        self.wait_moved()

        def warned():  # as often as it takes until the log is connected
            self.publish((0.1, [1.0, 1.0], REST), (0.2, [2.0, 2.0], REST), stamp=rospy.get_time() - 0.5)
            return [line for line in log.messages if "Dropping all 2" in line.msg]

        lines = client.wait_until(warned, "a line in the log")
        log.close()
        self.assertEqual(lines[0].level, Log.WARN)
        self.wait_still_at(TARGET)

    def test_old_action_goals_are_rejected_with_their_age(self):
        goal = self.send((1.0, TARGET, REST))
        self.wait_moved()
        for points in ([(0.1, [1.0, 1.0])], [(0.1, [1.0, 1.0]), (0.2, [2.0, 2.0])]):
            status, code, text = self.send(*points, stamp=rospy.get_time() - 0.5).finish()
            self.assertEqual((status, code), (GoalStatus.REJECTED, Result.INVALID_GOAL))
            self.assertRegex(text, rf"Dropping all {len(points)} trajectory points.* \d+\.\d+s in the past")
        self.assertEqual(goal.finish()[0], GoalStatus.SUCCEEDED)
        self.assertStates(self.state.next().actual.positions, TARGET)

    def test_partly_old_action_goal_does_the_rest(self):
        goal = self.send((-0.5, [1.0, 1.0], REST), (0.5, TARGET, REST))
        self.assertEqual(goal.finish()[0], GoalStatus.SUCCEEDED)
        self.assertStates(self.state.next().actual.positions, TARGET)
        self.assertLess(max(state.desired.positions[0] for state in self.state.messages), 0.6)

    def test_path_tolerance_violation_names_joint_error_and_tolerance(self):
        for joint in self.joints:
            with self.subTest(joint):
                self.setUp()
                client.set_faults(**{joint: {"smoothing": 0.99}})
                goal = self.send((0.5, [1.0, 1.0], REST), path=[(name, 0.05, 0, 0) for name in self.joints])
                status, code, text = goal.finish()
                self.assertEqual((status, code), (GoalStatus.ABORTED, Result.PATH_TOLERANCE_VIOLATED))
                self.assertRegex(text, rf"^{joint} path error -?\d\.\d{{6}}: position error .* over the tolerance 0.05")
                self.assertHoldsWhereItIs(below=0.9)

    def assertHoldsWhereItIs(self, below):
        """After an abort, the desired state is where the joints are, and stays there."""
        self.wait_at_rest()
        state = self.state.next()
        self.assertStates(state.error.positions, REST)
        self.assertLess(min(state.desired.positions), below)

    def test_good_goals_after_one_out_of_reach(self):
        tolerances = dict(path=[(name, 0.05, 0, 0) for name in self.joints], goal=[(name, 0.05, 0, 0) for name in self.joints])
        client.set_faults(**{self.joints[0]: {"upper_bound": 0.5}})
        self.assertEqual(self.send((1.0, [2.8, 0.5], REST), **tolerances).finish()[1], Result.PATH_TOLERANCE_VIOLATED)
        self.assertHoldsWhereItIs(below=0.52)
        self.assertEqual(self.send((0.5, [0.2, -0.1], REST), **tolerances).finish(), (GoalStatus.SUCCEEDED, 0, ""))
        every = dict(path=[(name, -1.0, -1.0, -1.0) for name in self.joints], goal=tolerances["goal"])
        self.assertEqual(self.send((0.5, [2.8, 0.5], REST), **every).finish()[1], Result.GOAL_TOLERANCE_VIOLATED)
        self.assertHoldsWhereItIs(below=0.52)
        self.assertEqual(self.send((0.5, [0.2, -0.1], REST), **tolerances).finish(), (GoalStatus.SUCCEEDED, 0, ""))

    def test_a_goal_right_after_an_abort_begins_at_rest(self):
        """Not with the speed that the joints were to have, which would carry them far off on a long way."""
        client.set_faults(**{self.joints[0]: {"upper_bound": 0.3}})
        tolerances = dict(path=[(name, 0.05, 0, 0) for name in self.joints])
        status = self.send((0.5, [3.0, 3.0], REST), **tolerances).finish()[1]
        self.assertEqual(status, Result.PATH_TOLERANCE_VIOLATED)
        self.state.clear()
        self.assertEqual(self.send((4.0, [0.2, 0.1], REST), **tolerances).finish(), (GoalStatus.SUCCEEDED, 0, ""))
        self.assertLess(max(state.desired.positions[1] for state in self.state.messages), 0.6)

    def test_goal_tolerance_violation_names_joint_error_and_tolerance(self):
        for joint in self.joints:
            with self.subTest(joint):
                self.setUp()
                client.set_faults(**{joint: {"upper_bound": 0.5}})
                goal = self.send((0.3, [1.0, 1.0], REST), goal=[(name, 0.05, 0, 0) for name in self.joints])
                status, code, text = goal.finish()
                self.assertEqual((status, code), (GoalStatus.ABORTED, Result.GOAL_TOLERANCE_VIOLATED))
                self.assertRegex(text, rf"^{joint} goal error 0.500000: position error 0.5 is over the tolerance 0.05")

    def test_goal_time_gives_a_late_joint_its_time(self):
        late = {self.joints[0]: {"smoothing": 0.93}}
        client.set_faults(**late)
        tolerances = dict(goal=[(name, 0.005, 0, 0) for name in self.joints])
        self.assertEqual(self.send((0.1, [1.0, 1.0]), goal_time=-1.0, **tolerances).finish()[1], Result.GOAL_TOLERANCE_VIOLATED)
        self.setUp()
        client.set_faults(**late)
        self.assertEqual(self.send((0.1, [1.0, 1.0]), goal_time=5.0, **tolerances).finish()[0], GoalStatus.SUCCEEDED)

    def test_negative_tolerances_allow_anything(self):
        client.set_faults(**{self.joints[0]: {"upper_bound": 0.2}})
        every = [(name, -1.0, -1.0, -1.0) for name in self.joints]
        self.assertEqual(self.send((0.3, [1.0, 1.0], REST), path=every, goal=every).finish()[0], GoalStatus.SUCCEEDED)


class PositionController(Behaviour, TrajectoryCase):
    controller = "position"
    joints = ("p1", "p2")

    def test_stop_without_ramp_goes_to_the_measured_position(self):
        client.set_faults(p1={"delay": 5})
        self.publish((2.0, [2.0, 2.0]))
        self.wait_moved(0.2)
        self.publish()
        client.wait_until(lambda: self.state.next().desired.velocities[0] == 0.0, "the stop")
        positions = [state.desired.positions[0] for state in self.state.messages]
        self.assertAlmostEqual(max(positions) - positions[-1], 0.06, delta=0.0201)  # 1 m/s, six cycles of 10 ms behind


class RampController(Behaviour, TrajectoryCase):
    controller = "ramp"
    joints = ("s1", "s2")

    def test_stop_ramp_starts_from_the_desired_state_and_never_turns_back(self):
        client.set_faults(s1={"delay": 1}, s2={"delay": 1})
        goal = self.send((2.0, [2.0, 2.0]))
        self.wait_moved(0.2)
        self.publish()
        self.assertEqual(goal.finish()[0], GoalStatus.PREEMPTED)
        self.wait_at_rest()
        for state in self.state.messages:
            self.assertGreaterEqual(min(*state.actual.velocities, *state.desired.velocities), -1e-9)
        moving = [s.desired.positions[0] for s in self.state.messages if abs(s.desired.velocities[0] - 1.0) < 1e-9]
        self.assertAlmostEqual(self.positions()[0] - moving[-1], 0.625 * 1.0 * 0.1, delta=0.0101)


class VelocityController(Behaviour, TrajectoryCase):
    controller = "velocity"
    joints = ("v1", "v2")

    def test_velocity_feed_forward_is_what_keeps_up(self):
        """Without it, the joint lags by velocity / p = 0.1 rad."""

        def move():
            return self.send(
                (0.5, [1.0, 1.0], [2.0, 2.0]), (1.0, [2.0, 2.0], REST), path=[(name, 0.08, 0, 0) for name in self.joints]
            ).finish()

        self.assertEqual(move()[0], GoalStatus.SUCCEEDED)
        self.reload_with(0.0)
        try:
            self.assertEqual(move()[1], Result.PATH_TOLERANCE_VIOLATED)
        finally:
            self.reload_with(1.0)

    def reload_with(self, feed_forward):
        for joint in self.joints:
            rospy.set_param(f"/{self.controller}/velocity_ff/{joint}", feed_forward)
        type(self).tearDownClass()
        type(self).setUpClass()
        self.setUp()


del TrajectoryCase  # imported, not a test of its own

if __name__ == "__main__":
    import rostest

    rospy.init_node("trajectories")
    rostest.rosrun("joint_trajectory_controller", "trajectories", "__main__")
