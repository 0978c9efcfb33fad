#!/usr/bin/env python3
"""Forwarding controllers of all three interfaces: they share their code, so they share their test."""

import unittest

import rospy
import rostest
from controller_manager_tests.client import wait_until
from controller_manager_tests.loop import Loop
from std_msgs.msg import Float64, Float64MultiArray

SINGLE = {
    "position": "position_controllers/JointPositionController",
    "velocity": "velocity_controllers/JointVelocityController",
    "effort": "effort_controllers/JointEffortController",
}
GROUP = {
    "position": "position_controllers/JointGroupPositionController",
    "velocity": "velocity_controllers/JointGroupVelocityController",
    "effort": "effort_controllers/JointGroupEffortController",
}


class ForwardingTest(unittest.TestCase):
    def setUp(self):
        self.loop = Loop()
        self.addCleanup(self.loop.manager.shutdown)
        for name, position in zip("abc", (0.1, 0.2, 0.3)):
            self.loop.state[name].position = position
        for kind in SINGLE:
            rospy.set_param(f"/robot/{kind}", {"type": SINGLE[kind], "joint": "a"})
            rospy.set_param(f"/robot/{kind}_group", {"type": GROUP[kind], "joints": ["b", "c"]})

    def publish(self, name, message):
        publisher = rospy.Publisher(f"/robot/{name}/command", type(message), queue_size=1)
        wait_until(publisher.get_num_connections, f"controller {name} to listen")
        publisher.publish(message)
        self.addCleanup(publisher.unregister)

    def commanded(self, kind, expected):
        def reached():
            self.loop.cycle()
            return [self.loop.command(kind, name) for name in "abc"] == expected

        wait_until(reached, f"{kind} commands {expected}")

    def test_single(self):
        for kind, first in (("position", 0.1), ("velocity", 0.0), ("effort", 0.0)):
            self.loop.start(kind)
            self.commanded(kind, [first, 0.0, 0.0])
            self.publish(kind, Float64(0.7))
            self.commanded(kind, [0.7, 0.0, 0.0])
            self.loop.switch([], [kind])
            self.assertEqual(self.loop.command(kind, "a"), 0.7, "the last command stays")
            self.loop.switch([kind])
            self.commanded(kind, [first, 0.0, 0.0])
            self.loop.switch([], [kind])

    def test_group(self):
        for kind, first in (("position", [0.2, 0.3]), ("velocity", [0.0, 0.0]), ("effort", [0.0, 0.0])):
            name = kind + "_group"
            self.loop.start(name)
            self.commanded(kind, [0.0, *first])
            self.publish(name, Float64MultiArray(data=[0.5, 0.6]))
            self.commanded(kind, [0.0, 0.5, 0.6])
            for wrong in ([], [9.0], [9.0, 9.0, 9.0]):
                self.publish(name, Float64MultiArray(data=wrong))
            self.publish(name, Float64MultiArray(data=[0.8, 0.9]))
            self.commanded(kind, [0.0, 0.8, 0.9])
            self.loop.switch([], [name])

    def test_a_message_that_came_while_stopped_does_not_count(self):
        self.assertTrue(self.loop.load("effort"))
        self.publish("effort", Float64(5.0))
        wait_until(lambda: self.loop.controller("effort")._command == 5.0, "the message")
        self.loop.switch(["effort"])
        self.loop.cycle(3)
        self.assertEqual(self.loop.command("effort", "a"), 0.0)

    def test_wrong_size_never_reaches_a_joint(self):
        self.loop.start("position_group")
        controller = self.loop.controller("position_group")
        for wrong in ([], [9.0], [9.0, 9.0, 9.0]):
            controller._receive(Float64MultiArray(data=wrong))
            self.loop.cycle()
            self.assertEqual([self.loop.command("position", name) for name in "bc"], [0.2, 0.3])

    def test_what_makes_them_fail_to_load(self):
        for parameters in (
            {"type": SINGLE["position"]},
            {"type": SINGLE["position"], "joint": "nope"},
            {"type": SINGLE["position"], "joint": 5},
            {"type": GROUP["position"]},
            {"type": GROUP["position"], "joints": []},
            {"type": GROUP["position"], "joints": ["a", 1]},
            {"type": GROUP["position"], "joints": "a"},
            {"type": GROUP["position"], "joints": ["nope"]},
        ):
            rospy.set_param("/robot/wrong", parameters)
            self.assertFalse(self.loop.load("wrong"), parameters)
            rospy.delete_param("/robot/wrong")

    def test_topics_go_with_the_controller(self):
        self.loop.start("position")
        self.publish("position", Float64(0.0))
        self.loop.switch([], ["position"])
        self.assertTrue(self.loop.manager.unload_controller("position"))
        publisher = rospy.Publisher("/robot/position/command", Float64, queue_size=1)
        wait_until(lambda: publisher.get_num_connections() == 0, "the controller to stop listening")


if __name__ == "__main__":
    rospy.init_node("position_controllers_rostest")
    rostest.rosrun("position_controllers", "position_controllers", ForwardingTest)
