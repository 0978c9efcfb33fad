#!/usr/bin/env python3
"""PID controllers on a joint of unit mass."""

import math
import unittest

import rospy
import rostest
from control_msgs.msg import JointControllerState
from controller_manager_tests.client import wait_until
from controller_manager_tests.loop import Loop
from dynamic_reconfigure.client import Client
from std_msgs.msg import Float64, Float64MultiArray

URDF = """<robot name="r"><link name="l"/>
  <joint name="a" type="revolute"><limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
  <joint name="b" type="continuous"/>
  <joint name="c" type="prismatic"><limit lower="0" upper="10" effort="1" velocity="1"/></joint></robot>"""
GAINS = {"p": 40.0, "d": 12.0}


def position(joint, **gains):
    return {"type": "effort_controllers/JointPositionController", "joint": joint, "pid": {**GAINS, **gains}}


class EffortControllersTest(unittest.TestCase):
    def setUp(self):
        rospy.set_param("/robot_description", URDF)
        self.loop = Loop()
        self.addCleanup(self.loop.manager.shutdown)

    def start(self, **parameters):
        rospy.set_param("/robot/pid_controller", parameters)
        self.addCleanup(rospy.delete_param, "/robot/pid_controller")
        self.loop.start("pid_controller")
        return self.loop.controller("pid_controller")

    def simulate(self, seconds, joint="a"):
        state = self.loop.state[joint]
        for _ in range(round(seconds / self.loop.dt)):
            self.loop.cycle()
            state.velocity += max(-10.0, min(10.0, self.loop.command("effort", joint))) * self.loop.dt
            state.position += state.velocity * self.loop.dt

    def test_position_reaches_its_targets(self):
        controller = self.start(**position("a"))
        publisher = rospy.Publisher("/robot/pid_controller/command", Float64, queue_size=1)
        wait_until(publisher.get_num_connections, "the controller to listen")
        for target, reached in ((0.8, 0.8), (-0.5, -0.5), (7.0, 1.0), (-7.0, -1.0), (0.0, 0.0)):
            publisher.publish(target)
            wait_until(lambda: controller._target == target, "the message")
            self.simulate(5.0)
            self.assertAlmostEqual(self.loop.state["a"].position, reached, delta=0.01)

    def test_it_starts_where_the_joint_is(self):
        self.loop.state["a"].position = 0.4
        self.start(**position("a"))
        self.loop.cycle()
        self.assertEqual(self.loop.command("effort", "a"), 0.0)

    def test_a_joint_outside_its_limits_is_brought_back(self):
        self.loop.state["a"].position = 1.5
        self.start(**position("a"))
        self.simulate(5.0)
        self.assertAlmostEqual(self.loop.state["a"].position, 1.0, delta=0.01)

    def test_a_continuous_joint_takes_the_short_way(self):
        self.loop.state["b"].position = 3.0
        controller = self.start(**position("b"))
        controller._receive(Float64(-3.0))
        self.simulate(5.0, "b")
        self.assertAlmostEqual(self.loop.state["b"].position, 2.0 * math.pi - 3.0, delta=0.01)

    def test_a_prismatic_joint_knows_no_turns(self):
        controller = self.start(**position("c"))
        controller._receive(Float64(9.0))
        self.simulate(8.0, "c")
        self.assertAlmostEqual(self.loop.state["c"].position, 9.0, delta=0.01)

    def test_velocity(self):
        controller = self.start(type="effort_controllers/JointVelocityController", joint="a", pid={"p": 5.0})
        self.loop.cycle()
        self.assertEqual(self.loop.command("effort", "a"), 0.0)
        controller._receive(Float64(2.0))
        self.loop.cycle()
        self.assertEqual(self.loop.command("effort", "a"), 10.0)
        self.simulate(3.0)
        self.assertAlmostEqual(self.loop.state["a"].velocity, 2.0, delta=0.01)

    def test_velocity_interface(self):
        controller = self.start(type="velocity_controllers/JointPositionController", joint="a", pid={"p": 3.0})
        controller._receive(Float64(0.5))
        self.loop.cycle()
        self.assertEqual(self.loop.command("velocity", "a"), 1.5)

    def test_group(self):
        controller = self.start(
            type="effort_controllers/JointGroupPositionController", joints=["a", "c"], a={"pid": {"p": 2.0}}, c={"pid": {"p": 3.0}}
        )
        controller._receive(Float64MultiArray(data=[5.0, 1.0]))
        self.loop.cycle()
        self.assertEqual((self.loop.command("effort", "a"), self.loop.command("effort", "c")), (2.0, 3.0))
        controller._receive(Float64MultiArray(data=[0.0]))
        self.loop.cycle()
        self.assertEqual(self.loop.command("effort", "c"), 3.0, "a message of the wrong size is dropped")

    def test_nan_gives_no_effort(self):
        controller = self.start(**position("a"))
        controller._receive(Float64(0.5))
        self.loop.cycle(3)
        controller._receive(Float64(math.nan))
        self.loop.cycle()
        self.assertEqual(self.loop.command("effort", "a"), 0.0)
        self.simulate(1.0)
        controller._receive(Float64(0.5))
        self.simulate(5.0)
        self.assertAlmostEqual(self.loop.state["a"].position, 0.5, delta=0.01)

    def test_state_topic(self):
        controller = self.start(**position("a", i=1.0, i_clamp=2.0, antiwindup=True))
        messages = []
        subscriber = rospy.Subscriber("/robot/pid_controller/state", JointControllerState, messages.append)
        self.addCleanup(subscriber.unregister)
        wait_until(lambda: controller._state.has_subscribers, "the subscriber")
        controller._receive(Float64(7.0))
        self.loop.state["a"].position, self.loop.state["a"].velocity = 0.25, 0.5
        for _ in range(100):
            self.loop.cycle()
        wait_until(lambda: len(messages) >= 10, "ten messages")
        self.assertEqual(len(messages), 10, "every tenth update")
        message = messages[-1]
        self.assertEqual((message.set_point, message.process_value, message.process_value_dot, message.error), (1.0, 0.25, 0.5, 0.75))
        self.assertEqual(
            (message.p, message.i, message.d, message.i_clamp, message.antiwindup, message.time_step),
            (40.0, 1.0, 12.0, 2.0, True, self.loop.dt),
        )
        self.assertGreater(message.command, 30.0)

    def test_gains_while_it_runs(self):
        controller = self.start(**position("a"))
        controller._receive(Float64(1.0))
        client = Client("/robot/pid_controller/pid", timeout=20)
        self.addCleanup(client.close)
        client.update_configuration({"p": 7.0, "d": 0.0})
        self.loop.cycle(2)
        self.assertEqual(self.loop.command("effort", "a"), 7.0)
        self.assertEqual(rospy.get_param("/robot/pid_controller/pid/p"), 7.0)

    def test_what_makes_them_fail_to_load(self):
        good = position("a")
        for wrong in (
            {**good, "pid": {}},
            {**good, "pid": {"p": "much"}},
            {**good, "joint": "nope"},
            {key: value for key, value in good.items() if key != "joint"},
        ):
            rospy.set_param("/robot/pid_controller", wrong)
            self.assertFalse(self.loop.load("pid_controller"), wrong)
            rospy.delete_param("/robot/pid_controller")
        rospy.set_param("/robot/pid_controller", good)
        for description in ('<robot name="r"><joint name="z" type="fixed"/></robot>', "<robot>"):
            rospy.set_param("/robot_description", description)
            self.assertFalse(self.loop.load("pid_controller"))
        rospy.delete_param("/robot_description")
        self.assertFalse(self.loop.load("pid_controller"))


if __name__ == "__main__":
    rospy.init_node("effort_controllers_rostest")
    rostest.rosrun("effort_controllers", "effort_controllers", EffortControllersTest)
