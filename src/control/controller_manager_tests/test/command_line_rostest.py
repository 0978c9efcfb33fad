#!/usr/bin/env python3
"""The command line tools: texts byte for byte, exit codes, what a node leaves behind when it ends."""

import contextlib
import functools
import io
import os
import signal
import subprocess
import tempfile
import unittest

import roslib.packages
import rosnode
import rospy
import rostest
from controller_manager.command_line import controller_manager_main
from controller_manager_tests.client import ManagerClient
from std_msgs.msg import Bool
from test_support import wait_until

INTERFACE = "hardware_interface::EffortJointInterface"


@functools.cache
def program(tool):
    """What rosrun starts; it takes as long to find as to run."""
    return roslib.packages.find_node("controller_manager", tool)[0]


def run(tool, *arguments):
    """(exit code, standard output, standard error)"""
    done = subprocess.run([program(tool), *arguments], capture_output=True, text=True, timeout=60)
    return done.returncode, done.stdout, done.stderr


def line(name, state):
    return f"'{name}' - '{INTERFACE}' ( {state} )\n"


class CommandLineTest(unittest.TestCase):
    def setUp(self):
        self.cm = ManagerClient()
        self.addCleanup(self.cm.clear)

    def manager(self, *arguments):
        code, output, _ = run("controller_manager", *arguments)
        self.assertEqual(code, 0, arguments)
        return output

    def spawn(self, tool, *arguments):
        """A spawner or unspawner; its output goes to a file that outlives it."""
        log = tempfile.NamedTemporaryFile("w+", suffix=".log")
        self.addCleanup(log.close)
        process = subprocess.Popen([program(tool), *arguments], stdout=log, stderr=log)
        self.addCleanup(self.end, process)
        process.text = lambda: open(log.name).read()
        return process

    def end(self, process):
        if process.poll() is None:
            process.kill()
        process.wait(60)

    def wait_for(self, **states):
        wait_until(lambda: self.cm.states() == states, f"{states}, there is {self.cm.states()}")

    def test_manager_commands(self):
        """One run of each kind; the texts of all functions are python_interface's."""
        self.assertIn("controller_manager_tests/EffortTestController", self.manager("list-types").split())
        self.assertEqual(self.manager("list"), "No controllers are loaded in mechanism control\n")
        self.assertEqual(
            self.manager("spawn", "my_controller1", "my_controller3"),
            "Loaded 'my_controller1'\nLoaded 'my_controller3'\n"
            "Started ['my_controller1'] successfully\nStarted ['my_controller3'] successfully\n",
        )
        self.assertEqual(self.manager("stop", "my_controller3"), "Stopped ['my_controller3'] successfully\n")
        self.assertEqual(self.manager("lc"), line("my_controller1", "running") + line("my_controller3", "stopped"))
        self.assertEqual(
            self.manager("kl", "my_controller1", "my_controller3"),
            "Stopped ['my_controller1'] successfully\nError when starting [] and stopping ['my_controller3']\n"
            "Unloaded 'my_controller1' successfully\nUnloaded 'my_controller3' successfully\n",
        )
        self.assertEqual(self.manager("load", "nope"), "Error when loading 'nope'\n")
        self.assertEqual(self.manager("reload-libraries"), "Restore: False\nSuccessfully reloaded libraries\n")

    def test_usage(self):
        for arguments, expected in (([], 0), (["dance"], 1)):
            with contextlib.redirect_stdout(io.StringIO()) as output:
                self.assertEqual(controller_manager_main(arguments), expected)
            self.assertIn("load <name>", output.getvalue())
        code, output, _ = run("unspawner", "--help")
        self.assertEqual((code, "unspawner name1" in output), (1, True))
        self.assertEqual(run("spawner")[0], 2)

    def test_spawner_and_unspawner(self):
        spawner = self.spawn("spawner", "my_controller1", "my_controller3", "__name:=my_spawner")
        self.wait_for(my_controller1="running", my_controller3="running")
        wait_until(lambda: "Started controllers: my_controller1, my_controller3" in spawner.text(), "the spawner's word")
        for text in ("Loading controller: my_controller1", "Controller Spawner: Loaded controllers: my_controller1, my_controller3"):
            self.assertIn(text, spawner.text())
        unspawner = self.spawn("unspawner", "my_controller1", "__name:=my_unspawner")
        self.wait_for(my_controller1="stopped", my_controller3="running")
        rosnode.kill_nodes(["/my_unspawner"])
        self.assertEqual(unspawner.wait(60), 0)
        self.assertEqual(self.cm.states(), {"my_controller1": "running", "my_controller3": "running"})
        rosnode.kill_nodes(["/my_spawner"])
        self.assertEqual(spawner.wait(60), 0)
        self.assertEqual(self.cm.states(), {})

    def test_spawner_ended_by_signals(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            spawner = self.spawn("spawner", "my_controller1")
            self.wait_for(my_controller1="running")
            wait_until(lambda: "Started controllers" in spawner.text(), "the spawner's word")
            spawner.send_signal(number)
            self.assertEqual(spawner.wait(60), 0)
            self.assertEqual(self.cm.states(), {})

    def test_a_controller_stopped_by_hand_does_not_keep_the_others_running(self):
        spawner = self.spawn("spawner", "my_controller1", "my_controller3")
        self.wait_for(my_controller1="running", my_controller3="running")
        wait_until(lambda: "Started controllers" in spawner.text(), "the spawner's word")
        self.cm.stop("my_controller1")
        spawner.terminate()
        self.assertEqual(spawner.wait(60), 0)
        self.assertEqual(self.cm.states(), {})

    def test_spawner_stopped(self):
        spawner = self.spawn("spawner", "--stopped", "my_controller1")
        wait_until(lambda: "Loaded controllers: my_controller1" in spawner.text(), "the spawner's word")
        self.assertEqual(self.cm.states(), {"my_controller1": "initialized"})
        self.assertNotIn("Started", spawner.text())

    def test_spawner_waits_for_a_topic(self):
        publisher = rospy.Publisher("/go", Bool, queue_size=2)
        spawner = self.spawn("spawner", "--no-timeout", "--wait-for", "/go", "my_controller1")
        wait_until(publisher.get_num_connections, "the spawner to listen")
        publisher.publish(False)
        self.assertEqual(self.cm.states(), {})
        publisher.publish(True)
        self.wait_for(my_controller1="running")
        self.assertIsNone(spawner.poll())

    def test_spawner_reads_a_yaml_file(self):
        with tempfile.NamedTemporaryFile("w", suffix=".yaml") as file:
            file.write("from_file: {type: controller_manager_tests/EffortTestController, joints: [hiDOF_joint3]}\n")
            file.flush()
            self.spawn("spawner", file.name)
            self.wait_for(from_file="running")

    def test_a_file_that_happens_to_have_the_name_of_a_controller(self):
        before = os.getcwd()
        with tempfile.TemporaryDirectory() as directory:
            os.chdir(directory)
            self.addCleanup(os.chdir, before)
            os.mkdir("my_controller1")
            self.spawn("spawner", "my_controller1")
            self.wait_for(my_controller1="running")

    def test_spawner_goes_on_after_a_failure(self):
        spawner = self.spawn("spawner", "nope", "my_controller1")
        self.wait_for(my_controller1="running")
        wait_until(lambda: "Started controllers: my_controller1" in spawner.text(), "the spawner's word")
        self.assertIn("Failed to load nope", spawner.text())
        self.assertIsNone(spawner.poll())

    def test_spawner_without_a_manager_says_where_it_looked_and_what_there_is(self):
        code, output, errors = run("spawner", "--namespace", "/nowhere", "--timeout", "0.3", "my_controller1")
        self.assertEqual(code, 0)
        self.assertIn("couldn't find the expected controller_manager ROS interface", output + errors)
        self.assertIn("/nowhere/controller_manager/load_controller", output + errors)
        self.assertIn("found: /controller_manager", output + errors)

    def test_groups(self):
        self.assertEqual(
            run("controller_group", "list")[:2],
            (
                0,
                "Number of groups: 3\n  group1\n      my_controller1\n      my_controller3\n"
                "  group2\n      my_controller2\n      my_controller3\n"
                "  group3\n      my_controller1\n      my_controller2\n",
            ),
        )
        self.assertEqual(
            run("controller_group", "spawn", "group1")[:2],
            (
                0,
                "Loaded 'my_controller1'\nLoaded 'my_controller3'\n"
                "Started ['my_controller1'] successfully\nStarted ['my_controller3'] successfully\n",
            ),
        )
        self.assertEqual(
            run("controller_group", "switch", "group2")[:2],
            (0, "Loaded 'my_controller2'\nStarted ['my_controller2'] successfully\nStopped ['my_controller1'] successfully\n"),
        )
        self.assertEqual(
            run("controller_group", "switch", "group3")[:2], (0, "Error when starting ['my_controller1'] and stopping ['my_controller3']\n")
        )
        code, output, errors = run("controller_group", "switch", "group9")
        self.assertEqual(code, 0)
        self.assertIn("no controller defined in group group9", output + errors)


if __name__ == "__main__":
    rospy.init_node("command_line_rostest")
    rostest.rosrun("controller_manager_tests", "command_line", CommandLineTest)
