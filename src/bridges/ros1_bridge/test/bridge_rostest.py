#!/usr/bin/env python3
"""Real nodes of both sides with the bridge between them; skipped where ROS 2 is not installed."""

import io
import threading
import time
import unittest

import actionlib
import rospy
import rostest
import tf2_msgs.msg
from control_msgs.msg import (
    FollowJointTrajectoryAction,
    FollowJointTrajectoryFeedback,
    FollowJointTrajectoryGoal,
    FollowJointTrajectoryResult,
    GripperCommand,
    GripperCommandAction,
    GripperCommandFeedback,
    GripperCommandGoal,
    GripperCommandResult,
)
from geometry_msgs.msg import TransformStamped
from ros1_bridge.link import HINT, prefix
from ros2_side import PATIENCE, Other, wait
from rosgraph_msgs.msg import Clock, Log
from sensor_msgs.msg import Image, JointState
from std_msgs.msg import Float64, String
from std_srvs.srv import SetBool, SetBoolResponse
from test_support import never
from test_support.hearing import heard

NUMBERS = [0.1, -1e-300, 1e300, 2.0 / 3.0]


@unittest.skipIf(prefix() is None, HINT)
class Bridge(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.other = Other()

    @classmethod
    def tearDownClass(cls):
        cls.other.process.kill()

    def test_joint_states_are_the_same_bits(self):
        publisher = rospy.Publisher("/joint_states", JointState, queue_size=10)
        self.other.do("hear", topic="/joint_states", kind="JointState")
        wait(publisher.get_num_connections, "the bridge")
        message = JointState(name=["a", "bc"], position=NUMBERS)
        message.header.stamp, message.header.frame_id = rospy.Time(5, 7), "world"
        publisher.publish(message)
        data = wait(lambda: self.other.heard("/joint_states"), "the joint states")[0]
        # CDR by the OMG's specification: sec, nanosec, frame_id, names, positions from a multiple of 8 on, two empty lists
        self.assertEqual(data[4:12], (5).to_bytes(4, "little") + (7).to_bytes(4, "little"))
        buffer = io.BytesIO()
        message.serialize(buffer)
        bits = buffer.getvalue()[-8 - 32 : -8]
        self.assertIn(bits, data)
        self.assertEqual((data.index(bits) - 4) % 8, 0)
        self.other.do("advertise", topic="/back", kind="JointState")
        came = []
        rospy.Subscriber("/back", JointState, came.append)
        wait(lambda: came or self.other.do("publish", topic="/back", data=data.hex()), "the way back")
        message.header.seq = came[0].header.seq  # ROS 2 has none
        self.assertEqual(came[0], message)

    def test_what_the_bridge_publishes_does_not_come_back(self):
        mine, theirs = [], rospy.Publisher("/both", String, queue_size=10)
        rospy.Subscriber("/both", String, mine.append)
        self.other.do("advertise", topic="/both", kind="String")
        self.other.do("hear", topic="/both", kind="String")
        wait(lambda: theirs.get_num_connections() >= 2, "the bridge")
        sent = []

        def send(publish):
            sent.append(1)
            publish()

        two = "00010000 04000000 74776f00".replace(" ", "")
        wait(lambda: self.other.heard("/both") or send(lambda: theirs.publish("one")), "the text in ROS 2")
        publish = lambda: self.other.do("publish", topic="/both", data=two)
        wait(lambda: [one for one in mine if one.data == "two"] or send(publish), "the text in ROS 1")
        echoed = lambda: max(len(self.other.heard("/both")), len(mine)) > len(sent)
        never(echoed, "an echo", 1.0)  # which would make them more and more

    def test_clock_pictures_and_what_is_latched(self):
        clock, picture = rospy.Publisher("/clock", Clock, queue_size=1), rospy.Publisher("/camera/image_raw", Image, queue_size=1)
        first, second = (rospy.Publisher("/tf_static", tf2_msgs.msg.TFMessage, queue_size=1, latch=True) for _ in range(2))
        first.publish([TransformStamped(child_frame_id="one")])
        note = rospy.Publisher("/note", String, queue_size=1, latch=True)
        note.publish("kept")
        self.other.do("hear", topic="/clock", kind="Clock", profile="sensor")
        self.other.do("hear", topic="/camera/image_raw", kind="Image", profile="sensor")
        self.other.do("hear", topic="/tf_static", kind="TFMessage", profile="latched")
        self.other.do("hear", topic="/note", kind="String", profile="latched")
        wait(lambda: any(b"one\0" in data for data in self.other.heard("/tf_static")), "the static transform")
        wait(lambda: any(b"kept\0" in data for data in self.other.heard("/note")), "the latched note")
        wait(lambda: self.other.heard("/clock") or clock.publish(rospy.Time(1, 2)), "the clock")
        self.assertEqual(self.other.heard("/clock")[0], bytes.fromhex("00010000 01000000 02000000"))
        pixels = bytes(range(256)) * 300
        message = Image(height=160, width=160, encoding="rgb8", step=480, data=pixels)
        wait(lambda: self.other.heard("/camera/image_raw") or picture.publish(message), "the picture")
        self.assertIn(pixels, self.other.heard("/camera/image_raw")[0])

    def test_services_both_ways(self):
        def switch(request):
            if request.data:
                return SetBoolResponse(True, "of ROS 1")
            raise ValueError("not off")

        rospy.Service("/of_ros1", SetBool, switch)
        self.other.do("call", name="/of_ros1", value=True)
        self.assertEqual(self.other.answer(called="/of_ros1"), {"called": "/of_ros1", "success": True, "message": "of ROS 1"})
        self.other.do("serve", name="/of_ros2")
        rospy.wait_for_service("/of_ros2", PATIENCE)
        answer = rospy.ServiceProxy("/of_ros2", SetBool)(False)
        self.assertEqual((answer.success, answer.message), (True, "of ROS 2"))

    def test_actions_both_ways(self):
        def execute(goal):
            """Until it is cancelled, or has been heard of three times if it is short."""
            long, self.goal = goal.trajectory.points[-1].time_from_start.to_sec() > 10, goal
            while long or len(self.other.progress("/arm/follow")) < 3:
                if server.is_preempt_requested():
                    server.set_preempted(FollowJointTrajectoryResult(error_string="stopped"))
                    return
                server.publish_feedback(FollowJointTrajectoryFeedback())
                time.sleep(0.05)
            server.set_succeeded(FollowJointTrajectoryResult(error_code=0, error_string="arrived"))

        server = actionlib.SimpleActionServer("/arm/follow", FollowJointTrajectoryAction, execute, auto_start=False)
        server.start()
        self.other.do("goal", name="/arm/follow", positions=NUMBERS, joints=list("abcd"), seconds=1)
        answer = self.other.answer(ended="/arm/follow")
        self.assertEqual((answer["status"], answer["code"], answer["text"]), (4, 0, "arrived"))  # 4: STATUS_SUCCEEDED of action_msgs
        self.assertGreater(answer["feedback"], 2)
        self.assertEqual((self.goal.trajectory.joint_names, list(self.goal.trajectory.points[0].positions)), (list("abcd"), NUMBERS))
        for when in ("moving", "at once", "at once", "at once"):
            self.other.told.clear()
            self.other.do("goal", name="/arm/follow", positions=NUMBERS, joints=list("abcd"), seconds=50, cancel=when)
            answer = self.other.answer(ended="/arm/follow")
            self.assertEqual(answer["status"], 5)  # STATUS_CANCELED
            if when == "moving":
                self.assertEqual(answer["text"], "stopped")
        self.other.do("serve_action", name="/theirs")
        client = actionlib.SimpleActionClient("/theirs", FollowJointTrajectoryAction)
        self.assertTrue(client.wait_for_server(rospy.Duration(PATIENCE)))
        client.send_goal_and_wait(FollowJointTrajectoryGoal())
        self.assertEqual((client.get_state(), client.get_result().error_code, client.get_result().error_string), (3, -3, "of ROS 2"))

    def test_a_gripper_both_ways(self):
        def grip(goal):
            server.publish_feedback(GripperCommandFeedback(position=0.5 * goal.command.position))
            server.set_succeeded(GripperCommandResult(goal.command.position, goal.command.max_effort, True, False))

        server = actionlib.SimpleActionServer("/hand/gripper_cmd", GripperCommandAction, grip, auto_start=False)
        server.start()
        self.other.do("grip", name="/hand/gripper_cmd", position=0.25, effort=2.0 / 3.0)
        answer = self.other.answer(gripped="/hand/gripper_cmd")
        self.assertEqual((answer["status"], answer["result"]), (4, [0.25, 2.0 / 3.0, True, False]))
        self.other.do("serve_grip", name="/their_hand")
        client = actionlib.SimpleActionClient("/their_hand", GripperCommandAction)
        self.assertTrue(client.wait_for_server(rospy.Duration(PATIENCE)))
        client.send_goal_and_wait(GripperCommandGoal(GripperCommand(0.125, 7.0)))
        result = client.get_result()
        self.assertEqual((client.get_state(), result.position, result.effort, result.reached_goal), (3, 0.125, 7.0, True))

    def test_a_goal_that_is_cancelled_at_once(self):
        """Also before the server of ROS 2 has been found."""
        self.other.do("serve_action", name="/slow", until_cancelled=True)
        client = actionlib.SimpleActionClient("/slow", FollowJointTrajectoryAction)
        self.assertTrue(client.wait_for_server(rospy.Duration(PATIENCE)))
        for _ in range(5):
            client.send_goal(FollowJointTrajectoryGoal())
            client.cancel_goal()
            self.assertTrue(client.wait_for_result(rospy.Duration(PATIENCE)))
            # PREEMPTED, RECALLED; LOST where the client takes a status of before the goal for its loss
            self.assertIn(client.get_state(), (2, 8, 9))
        begun, over = (lambda: self.other.count(begun="/slow")), (lambda: self.other.count(over="/slow"))
        wait(lambda: begun() == over(), "the end of all goals in ROS 2")
        client.send_goal(FollowJointTrajectoryGoal())  # what was cancelled before does not end the next
        before = wait(lambda: begun() > over() and begun(), "a goal that goes on")
        client.cancel_goal()
        wait(lambda: over() == before, "its end")

    def test_a_wrong_type_is_said_once(self):
        lines = []
        log = rospy.Subscriber("/rosout", Log, lambda m: lines.append(m.msg) if "/unlike" in m.msg or "std_msgs/Int32" in m.msg else None)
        wait(lambda: heard([log]), "the log")
        publisher = rospy.Publisher("/unlike", String, queue_size=1)
        self.other.do("hear", topic="/unlike", kind="Int32")
        wait(lambda: lines, "the line")
        publisher.publish("x")
        never(lambda: len(lines) > 1, "the line again", 2.0)  # in four looks at the graph

    def test_latency(self):
        """Printed, not judged."""
        publisher, came = rospy.Publisher("/ping", Float64, queue_size=1, tcp_nodelay=True), threading.Event()
        rospy.Subscriber("/pong", Float64, lambda _: came.set(), tcp_nodelay=True)
        self.other.do("echo", topic="/ping", back="/pong")
        wait(lambda: publisher.publish(0.0) or came.wait(0.2), "the first round trip")
        times = []
        for _ in range(300):
            came.clear()
            start = time.monotonic()
            publisher.publish(1.0)
            self.assertTrue(came.wait(PATIENCE))
            times.append(1e3 * (time.monotonic() - start))
        times.sort()
        print(f"round trip through ROS 2: p50 {times[150]:.2f} ms, p99 {times[297]:.2f} ms")


if __name__ == "__main__":
    rospy.init_node("bridge_rostest")
    rostest.rosrun("ros1_bridge", "bridge", Bridge)
