#!/usr/bin/env python3
"""Robot hardware of a third party that raises, at the start and in the loop: one line, nobody waits, nothing stays behind."""

import sys
import threading
import time

import rosgraph
import rospy
import rostest
import test_support
from gazebo_ros.plugin import PluginError
from gazebo_ros_control import plugin as plugin_module
from gazebo_ros_control.default_robot_hw_sim import DefaultRobotHWSim
from simulated_robot import Log, SimulatedRobot, joint, transmission, urdf
from std_msgs.msg import Empty

ROBOT = urdf(joint("j"), transmission("t", "j", "hardware_interface/EffortJointInterface"))
BROKEN = ROBOT.replace('name="robot"', 'name="broken"')
PARAMETERS = {"c": {"type": "effort_controllers/JointEffortController", "joint": "j"}}


class Fragile(DefaultRobotHWSim):
    """Raises where it is told to, and when its robot is called broken."""

    fails_in = ""

    def init_sim(self, namespace, nh, model, description, transmissions):
        nh.subscriber("left_behind", Empty, lambda message: None)
        if "broken" in description:
            return {}["no such key"]
        return super().init_sim(namespace, nh, model, description, transmissions)

    def read_sim(self, time, period):
        super().read_sim(time, period)
        if self.fails_in == "read_sim":
            raise ZeroDivisionError("by hand\nin two lines")

    def write_sim(self, time, period):
        super().write_sim(time, period)
        if self.fails_in == "write_sim":
            raise ZeroDivisionError("by hand\nin two lines")


def offered():
    """Services and subscribed topics below /robot."""
    _, subscribers, services = rosgraph.Master("/faults").getSystemState()
    return [name for name, _ in subscribers + services if name.startswith("/robot/")]


def until(condition):
    end = time.monotonic() + 60.0
    while not condition():
        assert time.monotonic() < end, "it does not happen"
        time.sleep(0.005)


class FaultsTest(test_support.TestCase):
    def setUp(self):
        find = plugin_module.find_sim
        self.addCleanup(setattr, plugin_module, "find_sim", find)
        plugin_module.find_sim = lambda name: Fragile

    def test_a_description_that_the_hardware_cannot_take(self):
        robot = SimulatedRobot(ROBOT, describe=False)
        rospy.set_param("/robot_description", BROKEN)
        with self.assertRaisesRegex(PluginError, r"Fragile cannot start: KeyError: 'no such key' \(.*:\d+\)$"):
            robot.load()
        self.assertEqual(offered(), [])

    def test_one_that_comes_late_and_then_a_better_one(self):
        with Log.recorded() as log, SimulatedRobot(ROBOT, describe=False, parameters=PARAMETERS) as robot:
            rospy.set_param("/robot_description", BROKEN)
            until(lambda: log.having("model 'model'", "KeyError", "Waiting for another description", level="ERROR"))
            self.assertEqual(offered(), [])
            robot.step(10)
            rospy.set_param("/robot_description", ROBOT)
            until(lambda: robot.manager is not None)
            robot.start("c")
            self.assertEqual(len(log.having("", level="ERROR")), 1, log.lines)

    def test_one_that_raises_in_the_loop_ends_what_waits_for_the_loop(self):
        for phase in ("read_sim", "write_sim"):
            with self.subTest(phase), Log.recorded() as log, SimulatedRobot(ROBOT, parameters=PARAMETERS) as robot:
                manager = robot.manager
                self.assertTrue(manager.load_controller("c"))
                robot.step(5)
                answers = []
                switch = threading.Thread(target=lambda: answers.append(manager.switch_controller(["c"], [])))
                switch.start()
                until(lambda: manager._switch is not None)
                robot.hw.fails_in = phase
                before = robot.world.time
                robot.step(3)
                self.assertAlmostEqual(robot.world.time - before, 0.003)
                switch.join(60.0)
                self.assertFalse(switch.is_alive())
                self.assertFalse(manager.load_controller("other"))
                until(lambda: offered() == [])
                until(lambda: not manager.controllers)
                lines = log.having("Fragile failed: ZeroDivisionError: by hand in two lines", level="ERROR")
                self.assertEqual((len(lines), lines[0].count("\n")), (1, 0))


if __name__ == "__main__":
    rospy.init_node("faults")
    rostest.rosrun("gazebo_ros_control", "faults", FaultsTest, sys.argv)
