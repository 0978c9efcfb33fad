#!/usr/bin/env python3
"""The example of the documentation, a plugin in C++ beside its twin in Python: built as a user would, they move alike."""

import importlib.util
import os
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ET

import rospy
import rostest

HERE = os.path.dirname(os.path.realpath(__file__))
sys.path.insert(0, HERE)
from simulator import Case  # noqa: E402

EXAMPLE = os.path.join(HERE, *[os.pardir] * 4, "docs", "examples", "my_model_plugins")


@unittest.skipUnless(importlib.util.find_spec("gazebo_cpp._core"), "this system lacks what Gazebo's headers need")
class ExampleTest(Case):
    def setUp(self):
        """The worlds of the other tests have other models."""

    def test_twins_move_alike(self):
        with tempfile.TemporaryDirectory() as folder:
            for command in (["cmake", "-S", EXAMPLE, "-B", folder, f"-DCATKIN_DEVEL_PREFIX={folder}/devel"], ["cmake", "--build", folder]):
                done = subprocess.run(command, capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            for model in ET.parse(os.path.join(EXAMPLE, "worlds", "twins.world")).iter("model"):
                plugin = model.find("plugin")
                if plugin.get("filename") == "libmy_swing.so":
                    plugin.set("filename", f"{folder}/devel/lib/libmy_swing.so")
                sdf = f'<sdf version="1.6">{ET.tostring(model, encoding="unicode")}</sdf>'
                self.done(self.sim.spawn(model.get("name"), sdf))
        farthest = 0.0
        for _ in range(20):
            self.sim.step(100)
            cpp, python = (self.sim.link(f"{name}::arm").link_state.pose.orientation.x for name in ("cpp", "python"))
            self.assertAlmostEqual(cpp, python, delta=1e-12)
            farthest = max(farthest, abs(cpp))
        self.assertGreater(farthest, 0.2)  # sin(0.5 / 2)


if __name__ == "__main__":
    rospy.init_node("example_rostest")
    rostest.rosrun("gazebo_ros", "example", ExampleTest)
