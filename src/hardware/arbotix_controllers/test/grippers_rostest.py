#!/usr/bin/env python3
"""Grippers' nodes over servos of this test: they go at 2 rad/s, and stop at what is held."""

import math
import subprocess

import actionlib
import rospy
import rostest
import tf2_ros
from actionlib_msgs.msg import GoalStatus
from control_msgs.msg import GripperCommandAction, GripperCommandGoal
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64
from test_support import TestCase, wait_until

SPEED, PERIOD = 2.0, 0.02  # rad/s, s


class Servos:
    """Follow <joint>/command, between `low` and `high`, and publish joint_states."""

    def __init__(self, *joints):
        self.at, self.goal, self.told = dict.fromkeys(joints, 0.0), {}, {}
        self.low, self.high = -math.inf, math.inf
        self._publisher = rospy.Publisher("joint_states", JointState, queue_size=5)
        self._subscribers = [rospy.Subscriber(f"{joint}/command", Float64, self._take, joint) for joint in joints]
        self._timer = rospy.Timer(rospy.Duration(PERIOD), self._step)

    def connected(self):
        return all(subscriber.get_num_connections() for subscriber in self._subscribers)

    def _take(self, message, joint):
        self.goal[joint] = self.told[joint] = message.data

    def _step(self, _event):
        for joint, goal in list(self.goal.items()):
            way = min(max(goal - self.at[joint], -SPEED * PERIOD), SPEED * PERIOD)
            self.at[joint] = min(max(self.at[joint] + way, self.low), self.high)
        self._publisher.publish(JointState(name=list(self.at), position=list(self.at.values())))


class GrippersTest(TestCase):
    @classmethod
    def setUpClass(cls):
        cls.servos = Servos("left", "right", "gripper_joint", "l_gripper_joint", "r_gripper_joint")

    def setUp(self):
        wait_until(self.servos.connected, "the grippers to listen")
        self.servos.low, self.servos.high = -math.inf, math.inf
        self.servos.told.clear()

    def goal(self, name, opening):
        client = actionlib.SimpleActionClient(f"/{name}/gripper_action", GripperCommandAction)
        self.assertTrue(client.wait_for_server(rospy.Duration(20)))
        goal = GripperCommandGoal()
        goal.command.position = opening
        client.send_goal_and_wait(goal, rospy.Duration(20))
        return client.get_state(), client.get_result(), client.get_goal_status_text()

    def test_it_opens_and_says_how_far(self):
        state, result, _ = self.goal("two", 0.05)
        self.assertEqual((state, result.reached_goal, result.stalled), (GoalStatus.SUCCEEDED, True, False))
        self.assertAlmostEqual(self.servos.told["left"], math.pi / 6)
        self.assertAlmostEqual(self.servos.told["right"], math.pi / 6)  # the right one is inverted
        self.assertAlmostEqual(result.position, 0.05, delta=0.08 * 0.03)

    def test_what_is_held_stops_it(self):
        self.goal("two", 0.05)
        self.servos.low = 0.3
        state, result, _ = self.goal("two", 0.0)
        self.assertEqual((state, result.reached_goal, result.stalled), (GoalStatus.SUCCEEDED, False, True))
        self.assertAlmostEqual(result.position, 0.01 + 0.08 * math.sin(0.3), delta=1e-3)

    def test_an_opening_that_cannot_be_moves_nothing(self):
        for opening, said in ((0.2, "is not within 0 to 0.09 m"), (math.nan, "is no width")):
            state, _, text = self.goal("two", opening)
            self.assertEqual(state, GoalStatus.ABORTED)
            self.assertIn(said, text)
        self.assertEqual(self.servos.told, {})

    def test_without_joint_states_it_is_done_when_told(self):
        heard = []
        subscriber = rospy.Subscriber("deaf/command", Float64, lambda message: heard.append(message.data))
        wait_until(subscriber.get_num_connections, "the gripper")
        state, result, _ = self.goal("deaf", 0.03)
        self.assertEqual((state, result.reached_goal, result.position), (GoalStatus.SUCCEEDED, True, 0.03))
        self.assertAlmostEqual(heard[0], 0.56)

    def test_the_older_nodes(self):
        for node, opening, told in (
            ("old_one", 0.03, {"gripper_joint": math.pi / 6}),
            ("old_two", 0.03, {"l_gripper_joint": math.pi / 6, "r_gripper_joint": -math.pi / 6}),
        ):
            publisher = rospy.Publisher(f"/{node}/command", Float64, queue_size=1)
            wait_until(publisher.get_num_connections, node)
            publisher.publish(opening)
            wait_until(lambda told=told: set(told) <= set(self.servos.told), "commands of its joints")
            for joint, position in told.items():
                self.assertAlmostEqual(self.servos.told[joint], position)

    def test_the_table_shows_its_fingers(self):
        self.servos.goal["gripper_joint"] = 0.8997
        buffer = tf2_ros.Buffer()
        listener = tf2_ros.TransformListener(buffer)

        def apart():
            try:
                found = buffer.lookup_transform("gripper_left_link", "gripper_right_link", rospy.Time())
            except tf2_ros.TransformException:
                return 0.0
            return found.transform.translation.y

        wait_until(lambda: abs(apart() - 0.0254) < 1e-6, "the fingers to stand 25.4 mm apart")
        listener.unregister()
        heard = []
        subscriber = rospy.Subscriber("/table/command", Float64, lambda message: heard.append(message.data))
        publisher = rospy.Publisher("/old_table/command", Float64, queue_size=1)
        wait_until(lambda: subscriber.get_num_connections() and publisher.get_num_connections(), "the gripper")
        publisher.publish(0.0159)
        wait_until(lambda: heard, "a command")
        self.assertAlmostEqual(heard[0], 1.2167)

    def test_a_wrong_parameter_is_one_line(self):
        for parameters, said in (
            ([], "parameter /bad/model must be dualservo, singlesided or parallel; it is not set"),
            (["_model:=claw"], "it is 'claw'"),
            (["_model:=parallel", "_scale:=0"], "parameter /bad/scale must not be 0"),
            (["_model:=singlesided", "_finger_length:=-1"], "parameter /bad/finger_length must be a number"),
        ):
            for name in rospy.get_param_names():
                if name.startswith("/bad/"):
                    rospy.delete_param(name)
            command = ["rosrun", "arbotix_controllers", "gripper_controller", "__name:=bad", *parameters]
            ended = subprocess.run(command, capture_output=True, text=True, timeout=30)
            self.assertEqual(ended.returncode, 1, said)
            self.assertIn(said, ended.stderr)
            self.assertNotIn("Traceback", ended.stderr)


if __name__ == "__main__":
    rospy.init_node("grippers_rostest")
    rostest.rosrun("arbotix_controllers", "grippers", GrippersTest)
