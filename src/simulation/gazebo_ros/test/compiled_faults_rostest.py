#!/usr/bin/env python3
"""Plugins in C++ whose faults nothing can mend: one line names the plugin before the process ends, or the world goes on."""

import importlib.util
import os
import signal
import sys
import tempfile
import unittest

import rospy
import rostest
import test_support

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from processes import Server  # noqa: E402

WORLD = """<sdf version="1.6"><world name="faulty"><model name="box"><link name="l"/>
<plugin name="twin" filename="{library}"><fail_in>{fault}</fail_in></plugin></model></world></sdf>"""
WHO = "plugin twin (libgazebo_ros_test_twin_one.so) of model box"


@unittest.skipUnless(importlib.util.find_spec("gazebo_cpp._core"), "this system lacks what Gazebo's headers need")
class Faults(test_support.TestCase):
    def server(self, fault, library="libgazebo_ros_test_twin_one.so"):
        with tempfile.NamedTemporaryFile("w", suffix=".world", delete=False) as file:
            file.write(WORLD.format(fault=fault, library=library))
        self.addCleanup(os.remove, file.name)
        return Server(fault.replace(" ", "_").replace(",", ""), file.name)

    def ends(self, server, code, *words):
        text, _ = server.process.communicate(timeout=60)
        self.assertEqual(server.process.returncode, code, text)
        lines = [line for line in text.splitlines() if all(word in line for word in words)]
        self.assertEqual(len(lines), 1, text)
        self.assertNotIn("Traceback", text)

    def test_crash_in_an_update(self):
        with self.server("update") as server:
            self.ends(server, -signal.SIGSEGV, "[FATAL]", WHO, "crashed in its update", "segmentation fault")

    def test_crash_of_a_thread(self):
        with self.server("thread") as server:
            self.ends(server, -signal.SIGSEGV, "[FATAL]", "libgazebo_ros_test_twin_one.so crashed in a thread or callback of its own")

    def test_exit(self):
        with self.server("exit") as server:
            self.ends(server, 3, "[FATAL]", WHO, "called exit() in its update")

    def test_exception_of_a_destructor(self):
        with self.server("destructor") as server:
            sim = server.simulator()
            try:
                sim.delete("box")
            except rospy.ServiceException:
                pass  # the process has ended before it could answer
            self.ends(server, -signal.SIGABRT, "[FATAL]", WHO, "crashed in its destructor", "aborted")

    def test_a_thread_that_outlives_its_plugin(self):
        with self.server("nothing, but a thread goes on") as server:
            sim = server.simulator()
            self.assertTrue(sim.delete("box").success)
            before = sim.world().sim_time
            test_support.wait_until(lambda: sim.world().sim_time > before, "a step")
            code, text = server.end()
        self.assertEqual(code, 0, text)

    def test_a_library_that_is_not_there(self):
        with self.server("nothing", library="libnowhere_at_all.so") as server:
            self.assertIn("box", server.simulator().world().model_names)
            code, text = server.end()
        self.assertEqual(code, 0, text)
        lines = [line for line in text.splitlines() if "libnowhere_at_all.so" in line]
        self.assertEqual(len(lines), 1, text)
        self.assertIn("twin", lines[0])


if __name__ == "__main__":
    rospy.init_node("compiled_faults_rostest")
    rostest.rosrun("gazebo_ros", "compiled_faults", Faults)
