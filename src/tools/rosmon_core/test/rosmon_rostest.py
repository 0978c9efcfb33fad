#!/usr/bin/env python3
"""rosmon typed at in a real pseudo-terminal, in a pipe, and through its ROS interface."""

import os
import re
import signal
import socket
import subprocess
import sys
import tempfile
import unittest
import xmlrpc.client

import psutil
import roslib.packages
import rospy
import rosservice
import rostest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from rosmon_msgs.msg import NodeState, State
from rosmon_msgs.srv import StartStop, StartStopRequest

sys.path.insert(0, os.path.dirname(__file__))
from screen import F6, F7, F8, F9, F10, Screen  # noqa: E402
from test_support import wait_until

ROSMON = roslib.packages.find_node("rosmon_core", "rosmon")[:1]  # what rosrun starts
PATIENCE = 60.0


def children_said(history):
    return [int(pid) for pid in re.findall(r"child (\d+)", history)]


class TerminalTest(unittest.TestCase):
    def launch(self, file, *options, **environment):
        screen = Screen([*ROSMON, *options, "rosmon_core", file], **environment)
        self.addCleanup(screen.__exit__)
        return screen

    def test_keys_start_stop_mute_and_filter(self):
        screen = self.launch("pair.launch", ROSMON_COLOR_MODE="ansi")
        screen.wait_for("Running as '/pair_monitor'")
        screen.wait_for("alpha-says 3 tty=True")
        screen.wait_for("beta-says 3")
        screen.wait(lambda s: s.on_screen("a alpha") and s.on_screen("b deep/beta"), "node boxes")
        screen.wait(lambda s: s.background(" alpha") == "green", "alpha's box is green")
        self.assertEqual(xmlrpc.client.ServerProxy(os.environ["ROS_MASTER_URI"]).getParam("/t", "/answer")[2], 42)

        screen.type("a")
        screen.wait(lambda s: s.on_screen("Actions for 'alpha'") and s.on_screen("k: stop"), "the node's menu")
        screen.type("k")
        screen.wait(lambda s: "goodbye" in s.history and s.background(" alpha") == "default", "alpha is stopped and plain")
        screen.type("as")
        screen.wait(lambda s: s.background(" alpha") == "green", "alpha runs again")

        screen.type("bm")
        screen.wait(lambda s: s.background("b deep/beta") == "blue", "beta's key shows that it is muted")
        mark = screen.next_lines("alpha-says", "F10:")
        screen.wait(lambda s: s.history[mark:].count("alpha-says") > 10, "alpha goes on")
        self.assertNotIn("beta-says", screen.history[mark:])
        screen.type("bu")
        mark = len(screen.history)
        screen.wait(lambda s: "beta-says" in s.history[mark:], "beta is heard again")

        screen.type(F8)
        screen.wait(lambda s: s.reversed("F8:"), "F8's key shows that only warnings pass")
        mark = screen.next_lines("watch out", "F10:")
        screen.wait(lambda s: s.history[mark:].count("watch out") > 10, "warnings pass")
        self.assertNotIn("beta-says", screen.history[mark:])
        screen.type(F8)
        screen.type(F9)
        screen.wait(lambda s: s.background("a alpha") == s.background("b deep/beta") == "blue", "all are muted")
        screen.type(F10)
        mark = len(screen.history)
        screen.wait(lambda s: "beta-says" in s.history[mark:] and "alpha-says" in s.history[mark:], "all are heard")

        screen.type(F7)
        screen.wait(lambda s: s.background(" alpha") == s.background(" deep/beta") == "default", "F7 stops all")
        screen.type(F6)
        screen.wait(lambda s: s.background(" alpha") == s.background(" deep/beta") == "green", "F6 starts all")

        screen.type("/be")
        screen.wait(lambda s: s.on_screen("Searching for: be"), "the search line")
        screen.type("\r")
        screen.wait(lambda s: s.on_screen("Actions for 'deep/beta'"), "the search has chosen beta")
        screen.type("\x1b")
        screen.wait(lambda s: s.on_screen("F6:"), "Escape leaves the menu")
        screen.type("\x03")
        self.assertEqual(screen.finish(), 0)
        self.assertNotIn("does not stop", screen.history, "two processes that end at once need no killing")

    def test_ways_to_end(self):
        screen = self.launch("lives.launch", ROSMON_COLOR_MODE="ansi")
        screen.wait_for("short-life 1")
        screen.wait_for("exited with status 3")
        screen.wait_for("died from signal 11 (SIGSEGV)")
        screen.wait_for("Cannot locate node of type [no_such_program]")
        screen.wait_for("phoenix-life 1")
        screen.wait(lambda s: s.history.count("phoenix-life 1") >= 2, "phoenix rises")
        self.assertNotIn("quiet-says", screen.history)
        screen.wait(lambda s: s.background(" failing") == s.background(" dying") == "red", "crashed boxes are red")
        screen.wait(lambda s: s.background(" short") == "default", "what has ended well is plain")
        screen.wait(lambda s: s.background(" phoenix") in ("brown", "yellow"), "phoenix waits in yellow")
        screen.type("dk")
        screen.wait(lambda s: s.background(" phoenix") == "default", "stopping wins over respawn")
        screen.type("\x03")
        self.assertEqual(screen.finish(), 0)

    def test_no_process_survives(self):
        screen = self.launch("stubborn.launch")
        screen.wait(lambda s: len(children_said(s.history)) == 2, "both have started a child")
        pids = children_said(screen.history)
        pids += [psutil.Process(pid).ppid() for pid in pids]
        screen.type("\x03")
        screen.finish()
        self.assertIn("does not stop within 0.4 s of SIGINT: killed", screen.history)
        wait_until(lambda: not any(psutil.pid_exists(p) and psutil.Process(p).status() != "zombie" for p in pids), "all processes are gone")

    def test_no_start(self):
        screen = self.launch("pair.launch", "--no-start", ROSMON_COLOR_MODE="ansi")
        screen.wait(lambda s: s.on_screen("a alpha"), "node boxes")
        self.assertEqual(screen.background(" alpha"), "default")
        screen.type("as")
        screen.wait_for("alpha-says 1")
        self.assertNotIn("beta-says", screen.history)
        screen.type("\x03")
        screen.finish()

    def test_small_window(self):
        screen = Screen([*ROSMON, "rosmon_core", "pair.launch"], columns=40, rows=12)
        self.addCleanup(screen.__exit__)
        screen.wait(lambda s: s.on_screen("a alpha") and s.on_screen("b deep/beta"), "node boxes in a small window")
        screen.type("\x03")
        self.assertEqual(screen.finish(), 0)


