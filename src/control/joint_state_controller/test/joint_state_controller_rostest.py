#!/usr/bin/env python3
"""joint_states, cycle by cycle."""

import unittest

import rospy
import rostest
from controller_manager_tests.client import wait_until
from controller_manager_tests.loop import Loop
from sensor_msgs.msg import JointState

TYPE = "joint_state_controller/JointStateController"


class JointStateControllerTest(unittest.TestCase):
    def setUp(self):
        self.loop = Loop(("b", "a", "c"))
        self.addCleanup(self.loop.manager.shutdown)
        for position, state in enumerate(self.loop.state.values(), 1):
            state.position, state.velocity, state.effort = position, 10.0 * position, 100.0 * position
        self.messages = []
        subscriber = rospy.Subscriber("/robot/joint_states", JointState, self.messages.append, queue_size=200)
        self.addCleanup(subscriber.unregister)

    def load(self, **parameters):
        rospy.set_param("/robot/states", {"type": TYPE, "publish_rate": 50, **parameters})
        return self.loop.load("states")

    def start(self, **parameters):
        self.assertTrue(self.load(**parameters))
        wait_until(lambda: self.loop.controller("states")._publisher.has_subscribers, "the subscriber")
        self.loop.switch(["states"])

    def cycle(self, count):
        for _ in range(count):
            self.loop.cycle()

    def message(self):
        self.cycle(1)
        wait_until(lambda: self.messages, "a message")
        return self.messages[-1]

    def test_content_sorted_by_name(self):
        self.start()
        message = self.message()
        self.assertEqual(message.name, ["a", "b", "c"])
        self.assertEqual((message.position, message.velocity, message.effort), ((2.0, 1.0, 3.0), (20.0, 10.0, 30.0), (200.0, 100.0, 300.0)))
        self.assertEqual((message.header.frame_id, message.header.stamp.to_nsec()), ("", round(self.loop.time * 1e9)))

    def test_chosen_joints_in_their_order(self):
        self.start(joints=["c", "a"])
        message = self.message()
        self.assertEqual((message.name, message.position), (["c", "a"], (3.0, 2.0)))

    def test_rate(self):
        self.start()
        self.cycle(101)
        wait_until(lambda: len(self.messages) >= 51, f"51 messages, there are {len(self.messages)}")
        self.assertEqual(len(self.messages), 51, "one at once, then every second cycle")
        gaps = {(b.header.stamp - a.header.stamp).to_nsec() for a, b in zip(self.messages[1:], self.messages[2:])}
        self.assertEqual(gaps, {20_000_000})

    def test_rate_after_a_long_stop(self):
        self.start()
        self.cycle(10)
        self.loop.switch(stop=["states"])
        self.cycle(6000)  # a minute
        self.loop.switch(["states"])
        wait_until(lambda: self.messages, "the messages before")
        start = self.loop.time
        self.cycle(101)
        wait_until(lambda: self.messages[-1].header.stamp.to_sec() > start + 0.98, "messages after the pause")
        again = [stamp for stamp in (m.header.stamp.to_sec() for m in self.messages) if stamp > start]
        self.assertAlmostEqual(again[0], start + 0.01, 6, "one at once")
        self.assertEqual({round((b - a) * 1e3) for a, b in zip(again[1:], again[2:])}, {20}, "nothing is made up for")

    def test_zero_rate_is_silent(self):
        self.assertTrue(self.load(publish_rate=0))
        self.loop.switch(["states"])
        self.cycle(50)
        self.assertEqual(self.messages, [])

    def test_what_makes_it_fail_to_load(self):
        for wrong in ({"publish_rate": "fast"}, {"joints": ["a", "nope"]}, {"joints": "a"}):
            self.assertFalse(self.load(**wrong), wrong)
        rospy.set_param("/robot/states", {"type": TYPE})
        self.assertFalse(self.loop.load("states"), "no rate")

    def test_extra_joints(self):
        self.start(
            extra_joints=[
                {"name": "x", "position": 1.5, "velocity": 2.5, "effort": 3.5},
                {"name": "y"},
                {"name": "z", "effort": 0.5},
                {"name": "a"},
                {"position": 1.0},
                {"name": "int", "position": 1},
                "nonsense",
                {"name": "x"},
            ]
        )
        message = self.message()
        self.assertEqual(message.name, ["a", "b", "c", "x", "y", "z"])
        self.assertEqual(message.position[3:], (1.5, 0.0, 0.0))
        self.assertEqual(message.velocity[3:], (2.5, 0.0, 0.0))
        self.assertEqual(message.effort[3:], (3.5, 0.0, 0.5))

    def test_extra_joints_alone(self):
        self.start(joints=[], extra_joints=[{"name": "x", "position": 1.5}])
        message = self.message()
        self.assertEqual((message.name, message.position), (["x"], (1.5,)))

    def test_extra_joints_that_are_no_list(self):
        self.start(extra_joints={"name": "x"})
        self.assertEqual(self.message().name, ["a", "b", "c"])

    def test_it_claims_nothing(self):
        self.start()
        self.assertEqual(self.loop.manager.controllers[0].info.claimed_resources[0].resources, ())


if __name__ == "__main__":
    rospy.init_node("joint_state_controller_rostest")
    rostest.rosrun("joint_state_controller", "joint_state_controller", JointStateControllerTest)
