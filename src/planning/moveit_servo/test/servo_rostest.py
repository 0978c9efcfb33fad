#!/usr/bin/env python3
"""An arm that follows at once is jogged by topics, in a simulated time that the test itself makes; expected is way = speed * time."""

import os
import subprocess
import unittest

import numpy as np
import rospy
import rostest
import tf2_ros
import yaml
from control_msgs.msg import JointJog
from geometry_msgs.msg import Point, Pose, Quaternion, Transform, TransformStamped, TwistStamped, Vector3
from moveit_msgs.msg import CollisionObject
from moveit_msgs.srv import ChangeControlDimensions, ChangeDriftDimensions
from rosgraph_msgs.msg import Clock, Log
from sensor_msgs.msg import JointState
from shape_msgs.msg import SolidPrimitive
from std_msgs.msg import Float64MultiArray, Int8
from std_srvs.srv import Empty
from test_support.hearing import heard
from test_support.waiting import wait_until
from trajectory_msgs.msg import JointTrajectory

JOINTS = [f"joint_{i}" for i in range(1, 7)]
HOME = np.array([0.0, -0.3, 1.6, 0.0, 1.5, 0.0])
PERIOD = 0.01
TIMEOUT, HALTS = 0.1, 4  # of servo.yaml
NO_WARNING, SLOW_SINGULARITY, HALT_SINGULARITY, SLOW_COLLISION, HALT_COLLISION, JOINT_BOUND = range(6)


def tip(q):
    """Rotation (3, 3) and position (3,) of the hand in base_link, m, by the URDF's numbers."""
    rotation, position = np.eye(3), np.zeros(3)
    for angle, axis, height in zip(q, "zyyzyz", (0.1, 0.2, 0.4, 0.34, 0.1, 0.09)):
        position = position + rotation @ [0, 0, height]
        c, s = np.cos(angle), np.sin(angle)
        turn = [[c, -s, 0], [s, c, 0], [0, 0, 1]] if axis == "z" else [[c, 0, s], [0, 1, 0], [-s, 0, c]]
        rotation = rotation @ turn
    return rotation, position + rotation @ [0, 0, 0.04]


def jacobian(q):
    """Of the tip, by differences: rows are its velocity, m/s, and its rate, rad/s."""
    columns = []
    rotation, position = tip(q)
    for step in 1e-6 * np.eye(6):
        turned, moved = tip(q + step)
        spin = (turned - rotation) @ rotation.T / 1e-6
        columns.append([*(moved - position) / 1e-6, spin[2, 1], spin[0, 2], spin[1, 0]])
    return np.transpose(columns)


def condition(q):
    return np.linalg.cond(jacobian(q))


def twist(linear=(0, 0, 0), angular=(0, 0, 0), frame="base_link"):
    message = TwistStamped()
    message.header.frame_id = frame
    message.twist.linear, message.twist.angular = Vector3(*linear), Vector3(*angular)
    return message


def jog(**velocities):
    return JointJog(joint_names=list(velocities), velocities=list(velocities.values()))


def box(position, size, operation=CollisionObject.ADD):
    thing = CollisionObject(id="box", operation=operation)
    thing.header.frame_id = "base_link"
    thing.primitives = [SolidPrimitive(type=SolidPrimitive.BOX, dimensions=[size] * 3)]
    thing.primitive_poses = [Pose(Point(*position), Quaternion(0, 0, 0, 1))]
    return thing


