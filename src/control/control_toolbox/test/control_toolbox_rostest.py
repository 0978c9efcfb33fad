#!/usr/bin/env python3
"""Gains as parameters, through dynamic_reconfigure, through the service; the state topic."""

import math
import time

import dynamic_parameters
import rospy
import rostest
import test_support
from control_msgs.msg import PidState
from control_toolbox import Gains, Pid, PidGainsSetter, PidParameterError, load_pid
from control_toolbox.srv import SetPidGains
from controller_interface import NodeHandle
from dynamic_reconfigure.client import Client
from dynamic_reconfigure.msg import Config, DoubleParameter
from dynamic_reconfigure.srv import Reconfigure


class ControlToolboxTest(test_support.TestCase):
    def load(self, **parameters):
        self.nh = NodeHandle("/pid")
        self.addCleanup(self.nh.shutdown)
        if rospy.has_param("/pid"):
            rospy.delete_param("/pid")
        if parameters:
            rospy.set_param("/pid", parameters)
        return load_pid(self.nh)

    def client(self):
        client = Client("/pid", timeout=20)
        self.addCleanup(client.close)
        return client

    def test_parameters(self):
        for parameters, gains in (
            ({"p": 1}, Gains(1.0)),
            ({"p": 1.0, "i": 2.0, "d": 3.0}, Gains(1.0, 2.0, 3.0)),
            ({"p": 1.0, "i_clamp": -4.0}, Gains(1.0, 0.0, 0.0, 4.0, -4.0)),
            ({"p": 1.0, "i_clamp": 4.0, "i_clamp_max": 5.0}, Gains(1.0, 0.0, 0.0, 5.0, -4.0)),
            ({"p": 1.0, "i_clamp_min": 6.0, "i_clamp_max": -5.0, "antiwindup": True}, Gains(1.0, 0.0, 0.0, 5.0, -6.0, True)),
        ):
            with self.subTest(parameters=parameters):
                self.assertEqual(self.load(**parameters).gains, gains)
                self.nh.shutdown()

    def test_no_p_gain(self):
        for parameters in ({}, {"i": 1.0}):
            with self.assertRaisesRegex(PidParameterError, "^No p gain specified for pid.  Namespace: /pid$"):
                self.load(**parameters)
        with self.assertRaisesRegex(PidParameterError, "/pid/d must be a number, it is 'x'"):
            self.load(p=1.0, d="x")

    def test_gains_that_are_not_finite(self):
        for name, value in (("p", math.nan), ("i", math.inf), ("d", -math.inf), ("i_clamp", math.nan)):
            with self.assertRaisesRegex(PidParameterError, f"/pid/{name} must be a number, it is {value}"):
                self.load(**{"p": 1.0, name: value})
        self.assertEqual(self.load(p=1.0, i_clamp=math.inf).gains.i_max, math.inf, "unbounded")

    def test_a_flag_that_is_none_counts_as_not_set(self):
        self.assertFalse(self.load(p=1.0, antiwindup="false").gains.antiwindup)

    def test_dynamic_reconfigure(self):
        pid = self.load(p=5.0, i=1.0, i_clamp=2.0)
        for name, value in (("p", 5.0), ("i", 1.0), ("d", 0.0), ("i_clamp_min", -2.0), ("i_clamp_max", 2.0), ("antiwindup", False)):
            self.assertEqual(rospy.get_param(f"/pid/{name}"), value)
        client = self.client()
        config = client.get_configuration(timeout=20)
        self.assertEqual((config["p"], config["i_clamp_min"], config["antiwindup"]), (5.0, -2.0, False))
        self.assertEqual(
            [(p["name"], p["type"], p["min"], p["max"], p["default"]) for p in client.get_parameter_descriptions(timeout=20)],
            [
                ("p", "double", -100000.0, 100000.0, 10.0),
                ("i", "double", -100000.0, 100000.0, 0.1),
                ("d", "double", -1000.0, 1000.0, 1.0),
                ("i_clamp_min", "double", -100000.0, 0.0, -10.0),
                ("i_clamp_max", "double", 0.0, 100000.0, 10.0),
                ("antiwindup", "bool", False, True, False),
            ],
        )
        answer = client.update_configuration({"d": 1e9, "antiwindup": True})
        self.assertEqual((answer["d"], answer["p"]), (1000.0, 5.0), "in range; what is not named stays")
        self.assertEqual(pid.gains, Gains(5.0, 1.0, 1000.0, 2.0, -2.0, True))
        self.assertEqual(rospy.get_param("/pid/d"), 1000.0)

    def test_gains_beyond_the_sliders_hold(self):
        """Pid::updateDynamicReconfig hands them to updateConfig, which shows and stores what it is given."""
        pid = self.load(p=1e6, d=5000.0)
        self.assertEqual(pid.gains, Gains(1e6, 0.0, 5000.0))
        client = self.client()
        config = client.get_configuration(timeout=20)
        self.assertEqual((config["p"], config["d"], rospy.get_param("/pid/p")), (1e6, 5000.0, 1e6))
        pid.set_gains(2e6, 0.0, 1.0, 0.0, 0.0)
        self.assertEqual(rospy.get_param("/pid/p"), 2e6)
        answer = client.update_configuration({"p": 3e6, "i": 1.0})
        self.assertEqual((answer["p"], answer["i"]), (1e5, 1.0), "what a client asks for is kept in range")

    def test_set_gains_by_the_program_reaches_the_clients(self):
        pid = self.load(p=5.0)
        client = self.client()
        pid.set_gains(6.0, 0.0, 0.0, 0.0, 0.0)
        end = time.monotonic() + 20.0
        while client.get_configuration(timeout=20)["p"] != 6.0:
            self.assertLess(time.monotonic(), end, "the client never heard of it")
            time.sleep(0.01)
        self.assertEqual(rospy.get_param("/pid/p"), 6.0)

    def test_set_gains_service(self):
        nh = NodeHandle("/setter")
        self.addCleanup(nh.shutdown)
        pids = [Pid(), Pid()]
        PidGainsSetter(nh, *pids)
        rospy.wait_for_service("/setter/set_gains", 20)
        rospy.ServiceProxy("/setter/set_gains", SetPidGains)(1.0, 2.0, 3.0, -4.0, True)
        for pid in pids:
            self.assertEqual(pid.gains, Gains(1.0, 2.0, 3.0, 4.0, -4.0, True))
        with self.assertRaises(rospy.ServiceException):
            rospy.ServiceProxy("/setter/set_gains", SetPidGains)(math.nan, 2.0, 3.0, -4.0, True)
        self.assertEqual(pids[0].gains.p, 1.0)
        self.assertEqual(rospy.get_param("/setter"), {"p": 1.0, "i": 2.0, "d": 3.0, "i_clamp": -4.0, "antiwindup": True})

    def test_a_connection_to_a_closed_reconfigure_server_changes_nothing(self):
        calls = []
        server = dynamic_parameters.Server(
            "/closing", [dynamic_parameters.Parameter("p", float, 1.0)], lambda config, level: calls.append(config["p"])
        )
        kept = rospy.ServiceProxy("/closing/set_parameters", Reconfigure, persistent=True)
        kept(Config(doubles=[DoubleParameter("p", 2.0)]))
        server.shutdown()
        answer = kept(Config(doubles=[DoubleParameter("p", 3.0)]))
        self.assertEqual([(entry.name, entry.value) for entry in answer.config.doubles], [("p", 2.0)])
        self.assertEqual(calls, [1.0, 2.0])

    def test_state_topic(self):
        pid = self.load(p=2.0, i=1.0, i_clamp=0.5, d=0.5, publish_state=True)
        messages = []
        rospy.Subscriber("/pid/state", PidState, messages.append)
        while not messages and not rospy.is_shutdown():
            pid.reset()
            pid.compute_command(1.0, 0.25)
            rospy.sleep(0.01)
        message = messages[-1]
        self.assertEqual((message.error, message.p_term, message.i_term, message.d_term, message.output), (1.0, 2.0, 0.25, 2.0, 4.25))
        self.assertEqual((message.timestep.to_sec(), message.i_max, message.i_min), (0.25, 0.5, -0.5))


if __name__ == "__main__":
    rospy.init_node("control_toolbox_rostest")
    rostest.rosrun("control_toolbox", "control_toolbox", ControlToolboxTest)
