#!/usr/bin/env python3
"""What a control loop sees: order of calls, hardware that takes time to switch, controllers that break.

The manager runs in this process and the test is its control loop, so every cycle is known.
"""

import math
import threading
import time
import unittest
from unittest import mock

import rospy
import rostest
from controller_interface import Controller
from controller_manager import ControllerManager
from controller_manager_tests.client import BEST_EFFORT
from hardware_interface import EffortJointInterface, JointHandle, JointStateHandle, RobotHW, SwitchState, VelocityJointInterface

CALLS = []


class Recorder(Controller):
    """Notes every call; raises where ``fail_in`` says."""

    interface = EffortJointInterface
    fail_in = ""

    def init(self, hw, root_nh, controller_nh):
        self.name = controller_nh.namespace[1:]
        self.joint = hw.get_handle(controller_nh.get_param("joint", str))

    def note(self, call):
        CALLS.append((self.name, call))
        if call == self.fail_in:
            raise RuntimeError("broken on purpose")

    def starting(self, time):
        self.note("starting")

    def update(self, time, period):
        self.note("update")

    def stopping(self, time):
        self.note("stopping")
        self.joint.command = 0.0

    def waiting(self, time):
        self.note("waiting")

    def aborting(self, time):
        self.note("aborting")


class ScriptedHW(RobotHW):
    """Answers as the test says; notes what it is asked."""

    def __init__(self):
        super().__init__()
        states = [JointStateHandle(name) for name in "abc"]
        self.register_interface(EffortJointInterface(*map(JointHandle, states)))
        self.register_interface(VelocityJointInterface(*map(JointHandle, states)))
        self.feasible = True
        self.results = {}  # controller's name, or None for all -> SwitchState
        self.prepared = []
        self.switched = []

    def prepare_switch(self, start, stop):
        self.prepared.append(([info.name for info in start], [info.name for info in stop]))
        return self.feasible

    def do_switch(self, start, stop):
        self.switched.append(([info.name for info in start], [info.name for info in stop]))
        CALLS.append(("hardware", "do_switch"))

    def switch_result(self, controller=None):
        return self.results.get(controller and controller.name, SwitchState.DONE)