class Arm:
    """The robot and the clock: one step is one period, at the end of which one node of servoing has said its status."""

    def __init__(self):
        self.q, self.now = HOME.copy(), 1_000_000_000  # ns: sums of floats would miss the period's end
        self.all_publishers = {}
        self.clock = rospy.Publisher("/clock", Clock, queue_size=10)
        self.states = rospy.Publisher("/joint_states", JointState, queue_size=10)
        self.node, self.subscribers, self.publishers = "", [], {}
        self.follows, self.velocity = True, np.zeros(6)

    def lead(self, node, speeds=False):
        """From now on what this node says is followed: positions of trajectories, or the speeds of arrays."""
        for subscriber in self.subscribers:
            subscriber.unregister()
        self.node, self.speeds = node, speeds
        self.statuses, self.commands = [], []
        kind = Float64MultiArray if speeds else JointTrajectory
        self.subscribers = [
            rospy.Subscriber(f"/{node}/status", Int8, lambda message: self.statuses.append(message.data), tcp_nodelay=True),
            rospy.Subscriber(f"/{node}/command", kind, self.take, tcp_nodelay=True),
        ]
        for name, kind in (("delta_twist_cmds", TwistStamped), ("delta_joint_cmds", JointJog)):
            if (node, kind) not in self.all_publishers:
                self.all_publishers[node, kind] = rospy.Publisher(f"/{node}/{name}", kind, queue_size=100)
            self.publishers[kind] = self.all_publishers[node, kind]
        wait_until(self.is_connected, f"the topics of {node}")

    def is_connected(self):
        self.tick()
        return heard(self.subscribers) and all(each.get_num_connections() for each in self.publishers.values())

    def take(self, message):
        self.commands.append(message)
        if not self.follows:
            return
        if self.speeds:
            self.velocity = np.array(message.data)
            self.q = self.q + self.velocity * PERIOD  # each holds for its period
        else:
            self.velocity = np.array(message.points[0].velocities)
            self.q = np.array(message.points[0].positions)

    def tick(self):
        self.now += round(PERIOD * 1e9)
        stamp = rospy.Time(0, self.now)
        state = JointState(name=[*JOINTS, "finger_joint"], position=[*self.q, 0.0], velocity=[*self.velocity, 0.0])
        state.header.stamp = stamp
        self.states.publish(state)
        self.clock.publish(Clock(stamp))

    def send(self, command):
        command.header.stamp = rospy.Time(0, self.now)
        self.publishers[type(command)].publish(command)

    def step(self, count=1, command=None):
        """So many periods, with the command stamped anew in each."""
        for _ in range(count):
            said = len(self.statuses)
            self.tick()
            if command is not None:
                self.send(command)
            wait_until(lambda said=said: len(self.statuses) > said, f"the status of {self.node}", timeout=20.0, interval=0.001)

    def put(self, q):
        """Somewhere else, with the motion before it forgotten and no warning left."""
        self.step(int(TIMEOUT / PERIOD) + HALTS + 5)
        self.q = np.array(q, float)
        self.step(20)
        rospy.ServiceProxy(f"/{self.node}/reset_servo_status", Empty)()
        self.step(3)
        self.commands.clear()
        self.statuses.clear()

    def moving(self):
        """The commands that were no halts: one per period, whenever what was sent has been heard."""
        return [each for each in self.commands if any(each.data if self.speeds else each.points[0].velocities)]

    def way(self, count, command):
        """How the tip moves, m, how far it turns, rad, in about so many periods and the halt after them, and how long that took, s."""
        rotation, position = tip(self.q)
        self.commands.clear()
        self.step(count, command)
        self.step(30, type(command)())  # all zero
        turned, moved = tip(self.q)
        return moved - position, np.arccos(np.clip((np.trace(turned @ rotation.T) - 1) / 2, -1, 1)), len(self.moving()) * PERIOD


