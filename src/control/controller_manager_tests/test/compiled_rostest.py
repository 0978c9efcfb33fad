#!/usr/bin/env python3
"""Controllers in C++ under Python's manager: beside those in Python, and what goes wrong with them."""

import os
import signal
import subprocess
import unittest

import rospy
import rostest
from controller_manager_tests.client import ManagerClient, sends
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64
from test_support import wait_until


class CompiledTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.lines, cls.joints = [], {}
        cls.subscribers = [rospy.Subscriber("/rosout", Log, cls.hear), rospy.Subscriber("/joint_states", JointState, cls.see)]
        ManagerClient().states()  # the robot is there
        wait_until(lambda: sends("/dummy_robot", "/rosout"), "the robot's log")
        manager = ManagerClient()
        assert manager.load("compiled")  # from now on there is roscpp in the robot
        wait_until(lambda: sends("/dummy_robot_compiled", "/rosout"), "the log of compiled code")

    @classmethod
    def hear(cls, message):
        if message.name.startswith("/dummy_robot") and message.level >= Log.WARN:
            cls.lines.append(message.msg)

    @classmethod
    def see(cls, message):
        cls.joints = dict(zip(message.name, zip(message.velocity, message.effort)))

    def setUp(self):
        self.cm = ManagerClient()
        self.clear()
        self.addCleanup(self.clear)
        del self.lines[:]

    def clear(self):
        """Unload all but the states: their subscriber here would wait long to be connected again."""
        states = self.cm.states()
        others = [name for name in states if name != "states"]
        self.assertTrue(self.cm.switch(stop=[name for name in others if states[name] == "running"]))
        self.assertTrue(all([self.cm.unload(name) for name in others]))
        if "states" not in states:
            self.assertTrue(self.cm.load("states") and self.cm.start("states"))

    def effort(self, value, joint="hiDOF_joint1"):
        wait_until(lambda: self.joints.get(joint, (None, None))[1] == value, f"an effort of {value} on {joint}")

    def says(self, *parts):
        """Exactly one line of Python's half says all of it."""
        wait_until(lambda: any(all(part in line for part in parts) for line in self.lines), f"{parts} in {self.lines}")
        line = next(line for line in self.lines if parts[0] in line)
        self.assertNotIn("Traceback", line)
        self.assertNotIn("\n", line)

    def refused(self, name, *parts):
        self.assertFalse(self.cm.load(name))
        self.says(f"'{name}'", *parts)

    # -- life ----------------------------------------------------------------------------------------------------------------------

    def test_beside_a_controller_in_python(self):
        self.assertTrue(self.cm.load("compiled") and self.cm.load("my_controller3"))
        self.assertTrue(self.cm.start("compiled", "my_controller3"))
        self.effort(2.0)
        publisher = rospy.Publisher("/compiled/effort", Float64, queue_size=1, latch=True)
        publisher.publish(5.0)
        self.effort(5.0)
        publisher.unregister()
        listed = {controller.name: controller for controller in self.cm.controllers()}
        claimed = listed["compiled"].claimed_resources[0]
        self.assertEqual(
            (claimed.hardware_interface, list(claimed.resources)), ("hardware_interface::EffortJointInterface", ["hiDOF_joint1"])
        )
        self.assertEqual((listed["compiled"].state, listed["my_controller3"].state), ("running", "running"))
        self.assertFalse(self.cm.unload("compiled"))
        self.assertTrue(self.cm.stop("compiled"))
        self.effort(0.0)
        self.assertTrue(self.cm.unload("compiled"))
        wait_until(lambda: "/compiled/time" not in dict(rospy.get_published_topics()), "its topic to go")

    def test_conflicts_between_the_languages(self):
        self.assertTrue(self.cm.load("compiled") and self.cm.load("my_controller1"))
        self.assertTrue(self.cm.start("my_controller1"))
        self.assertFalse(self.cm.start("compiled"))
        self.assertTrue(self.cm.switch(["compiled"], ["my_controller1"]))
        self.assertFalse(self.cm.start("my_controller1"))

    def test_several_interfaces(self):
        self.assertTrue(self.cm.load("compiled_multi") and self.cm.start("compiled_multi"))
        claimed = self.cm.controllers()[-1].claimed_resources
        self.assertEqual(
            [(entry.hardware_interface, list(entry.resources)) for entry in claimed],
            [("hardware_interface::JointStateInterface", []), ("hardware_interface::VelocityJointInterface", ["test_joint1"])],
        )

    def test_zz_reload(self):
        """Comes last: the joint states are unloaded too."""
        self.assertTrue(self.cm.load("compiled") and self.cm.start("compiled"))
        self.assertFalse(self.cm.reload(False))
        self.assertTrue(self.cm.reload(True))
        self.assertTrue(self.cm.load("compiled") and self.cm.start("compiled"))
        rospy.wait_for_message("/compiled/time", Float64, 60.0)

    # -- what goes wrong -------------------------------------------------------------------------------------------------------------

    def test_what_cannot_be_loaded(self):
        self.refused("compiled_unknown_joint", "hardware_interface::HardwareInterfaceException", "no_such_joint", "hiDOF_joint1")
        self.refused("compiled_constructor", "its constructor raised std::runtime_error: on purpose in the constructor")
        self.refused("compiled_other", "exports no controller", "PLUGINLIB_EXPORT_CLASS(controller_manager_tests::CompiledOther")
        self.refused("compiled_base", "base_class_type", "controller_interface::ControllerBase")
        self.refused("compiled_unresolved", "lacks the symbol controller_manager_tests::not_linked(double)", "target_link_libraries")
        self.refused("compiled_not_built", "libcontroller_manager_tests_not_built.so is not found", "is the package built")

    def fault(self, where):
        rospy.set_param("/fault", {"type": "controller_manager_tests/CompiledFault", "fault": where})

    def test_init(self):
        self.fault("init")
        self.refused("fault", "std::runtime_error: on purpose in init")
        self.fault("refuse")
        self.refused("fault", "init() returned false")

    def test_exceptions_of_the_loop(self):
        for where, text in (
            ("starting", "std::runtime_error: on purpose in starting"),
            ("stopping", "on purpose in stopping"),
            ("update", "on purpose in update"),
            ("number", "an exception of type int"),
        ):
            del self.lines[:]
            self.fault(where)
            self.assertTrue(self.cm.load("fault"))
            self.assertEqual(self.cm.start("fault"), where != "starting")
            if where == "stopping":
                self.cm.stop("fault")
            self.says("Controller 'fault'", text)
            wait_until(lambda: self.cm.states()["fault"] == "aborted", "its state")
            self.assertTrue(self.cm.unload("fault"))
        self.assertEqual(self.cm.states()["states"], "running")

    def test_a_controller_that_stops_itself(self):
        self.fault("stop")
        self.assertTrue(self.cm.load("fault") and self.cm.start("fault"))
        wait_until(lambda: self.cm.states()["fault"] == "stopped", "its state")
        self.assertEqual([line for line in self.lines if "fault" in line], [])

    def test_one_that_blocks_is_named(self):
        self.fault("block")
        self.assertTrue(self.cm.load("fault"))
        self.cm.switch(["fault"])
        self.says("controller 'fault' (controller_manager_tests/CompiledFault", "update() for 5 s")

    # Crashes: each in a robot of its own, which dies.

    def test_a_crash_is_named(self):
        self.assertIn("crashed in its update(): segmentation fault", self.last_line_of("segmentation fault", -signal.SIGSEGV))

    def test_an_abort_is_named(self):
        self.assertIn("crashed in its update(): aborted", self.last_line_of("abort", -signal.SIGABRT))

    def test_an_exit_is_named(self):
        self.assertIn("called exit() in its update()", self.last_line_of("exit", 3))

    def test_a_crash_of_a_destructor_is_named(self):
        self.assertIn("crashed in its destructor: aborted", self.last_line_of("destructor", -signal.SIGABRT))

    def test_a_crash_of_a_thread_is_named(self):
        self.assertIn("libcontroller_manager_tests.so crashed in a thread", self.last_line_of("thread", -signal.SIGSEGV))

    def last_line_of(self, fault, code):
        namespace = f"/dying_by_{fault.replace(' ', '_')}"
        rospy.set_param(f"{namespace}/fault", {"type": "controller_manager_tests/CompiledFault", "fault": fault})
        robot = subprocess.Popen(
            ["rosrun", "controller_manager_tests", "dummy_robot"],
            stderr=subprocess.PIPE,
            text=True,
            env=dict(os.environ, ROS_NAMESPACE=namespace),
        )
        cm = ManagerClient(namespace)
        try:
            self.assertTrue(cm.load("fault"))
            cm.unload("fault") if fault == "destructor" else cm.start("fault")
        except rospy.ServiceException:
            pass  # it died of it
        try:
            errors = robot.communicate(timeout=30)[1]
        except subprocess.TimeoutExpired:
            robot.kill()
            raise
        self.assertEqual(robot.returncode, code, errors)
        return next((line for line in errors.splitlines() if "[FATAL]" in line), errors)


if __name__ == "__main__":
    rospy.init_node("compiled_rostest")
    rostest.rosrun("controller_manager_tests", "compiled", CompiledTest)
