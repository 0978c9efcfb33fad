#!/usr/bin/env python3
"""A robot of whose joints some are published by nobody, as those of a gripper that is not simulated."""

import unittest

import rospy
import rostest
from moveit_commander.session import session
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import JointState
from test_support.waiting import wait_until

LEFT, RIGHT = ([f"{side}_{number}" for number in range(1, 7)] for side in ("left", "right"))


class Unheard(unittest.TestCase):
    def setUp(self):
        self.values, self.lines = {}, []
        self.publisher = rospy.Publisher("joint_states", JointState, queue_size=5)
        self.log = rospy.Subscriber("/rosout", Log, lambda line: self.lines.append(line.msg))
        self.timer = rospy.Timer(rospy.Duration(0.02), self.publish)
        self.addCleanup(self.timer.shutdown)
        self.addCleanup(self.log.unregister)

    def publish(self, _):
        values = dict(self.values)
        message = JointState(name=list(values), position=list(values.values()))
        message.header.stamp = rospy.Time.now()
        if values:
            self.publisher.publish(message)

    def told(self, words):
        return sum(words in line for line in self.lines)

    def test_the_state_is_given_without_them_and_with_them_once_they_are_heard(self):
        robot = session("robot_description")
        self.assertIsNone(robot.state(0.2))  # nobody publishes anything
        self.values.update({name: 0.5 for name in LEFT})
        state = robot.state(2.0)
        self.assertEqual([state.get(name) for name in LEFT + RIGHT], 6 * [0.5] + 6 * [0.0])
        self.assertIsNotNone(robot.state(0.5))
        wait_until(lambda: self.told("Nobody publishes the joints 'right_1', 'right_2'") == 1, "the line about the other arm")

        self.values.update({name: -0.25 for name in RIGHT})
        wait_until(lambda: robot.state().get("right_6") == -0.25, "the other arm's values")
        for name in RIGHT:  # heard of, and then no more: that is not current
            self.values.pop(name)
        wait_until(lambda: robot.state(0.2) is None, "no state while an arm is silent")
        self.assertEqual(self.told("Nobody publishes the joints"), 1)


if __name__ == "__main__":
    rospy.init_node("unheard")
    rostest.rosrun("moveit_commander", "unheard", Unheard)
