#!/usr/bin/env python3
"""The functions that other programs import."""

import contextlib
import io
import unittest

import rospy
import rostest
from controller_manager import controller_manager_interface as interface
from controller_manager_tests.client import ManagerClient


def printed(function, *arguments, **keywords):
    """(return value, what was printed)"""
    with contextlib.redirect_stdout(io.StringIO()) as output:
        value = function(*arguments, **keywords)
    return value, output.getvalue()


class PythonInterfaceTest(unittest.TestCase):
    def setUp(self):
        self.cm = ManagerClient()
        self.addCleanup(self.cm.clear)

    def test_return_values_and_texts(self):
        self.assertEqual(printed(interface.load_controller, "my_controller1"), (True, "Loaded 'my_controller1'\n"))
        self.assertEqual(printed(interface.load_controller, "nope"), (False, "Error when loading 'nope'\n"))
        self.assertEqual(printed(interface.start_controller, "my_controller1"), (True, "Started ['my_controller1'] successfully\n"))
        self.assertEqual(
            printed(interface.start_controllers, ["my_controller1"]), (False, "Error when starting ['my_controller1'] and stopping []\n")
        )
        self.assertEqual(printed(interface.unload_controller, "my_controller1"), (False, "Error when unloading 'my_controller1'\n"))
        interface.load_controller("my_controller2")
        self.assertEqual(
            printed(interface.start_stop_controllers, ["my_controller2"], ["my_controller1"]),
            (True, "Started ['my_controller2'] successfully\nStopped ['my_controller1'] successfully\n"),
        )
        self.assertEqual(
            printed(interface.start_stop_controllers, start_controllers=["x"], stop_controllers=["y"]),
            (False, "Error when starting ['x'] and stopping ['y']\n"),
        )
        self.assertEqual(printed(interface.stop_controllers, ["my_controller2"]), (True, "Stopped ['my_controller2'] successfully\n"))
        self.assertEqual(
            printed(interface.stop_controller, "my_controller2"), (False, "Error when starting [] and stopping ['my_controller2']\n")
        )
        self.assertEqual(printed(interface.unload_controller, "my_controller1"), (True, "Unloaded 'my_controller1' successfully\n"))

    def test_reload(self):
        interface.load_controller("my_controller1")
        interface.load_controller("my_controller3")
        interface.start_controller("my_controller1")
        self.assertEqual(
            printed(interface.reload_libraries, False),
            (False, "Restore: False\nFailed to reload libraries. Do you still have controllers loaded?\n"),
        )
        value, text = printed(interface.reload_libraries, True, restore=True)
        self.assertTrue(value)
        self.assertEqual(text, "Restore: True\nSuccessfully reloaded libraries\nControllers restored to original state\n")
        self.assertEqual(self.cm.states(), {"my_controller1": "running", "my_controller3": "initialized"})
        self.assertEqual(printed(interface.reload_libraries, force_kill=True)[0], True)
        self.assertEqual(self.cm.states(), {})

    def test_lists(self):
        self.assertEqual(printed(interface.list_controllers)[1], "No controllers are loaded in mechanism control\n")
        interface.load_controller("vel_eff")
        self.assertEqual(
            printed(interface.list_controllers)[1],
            "'vel_eff' - 'hardware_interface::VelocityJointInterface+hardware_interface::EffortJointInterface' ( initialized )\n",
        )
        self.assertIn("controller_manager_tests/EffortTestController", printed(interface.list_controller_types)[1].split("\n"))


if __name__ == "__main__":
    rospy.init_node("python_interface_rostest")
    rostest.rosrun("controller_manager_tests", "python_interface", PythonInterfaceTest)