class WaitingTest(unittest.TestCase):
    def test_waits_for_a_roscore(self):
        place = socket.socket()  # keeps the port for the roscore, which may bind it too; nobody answers there before
        self.addCleanup(place.close)
        place.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        place.bind(("", 0))
        port = place.getsockname()[1]
        uri = f"http://localhost:{port}"
        screen = Screen([*ROSMON, "rosmon_core", "params_only.launch"], ROS_MASTER_URI=uri)
        self.addCleanup(screen.__exit__)
        screen.wait_for("roscore is not running")
        self.assertIn(uri, screen.history)
        master = subprocess.Popen(
            ["rosmaster", "--core", "-p", str(port)], env={**os.environ, "ROS_MASTER_URI": uri}, stdout=subprocess.DEVNULL
        )
        self.addCleanup(master.wait)
        self.addCleanup(master.terminate)
        screen.wait_for("no nodes to launch")
        self.assertEqual(screen.finish(), 0)
        self.assertEqual(xmlrpc.client.ServerProxy(uri).getParam("/t", "/only_this")[2], 7)

    def test_interrupt_while_waiting(self):
        screen = Screen([*ROSMON, "rosmon_core", "pair.launch"], ROS_MASTER_URI="http://localhost:9")
        self.addCleanup(screen.__exit__)
        screen.wait_for("roscore is not running")
        screen.type("\x03")
        self.assertEqual(screen.finish(), 1)
        self.assertIn("given up", screen.history)