class Servo(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.arm = Arm()
        cls.lines = []
        cls.rosout = rospy.Subscriber("/rosout", Log, lambda message: cls.lines.append(message.msg))
        cls.objects = rospy.Publisher("/collision_object", CollisionObject, queue_size=10)
        cls.transforms = tf2_ros.StaticTransformBroadcaster()
        table = TransformStamped()  # a quarter of a turn to the left
        table.header.frame_id, table.child_frame_id = "base_link", "table"
        table.transform.rotation = Quaternion(0, 0, np.sqrt(0.5), np.sqrt(0.5))
        cls.transforms.sendTransform(table)

    def setUp(self):
        self.arm.lead("positions")
        self.arm.put(HOME)

    def change(self, name, kind, *values):
        rospy.ServiceProxy(f"/{self.arm.node}/{name}", kind)(*values)

    def assert_way(self, command, velocity, rate=0.0, moves=True):
        """The tip moves at the velocity, m/s, and turns at the rate, rad/s; smoothing (coefficient 2) may keep three periods back."""
        way, angle, time = self.arm.way(50, command)
        if moves:
            self.assertAlmostEqual(time, 0.5, delta=0.2)
        else:
            self.assertEqual(time, 0.0)
        np.testing.assert_allclose(way, np.array(velocity) * time, atol=3 * PERIOD * (np.linalg.norm(velocity) or 0.02))
        self.assertAlmostEqual(angle, rate * time, delta=3 * PERIOD * (rate or 0.1))

    # ------------------------------------------------------------ twists

    def test_a_twist_moves_the_tip_at_its_velocity(self):
        for linear in ((0.1, 0, 0), (0, 0.1, 0), (0, -0.06, 0.08)):
            self.arm.put(HOME)
            self.assert_way(twist(linear), linear)
        self.arm.put(HOME)
        self.assert_way(twist(angular=(0, 0, 0.4)), np.zeros(3), rate=0.4)
        self.assertEqual(self.arm.statuses[-1], NO_WARNING)

    def test_a_twist_in_another_frame(self):
        hand, _ = tip(HOME)
        for frame, axis, expected in (
            ("hand", (0, 0, -0.1), hand @ [0, 0, -0.1]),
            ("", (0.1, 0, 0), hand @ [0.1, 0, 0]),  # robot_link_command_frame
            ("world", (0, 0.1, 0), (0, 0.1, 0)),
            ("table", (0.1, 0, 0), (0, 0.1, 0)),  # of TF alone
        ):
            self.arm.put(HOME)
            self.assert_way(twist(axis, frame=frame), expected)

    def test_a_frame_that_does_not_exist_is_refused(self):
        self.assert_way(twist((0.1, 0, 0), frame="nowhere"), np.zeros(3), moves=False)
        wait_until(lambda: any("nowhere" in line for line in self.lines), "the line about the frame")

    def test_joint_velocities_are_limited_together(self):
        self.arm.step(5, twist((0, 40.0, 0)))
        fastest = [max(np.abs(each.points[0].velocities)) for each in self.arm.commands]
        self.assertAlmostEqual(max(fastest), 2.0, places=6)  # the URDF's limit

    def test_unitless_commands_are_scaled(self):
        self.arm.lead("velocities", speeds=True)
        self.arm.put(HOME)
        self.assert_way(twist((0, 0.5, 0)), (0, 0.5 * 0.4, 0))
        self.arm.put(HOME)
        self.assert_way(twist(angular=(0, 0, 0.5)), np.zeros(3), rate=0.5 * 0.8)
        self.arm.put(HOME)
        *_, time = self.arm.way(50, jog(joint_1=-1.0))
        self.assertAlmostEqual(self.arm.q[0], -0.5 * time, delta=3 * 0.5 * PERIOD)
        self.arm.put(HOME)
        self.assert_way(twist((0, 1.5, 0)), np.zeros(3), moves=False)  # beyond 1
        wait_until(lambda: any("beyond 1" in line for line in self.lines), "the line about it")

    def test_dimensions_that_are_not_controlled(self):
        self.change("change_control_dimensions", ChangeControlDimensions, True, False, True, True, True, True)
        self.addCleanup(self.change, "change_control_dimensions", ChangeControlDimensions, *[True] * 6)
        self.assert_way(twist((0, 0.08, 0.06)), (0, 0, 0.06))

    def test_dimensions_that_may_drift(self):
        self.change("change_drift_dimensions", ChangeDriftDimensions, False, False, False, True, True, True, Transform())
        self.addCleanup(self.change, "change_drift_dimensions", ChangeDriftDimensions, *[False] * 6, Transform())
        way, angle, time = self.arm.way(50, twist((0, 0.1, 0)))
        np.testing.assert_allclose(way, (0, 0.1 * time, 0), atol=3 * PERIOD * 0.1)
        self.assertGreater(angle, 0.02)
        self.change("change_drift_dimensions", ChangeDriftDimensions, *[True] * 5, False, Transform())
        self.arm.put(HOME)
        _, angle, time = self.arm.way(50, twist(angular=(0, 0, 0.4)))
        self.assertAlmostEqual(angle, 0.4 * time, delta=3 * PERIOD * 0.4)

    # ------------------------------------------------------------ joints

    def test_a_joint_moves_at_its_velocity(self):
        *_, time = self.arm.way(50, jog(joint_3=0.4, joint_6=-0.2, elbow=1.0))
        self.assertAlmostEqual(time, 0.5, delta=0.2)
        np.testing.assert_allclose(self.arm.q - HOME, time * np.array([0, 0, 0.4, 0, 0, -0.2]), atol=3 * PERIOD * 0.4)
        wait_until(lambda: any("elbow" in line for line in self.lines), "the line about the joint that is ignored")

    def test_a_joint_halts_at_its_limit(self):
        start = [*HOME[:5], 2.9]
        self.arm.put(start)
        self.arm.step(40, jog(joint_6=0.5))
        self.assertEqual(self.arm.statuses[-1], JOINT_BOUND)
        self.assertGreater(self.arm.q[5], 3.0 - 0.01)  # 3.1 and the margin of 0.1
        self.assertLess(self.arm.q[5], 3.0 + 0.03)
        self.assertEqual(list(self.arm.commands[-1].points[0].velocities), [0.0] * 6)
        stays = self.arm.q[5]
        self.arm.step(20, jog(joint_6=0.5))
        self.assertAlmostEqual(self.arm.q[5], stays, delta=0.001)
        self.arm.step(20, jog(joint_6=-0.5))  # back again
        self.assertLess(self.arm.q[5], stays - 0.05)

    # ------------------------------------------------------------ halts

    def assert_halts(self, first):
        commands = self.arm.commands[first:]
        self.assertEqual(len(commands), HALTS)
        for each in commands:
            self.assertEqual((each.joint_names, list(each.points[0].velocities)), (JOINTS, [0.0] * 6))
        stays = self.arm.q.copy()
        self.arm.step(30)
        self.assertEqual(len(self.arm.commands), first + HALTS)
        np.testing.assert_array_equal(self.arm.q, stays)

    def test_without_commands_it_halts_after_the_timeout(self):
        self.arm.step(30, twist((0, 0.1, 0)))
        self.arm.step(40)
        moving = len(self.arm.moving())
        self.assertGreater(moving, 10 + TIMEOUT / PERIOD)
        self.assertLess(moving, 30 + TIMEOUT / PERIOD + 5)
        self.assert_halts(moving)

    def test_a_command_of_zero_halts_at_once(self):
        for zero in (twist(), jog(joint_1=0.0)):
            self.arm.put(HOME)
            self.arm.step(20, twist((0, 0.1, 0)) if isinstance(zero, TwistStamped) else jog(joint_1=0.2))
            self.arm.step(30, zero)
            self.assertGreater(len(self.arm.moving()), 5)
            self.assert_halts(len(self.arm.moving()))

    def test_what_is_no_number_is_skipped(self):
        for bad in (twist((0, float("nan"), 0)), twist(angular=(float("inf"), 0, 0)), jog(joint_1=float("nan"))):
            self.arm.put(HOME)
            self.arm.step(20, bad)
            np.testing.assert_allclose(self.arm.q, HOME, atol=1e-9)
        short = JointJog(joint_names=["joint_1", "joint_2"], velocities=[0.1])
        self.arm.step(20, short)
        np.testing.assert_allclose(self.arm.q, HOME, atol=1e-9)
        wait_until(lambda: any("nan or infinity" in line for line in self.lines), "the line about it")
        self.assert_way(twist((0, 0.1, 0)), (0, 0.1, 0))  # it goes on

    def test_low_latency_answers_each_command_and_halts(self):
        self.arm.lead("quick")
        said = len(self.arm.commands)
        for i in range(20):
            self.arm.tick()
            self.arm.send(twist((0, 0.1, 0)))
            wait_until(lambda i=i: len(self.arm.commands) == said + i + 1, "its answer")
        for _ in range(30):
            self.arm.tick()
        wait_until(lambda: len(self.arm.commands) == said + 20 + HALTS, "the halt")
        self.assertFalse(any(self.arm.commands[-1].points[0].velocities))

    # ------------------------------------------------------------ dangers

    def test_it_slows_down_and_halts_before_a_singularity(self):
        self.assertLess(condition(HOME), 17)
        self.arm.step(600, twist((0.2, 0, 0)))  # stretched out the arm would have moved 0.4 m
        self.assertEqual(
            [s for i, s in enumerate(self.arm.statuses) if i == 0 or s != self.arm.statuses[i - 1]][:2], [NO_WARNING, SLOW_SINGULARITY]
        )
        self.assertIn(self.arm.statuses[-1], (SLOW_SINGULARITY, HALT_SINGULARITY))
        self.assertGreater(condition(self.arm.q), 27)
        self.assertLess(condition(self.arm.q), 31)
        speeds = [np.abs(each.points[0].velocities).max() for each in self.arm.commands]
        self.assertLess(speeds[-1], 0.15 * max(speeds))
        near = tip(self.arm.q)[1][0]
        self.arm.step(50, twist((-0.2, 0, 0)))  # away from it at full speed
        self.assertAlmostEqual(tip(self.arm.q)[1][0], near - 0.1, delta=0.015)

    def test_it_halts_on_the_singularity(self):
        self.arm.put([0.3, 0.0, 0.0, 0.2, 0.5, 0.0])  # stretched
        self.arm.step(20, twist((0, 0, -0.1)))
        self.assertEqual(self.arm.statuses[-1], HALT_SINGULARITY)
        np.testing.assert_allclose(self.arm.q, [0.3, 0.0, 0.0, 0.2, 0.5, 0.0], atol=1e-6)

    def see(self, thing):
        """Tell of a thing, and go on until it counts: nobody says when."""
        wait_until(lambda: self.objects.get_num_connections() >= 3, "who listens to objects")
        self.objects.publish(thing)

    def test_it_slows_down_and_halts_for_a_thing(self):
        self.addCleanup(self.objects.publish, box((0, 0, 0), 0.1, CollisionObject.REMOVE))
        beside = tip(HOME)[1] + [0, 0.3, 0]  # the hand is 0.16 m wide: 0.17 m to the box's side
        self.see(box(beside, 0.1))
        self.arm.step(400, twist((0, 0.1, 0)))
        self.assertEqual(self.arm.statuses[-1], SLOW_COLLISION)
        way = tip(self.arm.q)[1][1]
        self.assertGreater(way, 0.12)  # 0.17 m and the threshold of 0.05
        self.assertLess(way, 0.17)
        speeds = [np.abs(each.points[0].velocities).max() for each in self.arm.commands]
        self.assertLess(speeds[-1], 0.1 * max(speeds))

        self.see(box(tip(self.arm.q)[1], 0.1))  # now within the hand
        wait_until(lambda: self.arm.step(1, twist((0, -0.1, 0))) or self.arm.statuses[-1] == HALT_COLLISION, "the halt")
        stays = self.arm.q.copy()
        self.arm.step(20, twist((0, -0.1, 0)))
        np.testing.assert_allclose(self.arm.q, stays, atol=1e-3)
        self.see(box((0, 0, 0), 0.1, CollisionObject.REMOVE))
        self.arm.step(50, twist((0, -0.1, 0)))
        np.testing.assert_allclose(self.arm.q, stays, atol=1e-3)  # until it is told to go on
        rospy.ServiceProxy("/positions/reset_servo_status", Empty)()
        self.arm.step(50, twist((0, -0.1, 0)))
        self.assertLess(tip(self.arm.q)[1][1], way - 0.03)
        self.assertEqual(self.arm.statuses[-1], NO_WARNING)


class Parameters(unittest.TestCase):
    """What a node says that cannot start."""

    def assert_refused(self, said, without=(), **changes):
        with open(os.path.join(os.path.dirname(__file__), "servo.yaml")) as file:
            parameters = yaml.safe_load(file) | changes
        rospy.set_param("/refused", {name: value for name, value in parameters.items() if name not in without})
        ended = subprocess.run(["rosrun", "moveit_servo", "servo_server", "__name:=refused"], capture_output=True, text=True, timeout=60)
        errors = [line for line in (ended.stdout + ended.stderr).splitlines() if "ERROR" in line or "FATAL" in line]
        self.assertEqual(ended.returncode, 1, ended.stderr)
        self.assertEqual(len(errors), len(said), errors)
        for line, words in zip(sorted(errors), sorted(said)):
            self.assertIn(words, line)

    def test_a_parameter_is_missing(self):
        self.assert_refused(
            ["/refused/planning_frame is missing", "/refused/publish_period is missing"], ["planning_frame", "publish_period"]
        )

    def test_a_parameter_is_of_another_type(self):
        self.assert_refused(["/refused/publish_period is not a number"], publish_period="often")

    def test_a_value_cannot_be(self):
        self.assert_refused(["command_in_type is 'speed'"], command_in_type="speed")
        self.assert_refused(["hard_stop_singularity_threshold"], hard_stop_singularity_threshold=10)

    def test_the_robot_has_no_such_part(self):
        self.assert_refused(["no group 'panda_arm'; it has "], move_group_name="panda_arm")
        self.assert_refused(["Parameter planning_frame: robot 'arm' has no link 'panda_link0'"], planning_frame="panda_link0")


class AllTests(unittest.TestSuite):
    def __init__(self):
        load = unittest.defaultTestLoader.loadTestsFromTestCase
        super().__init__([load(case) for case in (Servo, Parameters)])


if __name__ == "__main__":
    rospy.init_node("servo_test")
    rostest.rosrun("moveit_servo", "servo", "servo_rostest.AllTests")
