#!/usr/bin/env python3
"""Finding controller managers and filtering their controllers."""

import unittest

import rospy
import rostest
from controller_manager_msgs import utils
from controller_manager_msgs.msg import ControllerState, HardwareInterfaceResources
from controller_manager_tests import ControllerManagerDummy

CONTROLLERS = [
    ControllerState("foo", "running", "pos/Controller", [HardwareInterfaceResources("Pos", ["a", "b"])]),
    ControllerState(
        "bar", "stopped", "eff/Controller", [HardwareInterfaceResources("Eff", ["b"]), HardwareInterfaceResources("Vel", ["c"])]
    ),
    ControllerState("foobar", "running", "pos/Other", []),
]


def names(controllers):
    return [controller.name for controller in controllers]


class DiscoveryTest(unittest.TestCase):
    def manager(self, *arguments, **keywords):
        dummy = ControllerManagerDummy(*arguments, **keywords)
        self.addCleanup(dummy.shutdown)
        return dummy

    def test_complete_managers_are_found(self):
        self.assertEqual(utils.get_controller_managers(), [])
        self.manager("/controller_manager")
        self.manager("/arm/controller_manager")
        found = ["/arm/controller_manager", "/controller_manager"]
        self.assertEqual(utils.get_controller_managers(), found)
        self.assertEqual(utils.get_controller_managers("/arm"), found[:1])
        self.assertEqual(utils.get_controller_managers(initial_guess=found), found)
        self.assertTrue(utils.is_controller_manager("/arm/controller_manager"))
        self.assertIn("/arm/controller_manager", utils.describe_controller_managers())

    def test_services_in_the_root_namespace(self):
        self.manager("")
        self.assertEqual(utils.get_controller_managers(), ["/"])
        self.assertEqual(utils.get_controller_managers(initial_guess=["/"]), ["/"])
        self.assertTrue(utils.is_controller_manager("/"))

    def test_incomplete_or_wrong_ones_are_not(self):
        for index, name in enumerate(ControllerManagerDummy.SERVICES):
            self.manager(f"/incomplete{index}", without=[name])
            self.manager(f"/wrong{index}", wrong_type=name)
            self.assertFalse(utils.is_controller_manager(f"/incomplete{index}"), name)
            self.assertFalse(utils.is_controller_manager(f"/wrong{index}"), name)
        self.assertEqual(utils.get_controller_managers(), [])
        self.assertIn("no controller manager at all", utils.describe_controller_managers())

    def test_a_guess_is_believed_while_it_is_there(self):
        self.manager("/incomplete", without=["reload_controller_libraries"])
        self.manager("/whole")
        self.assertEqual(utils.get_controller_managers(initial_guess=["/gone", "/incomplete"]), ["/incomplete", "/whole"])

    def test_answers_of_the_double_can_be_changed(self):
        double = self.manager("/told")
        double.list_ctrl_resp.controller = CONTROLLERS
        self.assertEqual(names(utils.ControllerLister("/told")()), ["foo", "bar", "foobar"])
        double.list_ctrl.shutdown("on purpose")
        self.assertFalse(utils.is_controller_manager("/told"))

    def test_lister_follows_what_comes_and_goes(self):
        lister = utils.ControllerManagerLister()
        self.assertEqual(lister(), [])
        first = self.manager("/a/controller_manager")
        self.assertEqual(lister(), ["/a/controller_manager"])
        self.manager("/b/controller_manager")
        first.shutdown()
        self.assertEqual(lister(), ["/b/controller_manager"])

    def test_controller_lister_survives_a_restart(self):
        lister = utils.ControllerLister("/c/controller_manager")
        self.assertEqual(lister(), [])
        dummy = self.manager("/c/controller_manager")
        self.assertEqual(lister(), [])
        dummy.shutdown()
        self.assertEqual(lister(), [])

    def test_filters(self):
        self.assertEqual(names(utils.filter_by_name(CONTROLLERS, "foo")), ["foo"])
        self.assertEqual(names(utils.filter_by_name(CONTROLLERS, "foo", match_substring=True)), ["foo", "foobar"])
        self.assertEqual(names(utils.filter_by_type(CONTROLLERS, "pos", match_substring=True)), ["foo", "foobar"])
        self.assertEqual(names(utils.filter_by_type(CONTROLLERS, "pos")), [])
        self.assertEqual(names(utils.filter_by_state(CONTROLLERS, "running")), ["foo", "foobar"])
        self.assertEqual(names(utils.filter_by_hardware_interface(CONTROLLERS, "Vel")), ["bar"])
        self.assertEqual(names(utils.filter_by_resources(CONTROLLERS, ["b"])), ["foo", "bar"])
        self.assertEqual(names(utils.filter_by_resources(CONTROLLERS, ["b", "c"])), ["bar"])
        self.assertEqual(names(utils.filter_by_resources(CONTROLLERS, ["a", "c"], match_any=True)), ["foo", "bar"])
        self.assertEqual(names(utils.filter_by_resources(CONTROLLERS, ["b"], hardware_interface="Eff")), ["bar"])

    def test_controllers_on_the_parameter_server(self):
        found = utils.get_rosparam_controller_names("/")
        self.assertIn("my_controller1", found)
        for no_controller in ("typeless", "elsewhere", "controller_groups", "rosdistro"):
            self.assertNotIn(no_controller, found)
        self.assertEqual(utils.get_rosparam_controller_names("/elsewhere"), ["lost"])
        self.assertEqual(utils.get_rosparam_controller_names("/no/such/place"), [])


if __name__ == "__main__":
    rospy.init_node("discovery_rostest")
    rostest.rosrun("controller_manager_tests", "discovery", DiscoveryTest)