class PlainTest(unittest.TestCase):
    def test_in_a_pipe(self):
        process = subprocess.Popen(
            [*ROSMON, "rosmon_core", "required.launch", f"--log={self.id()}.log", "--flush-log"],
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            stdin=subprocess.DEVNULL,
            text=True,
            cwd=os.environ.get("ROS_TEST_RESULTS_DIR") or "/tmp",
        )
        output, _ = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 1, "a required node has failed")
        self.assertRegex(output, r"(?m)^   key: hello 10 tty=True$")
        self.assertIn("required node 'key' has ended", output)
        self.assertIn(" other: stopped", output)
        self.assertNotIn("\x1b", output)
        log = os.path.join(os.environ.get("ROS_TEST_RESULTS_DIR") or "/tmp", f"{self.id()}.log")
        with open(log) as file:
            self.assertRegex(file.read(), r"ERROR key: exited with status 2")
        os.remove(log)

    def test_displays_that_rviz_offers_and_nobody_has_built_are_told(self):
        with tempfile.TemporaryDirectory() as folder:
            package = os.path.join(folder, "my_displays")
            os.mkdir(package)
            for name, text in (
                (
                    "package.xml",
                    "<package format='2'><name>my_displays</name><version>0.0.1</version><description>d</description>"
                    "<maintainer email='a@b.cd'>a</maintainer><license>BSD</license><depend>rviz</depend>"
                    "<export><rviz plugin='${prefix}/plugins.xml'/></export></package>",
                ),
                (
                    "plugins.xml",
                    "<library path='lib/libmy_displays'><class name='my_displays/Arc' type='my::Arc' "
                    "base_class_type='rviz::Display'/></library>",
                ),
                ("look.launch", "<launch><node name='look' pkg='rviz' type='rviz' required='true'/></launch>"),
            ):
                with open(os.path.join(package, name), "w") as file:
                    file.write(text)
            environment = {
                **os.environ,
                "DISPLAY": "nowhere:77",
                "ROS_HOME": folder,  # RViz itself gets no further
                "ROS_PACKAGE_PATH": f"{folder}:{os.environ['ROS_PACKAGE_PATH']}",
            }
            answer = subprocess.run(
                [*ROSMON, "my_displays", "look.launch", "--stop-timeout", "20"],
                env=environment,
                cwd=folder,
                text=True,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                stdin=subprocess.DEVNULL,
                timeout=120,
            )
        self.assertIn("rviz: my_displays/Arc of the package my_displays cannot be added", answer.stdout)

    def test_terminate_stops_everything(self):
        process = subprocess.Popen(
            [*ROSMON, "rosmon_core", "stubborn.launch", "--flush-stdout"], stdout=subprocess.PIPE, stdin=subprocess.DEVNULL, text=True
        )
        seen = ""
        while len(children_said(seen)) < 2:
            line = process.stdout.readline()
            self.assertTrue(line, f"rosmon has ended, after\n{seen}")
            seen += line
        pids = children_said(seen)
        process.send_signal(signal.SIGTERM)
        process.communicate(timeout=60)
        wait_until(lambda: not any(psutil.pid_exists(p) and psutil.Process(p).status() != "zombie" for p in pids), "all processes are gone")


class RosInterfaceTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.process = subprocess.Popen(
            [*ROSMON, "--disable-ui", "--name=monitor", "rosmon_core", "lives.launch"], stdout=subprocess.DEVNULL, stdin=subprocess.DEVNULL
        )
        cls.states, cls.diagnostics = {}, {}
        rospy.Subscriber("/monitor/state", State, cls.on_state)
        rospy.Subscriber("/diagnostics", DiagnosticArray, lambda m: cls.diagnostics.update({s.name: s for s in m.status}))
        rospy.wait_for_service("/monitor/start_stop", PATIENCE)
        cls.start_stop = staticmethod(rospy.ServiceProxy("/monitor/start_stop", StartStop))

    @classmethod
    def on_state(cls, message):
        cls.states = {node.name: node for node in message.nodes}

    @classmethod
    def tearDownClass(cls):
        cls.process.send_signal(signal.SIGINT)
        cls.process.wait()

    def wait_for_state(self, name, state):
        wait_until(lambda: name in self.states and self.states[name].state == state, f"{name} is in state {state}")

    def wait_for_level(self, name, level):
        label = f"monitor:{name}"
        wait_until(lambda: label in self.diagnostics and self.diagnostics[label].level == level, f"{label} has level {level}")

    def test_1_states(self):
        self.assertEqual(rosservice.get_service_type("/monitor/start_stop"), "rosmon_msgs/StartStop")
        self.wait_for_state("quiet", NodeState.RUNNING)
        self.wait_for_state("short", NodeState.IDLE)
        self.wait_for_state("dying", NodeState.CRASHED)
        wait_until(lambda: self.states["phoenix"].restart_count >= 1, "phoenix is counted")
        wait_until(lambda: self.states["quiet"].memory > 1 << 20, "memory is measured")
        # a topic of its own: what it said before may still be the last that came
        self.wait_for_level("dying", DiagnosticStatus.ERROR)
        self.assertEqual(self.diagnostics["monitor:dying"].message, "Process has crashed")
        self.wait_for_level("phoenix", DiagnosticStatus.WARN)
        self.assertIn("restart count > 0", self.diagnostics["monitor:phoenix"].message)

    def test_2_start_stop(self):
        self.start_stop("qu.*", "", StartStopRequest.STOP)
        self.wait_for_state("quiet", NodeState.IDLE)
        self.start_stop("quiet", "", StartStopRequest.START)
        self.wait_for_state("quiet", NodeState.RUNNING)
        self.start_stop("quiet", "", StartStopRequest.RESTART)
        wait_until(lambda: self.states["quiet"].restart_count == 1, "the restart is counted")
        self.wait_for_state("quiet", NodeState.RUNNING)

    def test_3_nothing_matches(self):
        for node, action in (("qui", StartStopRequest.STOP), ("quiet", 9), ("(", StartStopRequest.STOP)):
            with self.assertRaises(rospy.ServiceException):
                self.start_stop(node, "", action)


if __name__ == "__main__":
    rospy.init_node("rosmon_test")
    case = globals()[sys.argv[1]]
    rostest.rosrun("rosmon_core", case.__name__, case)
