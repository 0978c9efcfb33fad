"""What the trajectory tests share: one controller with everything a client of it needs."""

import math

import actionlib
import rospy
import test_support
from actionlib_msgs.msg import GoalStatus
from control_msgs.msg import (
    FollowJointTrajectoryAction,
    FollowJointTrajectoryActionFeedback,
    FollowJointTrajectoryGoal,
    JointTolerance,
    JointTrajectoryControllerState,
)
from control_msgs.srv import QueryTrajectoryState
from control_test_robots import client
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

EPS = 0.01


def trajectory(joints, *points, stamp=0.0):
    """Points are (time, positions[, velocities[, accelerations]])."""
    message = JointTrajectory(joint_names=list(joints))
    message.header.stamp = rospy.Time.from_sec(stamp)
    for time, *values in points:
        message.points.append(
            JointTrajectoryPoint(
                **dict(zip(("positions", "velocities", "accelerations"), values)), time_from_start=rospy.Duration.from_sec(time)
            )
        )
    return message


class Goal:
    """A goal sent to the action, followed through its life."""

    def __init__(self, action_client, message, path=(), goal=(), goal_time=0.0):
        self._handle = action_client.send_goal(
            FollowJointTrajectoryGoal(
                message, [JointTolerance(*t) for t in path], [JointTolerance(*t) for t in goal], rospy.Duration.from_sec(goal_time)
            )
        )

    @property
    def status(self):
        return self._handle.get_goal_status()

    def wait_active(self):
        client.wait_until(lambda: self.status == GoalStatus.ACTIVE, "the goal to become active")
        return self

    def finish(self, timeout=30.0):
        """(status, error code, text) at the end."""
        client.wait_until(lambda: self._handle.get_comm_state() == actionlib.CommState.DONE, "the goal to end", timeout)
        result = self._handle.get_result()
        return self._handle.get_terminal_state(), result.error_code, result.error_string

    def cancel(self):
        self._handle.cancel()


class TrajectoryCase(test_support.TestCase):
    """Tests of ``controller``, which moves ``joints``; each test starts with them at rest at 0."""

    controller = ""
    joints = ()
    home = (0.0, 0.0)

    @classmethod
    def setUpClass(cls):
        client.load(cls.controller)
        client.switch([cls.controller])
        cls.state = client.Topic(f"/{cls.controller}/state", JointTrajectoryControllerState)
        cls.command = client.publisher(f"/{cls.controller}/command", JointTrajectory)
        cls.action = actionlib.ActionClient(f"/{cls.controller}/follow_joint_trajectory", FollowJointTrajectoryAction)
        cls.action.wait_for_server()
        cls.query_state = rospy.ServiceProxy(f"/{cls.controller}/query_state", QueryTrajectoryState)
        cls.state.next()

    @classmethod
    def tearDownClass(cls):
        # a publisher that outlives the controller goes on counting its connection to the old subscriber
        cls.command.unregister()
        cls.action.stop()
        cls.state.close()
        client.switch(stop=[cls.controller])
        client.unload(cls.controller)

    def setUp(self):
        client.set_faults(**self.faults())
        # a new start of the controller forgets motions; then go home, by steps a continuous joint cannot shorten
        if client.controller_state(self.controller) == "running":
            client.switch(stop=[self.controller])
        client.switch([self.controller])
        # as a goal, because its end tells that it has come: a topic may come later than the first goal of the test
        self.send((0.1, list(self.home), [0.0] * len(self.joints))).finish()
        self.wait_still_at(self.home)
        self.state.clear()

    def faults(self):
        return {}

    def publish(self, *points, joints=None, stamp=0.0):
        self.command.publish(trajectory(joints or self.joints, *points, stamp=stamp))

    def send(self, *points, joints=None, stamp=0.0, **tolerances):
        return Goal(self.action, trajectory(joints or self.joints, *points, stamp=stamp), **tolerances)

    def listen_to_feedback(self):
        """Feedback messages from now on; an action client is deaf to those that come after the result."""
        feedback = client.Topic(f"/{self.controller}/follow_joint_trajectory/feedback", FollowJointTrajectoryActionFeedback)
        self.addCleanup(feedback.close)
        return feedback

    def positions(self):
        return self.state.last.actual.positions

    def wait_still_at(self, positions, timeout=30.0):
        """Until desired and actual positions are there and at rest, angles taken as they are counted."""

        def there():
            state = self.state.next()
            return all(
                abs(d - p) < EPS and abs(math.remainder(a - p, 2 * math.pi)) < EPS and abs(v) < EPS
                for p, d, a, v in zip(positions, state.desired.positions, state.actual.positions, state.actual.velocities)
            )

        client.wait_until(there, f"joints to rest at {positions}", timeout)

    def wait_moved(self, beyond=0.1, joint=0):
        client.wait_until(lambda: abs(self.state.next().actual.positions[joint]) > beyond, f"joint {joint} to pass {beyond}")

    def wait_at_rest(self):
        """Until nothing moves any more. :return: the positions there"""

        def rests():
            state = self.state.next()
            return all(abs(v) < 1e-6 for v in (*state.desired.velocities, *state.actual.velocities))

        client.wait_until(rests, "joints to come to rest")
        return self.state.last.actual.positions

    def assertStates(self, actual, expected):
        self.assertEqual(len(actual), len(expected))
        for a, e in zip(actual, expected):
            self.assertAlmostEqual(a, e, delta=EPS)