class SwitchingTest(unittest.TestCase):
    def setUp(self):
        self.hw = ScriptedHW()
        self.cm = ControllerManager(self.hw, "/")
        self.addCleanup(self.cm.shutdown)
        for name, joint in (("x", "a"), ("y", "b"), ("z", "a")):
            rospy.set_param(f"/{name}", {"type": "controller_manager_tests/EffortTestController", "joint": joint})
        self.cm._types.create = lambda plugin: Recorder()
        for name in "xyz":
            self.assertTrue(self.cm.load_controller(name))
        self.time = 0.0
        CALLS.clear()

    def cycle(self, count=1):
        for _ in range(count):
            self.time += 0.01
            self.cm.update(self.time, 0.01)

    def controller(self, name):
        return next(loaded.controller for loaded in self.cm.controllers if loaded.name == name)

    def state(self, name):
        return self.controller(name).state.value

    def switch(self, start="", stop="", cycles=None, **options):
        """Request a switch and cycle until it is done, or ``cycles`` times. :return: the running request."""
        request = Request(lambda: self.cm.switch_controller(list(start), list(stop), **options))
        request.wait_until_pending_or_done(self.cm)
        if cycles is not None:
            self.cycle(cycles)
        else:
            while not request.done:
                self.cycle()
                request.thread.join(0.005)
        return request

    def names(self):
        return [call for name, call in CALLS if name != "hardware"]

    def test_update_in_load_order_whatever_the_order_of_starting(self):
        self.assertTrue(self.switch("yx").result())
        CALLS.clear()
        self.cycle(2)
        self.assertEqual(CALLS, [("x", "update"), ("y", "update")] * 2)

    def test_order_of_calls_in_a_swap(self):
        self.switch("x")
        CALLS.clear()
        request = self.switch("z", "x", cycles=1)
        self.assertTrue(request.result())
        # the old controller is updated once more, the new one from the next cycle on
        self.assertEqual(CALLS, [("x", "update"), ("hardware", "do_switch"), ("x", "stopping"), ("z", "starting")])
        self.cycle()
        self.assertEqual(CALLS[-1], ("z", "update"))
        self.assertEqual((self.state("x"), self.state("z")), ("stopped", "running"))

    def test_hardware_hears_only_of_real_transitions(self):
        self.switch("xy")
        self.hw.prepared.clear()
        self.hw.switched.clear()
        self.assertTrue(self.switch("x", "yz", strictness=BEST_EFFORT).result())
        self.assertEqual(self.hw.prepared, [([], ["y"])])
        self.assertEqual(self.hw.switched, [([], ["y"])])

    def test_a_running_controller_is_not_started_again(self):
        self.switch("x")
        CALLS.clear()
        self.assertTrue(self.switch("x", strictness=BEST_EFFORT).result())
        self.assertNotIn(("x", "starting"), CALLS)

    def test_names_given_twice(self):
        self.assertTrue(self.switch("xx").result())
        self.assertEqual(CALLS.count(("x", "starting")), 1)

    def test_infeasible_for_the_hardware(self):
        self.hw.feasible = False
        self.assertFalse(self.cm.switch_controller(["x"], []))
        self.assertEqual(self.state("x"), "initialized")
        self.assertEqual(self.hw.switched, [])

    def test_conflict_never_reaches_the_hardware(self):
        self.assertFalse(self.cm.switch_controller(["x", "z"], [], BEST_EFFORT))
        self.assertEqual(self.hw.prepared, [])

    def test_waiting_for_the_hardware(self):
        self.hw.results[None] = SwitchState.ONGOING
        request = self.switch("xy", cycles=3)
        self.assertFalse(request.done)
        self.assertEqual(self.state("x"), "waiting")
        self.assertEqual(self.names(), ["waiting"] * 6)
        self.assertEqual(len(self.hw.switched), 1)
        self.hw.results[None] = SwitchState.DONE
        self.cycle()
        self.assertTrue(request.result())
        self.assertEqual((self.state("x"), self.state("y")), ("running", "running"))

    def test_controllers_that_stop_do_so_at_once(self):
        self.switch("x")
        self.hw.results[None] = SwitchState.ONGOING
        request = self.switch("y", "x", cycles=1)
        self.assertEqual((self.state("x"), self.state("y")), ("stopped", "waiting"))
        self.hw.results[None] = SwitchState.ERROR
        self.cycle()
        self.assertTrue(request.result(), "the request was carried out; the state tells how it ended")
        self.assertEqual((self.state("x"), self.state("y")), ("stopped", "aborted"))
        self.assertEqual(CALLS[-1], ("y", "aborting"))

    def test_timeout_counts_on_the_clock_of_the_loop(self):
        self.hw.results[None] = SwitchState.ONGOING
        request = self.switch("x", timeout=0.055, cycles=6)
        self.assertEqual(self.state("x"), "waiting")
        self.cycle()
        self.assertTrue(request.result())
        self.assertEqual(self.state("x"), "aborted")

    def test_as_soon_as_possible(self):
        self.hw.results["x"] = SwitchState.ONGOING
        request = self.switch("xy", cycles=2, start_asap=True)
        self.assertEqual((self.state("x"), self.state("y")), ("waiting", "running"))
        self.assertIn(("y", "update"), CALLS)
        self.assertFalse(request.done)
        self.hw.results["x"] = SwitchState.DONE
        self.cycle()
        self.assertTrue(request.result())
        self.assertEqual(self.state("x"), "running")
        self.assertEqual(CALLS.count(("y", "starting")), 1)

    def test_as_soon_as_possible_with_an_error_and_a_timeout(self):
        self.hw.results.update(x=SwitchState.ERROR, y=SwitchState.ONGOING)
        request = self.switch("xy", cycles=2, start_asap=True, timeout=0.035)
        self.assertEqual((self.state("x"), self.state("y")), ("aborted", "waiting"))
        self.cycle(4)
        self.assertTrue(request.result())
        self.assertEqual(self.state("y"), "aborted")

    def test_an_aborted_controller_can_be_started_and_unloaded(self):
        self.hw.results[None] = SwitchState.ERROR
        self.switch("x")
        self.hw.results.clear()
        self.assertTrue(self.switch("x").result())
        self.assertEqual(self.state("x"), "running")
        self.hw.results[None] = SwitchState.ERROR
        self.switch("y")
        self.assertTrue(self.cm.unload_controller("y"))

    def test_a_loop_that_does_not_run(self):
        self.assertFalse(self.cm.switch_controller(["x"], [], timeout=0.01))
        self.cycle()
        self.assertEqual(self.state("x"), "initialized", "the request must not come true later")
        self.assertTrue(self.switch("x").result())

    def test_a_waiting_switch_keeps_nobody_else_waiting(self):
        request = Request(lambda: self.cm.switch_controller(["x"], []))
        request.wait_until_pending_or_done(self.cm)
        self.assertTrue(Request(lambda: self.cm.unload_controller("y")).result())
        self.assertTrue(Request(lambda: self.cm.load_controller("y")).result())
        self.assertFalse(Request(lambda: self.cm.unload_controller("x")).result(), "it is about to be started")
        self.assertEqual([loaded.name for loaded in self.cm.controllers], ["x", "z", "y"])
        second = Request(lambda: self.cm.switch_controller(["y"], ["x"]))
        self.assertFalse(request.done or second.done)
        while not (request.done and second.done):
            self.cycle()
            second.thread.join(0.002)
        self.assertTrue(request.result() and second.result(), "one after the other")
        self.assertEqual((self.state("x"), self.state("y")), ("stopped", "running"))

    @mock.patch("controller_manager.switching.PATIENCE", 0.3)
    def test_a_loop_that_died(self):
        self.cycle()
        with self.assertLogs("rosout", "ERROR") as log:
            self.assertFalse(Request(lambda: self.cm.switch_controller(["x"], [])).result())
        self.assertEqual(len(log.output), 1, log.output)
        self.assertIn("the control loop has made no cycle for 0.3 s although the clock goes on", log.output[0])
        self.cycle()
        self.assertEqual(self.state("x"), "initialized", "the request must not come true later")
        self.assertTrue(self.switch("x").result())

    @mock.patch("controller_manager.switching.PATIENCE", 0.3)
    def test_a_hardware_that_takes_its_time_is_no_dead_loop(self):
        self.hw.results[None] = SwitchState.ONGOING
        request = self.switch("x", cycles=1)
        end = time.monotonic() + 1.0
        while time.monotonic() < end:
            self.cycle()
            request.thread.join(0.1)
        self.hw.results.clear()
        self.cycle()
        self.assertTrue(request.result())

    @mock.patch("controller_manager.switching.PATIENCE", 0.3)
    def test_a_paused_loop_is_waited_for(self):
        self.cycle()
        with mock.patch("rospy.get_time", return_value=5.0):
            request = Request(lambda: self.cm.switch_controller(["x"], []))
            request.thread.join(1.5)
            self.assertFalse(request.done, "the clock stands still")
            self.cycle()
            self.assertTrue(request.result())

    @mock.patch("controller_manager.manager.LONGEST_CYCLE", 0.3)
    def test_a_cycle_that_does_not_end(self):
        self.switch("x")
        blocked, go_on = threading.Event(), threading.Event()
        loaded = next(loaded for loaded in self.cm.controllers if loaded.name == "x")
        loaded.update = lambda *_: (blocked.set(), go_on.wait(30.0))
        loop = Request(self.cycle)
        blocked.wait(10.0)
        with self.assertLogs("rosout", "ERROR") as log:
            self.assertFalse(Request(lambda: self.cm.unload_controller("y")).result())
            self.assertFalse(Request(lambda: self.cm.switch_controller(["y"], [], timeout=0.01)).result())
        self.assertTrue(all("a cycle of the control loop has not ended" in line for line in log.output), log.output)
        self.assertEqual(len(log.output), 2)
        go_on.set()
        loop.result()
        self.cycle()
        self.assertEqual(self.state("y"), "initialized")
        self.assertTrue(self.switch("y").result())

    def test_shutdown_does_not_wait_for_an_init_that_blocks(self):
        blocked, go_on = threading.Event(), threading.Event()
        self.addCleanup(go_on.set)
        self.assertTrue(self.cm.unload_controller("y"))
        with mock.patch.object(Recorder, "init", lambda *_: (blocked.set(), go_on.wait(30.0)) and None):
            loading = Request(lambda: self.cm.load_controller("y"))
            blocked.wait(10.0)
            Request(self.cm.shutdown).result()
            go_on.set()
            self.assertFalse(loading.result(), "the manager has gone")
        self.assertEqual(self.cm.controllers, [])

    def test_a_timeout_that_is_no_number(self):
        self.assertFalse(self.cm.switch_controller(["x"], [], timeout=math.nan))
        self.assertEqual(self.state("x"), "initialized")

    def test_loading_and_unloading_need_no_loop(self):
        self.assertTrue(self.cm.unload_controller("x"))
        self.assertTrue(self.cm.load_controller("x"))

    def test_reset_restarts_what_runs(self):
        self.switch("xy")
        CALLS.clear()
        self.cm.update(9.0, 0.01, reset=True)
        self.assertEqual(
            CALLS, [("x", "stopping"), ("x", "starting"), ("y", "stopping"), ("y", "starting"), ("x", "update"), ("y", "update")]
        )

    def test_shutdown_stops_controllers_and_ends_a_pending_switch(self):
        self.switch("x")
        CALLS.clear()
        request = Request(lambda: self.cm.switch_controller(["y"], []))
        request.wait_until_pending_or_done(self.cm)
        self.cm.shutdown()
        self.assertFalse(request.result())
        self.assertEqual(CALLS, [("x", "stopping")])

    def test_an_exception_in_update_stops_that_controller_only(self):
        self.switch("xy")
        self.controller("x").fail_in = "update"
        self.controller("x").joint.command = 7.0
        CALLS.clear()
        self.cycle(2)
        self.assertEqual(CALLS, [("x", "update"), ("x", "stopping"), ("y", "update"), ("y", "update")])
        self.assertEqual((self.state("x"), self.state("y")), ("aborted", "running"))
        self.assertEqual(self.controller("x").joint.command, 0.0, "its stopping() could brake")
        self.assertTrue(self.cm.unload_controller("x"))

    def test_an_exception_in_starting(self):
        self.controller("x").fail_in = "starting"
        self.assertFalse(self.switch("xy").result())
        self.assertEqual((self.state("x"), self.state("y")), ("aborted", "running"))

    def test_a_start_that_raised_is_not_tried_again_while_others_wait(self):
        self.hw.results["y"] = SwitchState.ONGOING
        self.controller("x").fail_in = "starting"
        request = self.switch("xy", cycles=3, start_asap=True)
        self.assertEqual(CALLS.count(("x", "starting")), 1)
        self.hw.results.clear()
        self.cycle()
        self.assertFalse(request.result())
        self.assertEqual((self.state("x"), self.state("y")), ("aborted", "running"))

    def test_an_exception_in_stopping(self):
        self.switch("x")
        self.controller("x").fail_in = "stopping"
        self.assertTrue(self.switch("y", "x").result())
        self.assertEqual((self.state("x"), self.state("y")), ("aborted", "running"))

    def test_an_exception_of_the_hardware(self):
        def broken(*_):
            raise RuntimeError("no bus")

        self.hw.prepare_switch = broken
        self.assertFalse(self.cm.switch_controller(["x"], []))
        del self.hw.prepare_switch
        self.hw.do_switch = broken
        self.assertTrue(self.switch("x").result())
        self.assertEqual(self.state("x"), "aborted")

    def test_nan_time_does_no_harm(self):
        self.switch("x")
        self.cm.update(math.nan, math.nan)
        self.cycle()
        self.assertEqual(self.state("x"), "running")


class Request:
    """A call in a thread of its own, as a service call is."""

    def __init__(self, call):
        self._answer = None
        self.thread = threading.Thread(target=lambda: setattr(self, "_answer", call()), daemon=True)
        self.thread.start()

    @property
    def done(self):
        return not self.thread.is_alive()

    def wait_until_pending_or_done(self, manager):
        while not self.done and manager._switch is None:
            self.thread.join(0.001)

    def result(self):
        self.thread.join(20.0)
        assert self.done, "the request was never answered"
        return self._answer


if __name__ == "__main__":
    rospy.init_node("switching_rostest")
    rostest.rosrun("controller_manager_tests", "switching", SwitchingTest)
