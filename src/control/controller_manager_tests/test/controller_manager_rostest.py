#!/usr/bin/env python3
"""The services of a controller manager, as clients see them."""

import unittest

import rospy
import rostest
from controller_manager_tests.client import BEST_EFFORT, STRICT, ManagerClient

EFFORT = "hardware_interface::EffortJointInterface"
VELOCITY = "hardware_interface::VelocityJointInterface"


class ControllerManagerTest(unittest.TestCase):
    def setUp(self):
        self.cm = ManagerClient()
        self.addCleanup(self.cm.clear)

    def load(self, *names):
        for name in names:
            self.assertTrue(self.cm.load(name), name)

    def test_load_and_unload(self):
        names = ["my_controller1", "vel_eff", "pos_eff_opt"]
        self.load(*names)
        self.assertEqual(self.cm.states(), dict.fromkeys(names, "initialized"))
        for name in names:
            self.assertTrue(self.cm.unload(name))
        self.assertEqual(self.cm.states(), {})

    def test_what_cannot_be_loaded(self):
        for name in (
            "no_such_name",
            "typeless",
            "number_as_type",
            "misspelled",
            "compiled_unresolved",
            "missing_module",
            "no_interface",
            "unknown_joint",
            "pos_eff",
            "broken_init",
            "no good name",
            "lost",
        ):
            self.assertFalse(self.cm.load(name), name)
        self.assertEqual(self.cm.states(), {})
        self.assertFalse(self.cm.unload("my_controller1"))

    def test_load_twice(self):
        self.load("my_controller1")
        self.assertFalse(self.cm.load("my_controller1"))
        self.assertEqual(self.cm.states(), {"my_controller1": "initialized"})

    def test_an_absolute_name(self):
        self.load("/elsewhere/lost")
        self.assertTrue(self.cm.start("/elsewhere/lost"))
        self.assertEqual(self.cm.states(), {"/elsewhere/lost": "running"})

    def test_switch(self):
        self.load("my_controller1", "vel_eff")
        self.assertTrue(self.cm.start("my_controller1"))
        self.assertTrue(self.cm.stop("my_controller1"))
        self.assertTrue(self.cm.start("vel_eff"))
        self.assertTrue(self.cm.switch(["my_controller1"], ["vel_eff"]))
        self.assertEqual(self.cm.states(), {"my_controller1": "running", "vel_eff": "stopped"})

    def test_unknown_names(self):
        self.load("my_controller1")
        self.assertFalse(self.cm.switch(["no_such_name"], []))
        self.assertFalse(self.cm.switch([], ["no_such_name"]))
        self.assertFalse(self.cm.switch(["my_controller1", "no_such_name"], []))
        self.assertEqual(self.cm.states(), {"my_controller1": "initialized"}, "all or nothing")
        self.assertTrue(self.cm.switch(["no_such_name"], ["nor_this"], BEST_EFFORT))
        self.assertTrue(self.cm.switch(["my_controller1", "no_such_name"], [], BEST_EFFORT))
        self.assertEqual(self.cm.states(), {"my_controller1": "running"})

    def test_nothing_to_switch(self):
        for strictness in (STRICT, BEST_EFFORT, 0):
            self.assertTrue(self.cm.switch([], [], strictness))

    def test_conflicts(self):
        self.load("my_controller1", "my_controller2", "self_conflict")
        for strictness in (STRICT, BEST_EFFORT):
            self.assertFalse(self.cm.switch(["my_controller1", "my_controller2"], [], strictness))
            self.assertFalse(self.cm.switch(["self_conflict"], [], strictness))
        self.assertTrue(self.cm.start("my_controller1"))
        self.assertFalse(self.cm.start("my_controller2"))
        self.assertTrue(self.cm.switch(["my_controller2"], ["my_controller1"], BEST_EFFORT))
        self.assertEqual(self.cm.states(), {"my_controller1": "stopped", "my_controller2": "running", "self_conflict": "initialized"})

    def test_what_is_done_already(self):
        self.load("my_controller1", "my_controller3")
        self.assertTrue(self.cm.start("my_controller1"))
        self.assertFalse(self.cm.start("my_controller1", "my_controller3"))
        self.assertFalse(self.cm.stop("my_controller3"))
        self.assertEqual(self.cm.states()["my_controller3"], "initialized")
        self.assertTrue(self.cm.switch(["my_controller1", "my_controller3"], [], BEST_EFFORT))
        self.assertTrue(self.cm.switch([], ["my_controller1", "my_controller3"], BEST_EFFORT))
        self.assertTrue(self.cm.switch([], ["my_controller1", "my_controller3"], BEST_EFFORT))
        self.assertEqual(set(self.cm.states().values()), {"stopped"})

    def test_both_lists(self):
        self.load("my_controller1")
        self.assertTrue(self.cm.switch(["my_controller1"], ["my_controller1"], BEST_EFFORT), "not running: it starts")
        self.assertEqual(self.cm.states(), {"my_controller1": "running"})
        for strictness in (STRICT, BEST_EFFORT):
            self.assertFalse(self.cm.switch(["my_controller1"], ["my_controller1"], strictness))
        self.assertEqual(self.cm.states(), {"my_controller1": "running"})

    def test_stop_before_unload(self):
        self.load("my_controller1")
        self.assertTrue(self.cm.start("my_controller1"))
        self.assertFalse(self.cm.unload("my_controller1"))
        self.assertTrue(self.cm.stop("my_controller1"))
        self.assertTrue(self.cm.unload("my_controller1"))

    def test_types(self):
        types = self.cm.types()
        self.assertEqual(types.types, sorted(types.types))
        self.assertEqual(len(types.types), len(types.base_classes))
        pairs = dict(zip(types.types, types.base_classes))
        for name in (
            "controller_manager_tests/EffortTestController",
            "joint_state_controller/JointStateController",
            "position_controllers/JointPositionController",
            "controller_manager_tests/CompiledController",
        ):
            self.assertEqual(pairs[name], "controller_interface::ControllerBase")

    def test_list(self):
        self.load("my_controller1", "vel_eff", "states")
        self.assertTrue(self.cm.start("my_controller1"))
        first, second, third = self.cm.controllers()
        self.assertEqual(
            (first.name, first.state, first.type), ("my_controller1", "running", "controller_manager_tests/EffortTestController")
        )
        self.assertEqual(
            [(c.hardware_interface, c.resources) for c in first.claimed_resources], [(EFFORT, ["hiDOF_joint1", "hiDOF_joint2"])]
        )
        self.assertEqual(
            [(c.hardware_interface, c.resources) for c in second.claimed_resources],
            [(VELOCITY, ["test_joint1", "test_joint2"]), (EFFORT, ["test_joint4"])],
        )
        self.assertEqual(
            [(c.hardware_interface, c.resources) for c in third.claimed_resources], [("hardware_interface::JointStateInterface", [])]
        )

    def test_derived_controllers(self):
        self.load("extensible", "derived")
        self.assertTrue(self.cm.start("extensible"))
        self.assertFalse(self.cm.start("derived"), "both take hiDOF_joint1")
        self.assertTrue(self.cm.switch(["derived"], ["extensible"]))
        derived = self.cm.controllers()[1]
        self.assertEqual(
            [(c.hardware_interface, c.resources) for c in derived.claimed_resources],
            [(EFFORT, ["hiDOF_joint1"]), (VELOCITY, ["hiDOF_joint2"])],
        )

    def test_reload(self):
        self.assertTrue(self.cm.reload(False))
        self.load("my_controller1", "my_controller3")
        self.assertTrue(self.cm.start("my_controller1"))
        self.assertFalse(self.cm.reload(False))
        self.assertEqual(self.cm.states(), {"my_controller1": "running", "my_controller3": "initialized"})
        self.assertTrue(self.cm.reload(True))
        self.assertEqual(self.cm.states(), {})
        self.load("my_controller1")


if __name__ == "__main__":
    rospy.init_node("controller_manager_rostest")
    rostest.rosrun("controller_manager_tests", "controller_manager", ControllerManagerTest)
