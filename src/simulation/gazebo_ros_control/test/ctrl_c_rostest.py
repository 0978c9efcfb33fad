#!/usr/bin/env python3
"""Ctrl-C on a launched robot, soon and late: everything ends by the first signal and nobody prints a traceback."""

import os
import signal
import subprocess
import sys
import tempfile
import threading
import unittest
from xml.sax.saxutils import quoteattr

import rostest
from simulated_robot import joint, transmission, urdf
from test_support import free_port

#: s after roslaunch has started the last node: imports, registrations, spawning, loading controllers, running
MOMENTS = (0.4, 0.8, 1.2, 1.6, 2.2, 3.0, 6.0)
#: s after which roslaunch would help with SIGTERM, and say so
PATIENCE = 10.0
PLUGIN = '<gazebo><plugin name="control" filename="libgazebo_ros_control.so"><robotNamespace>/</robotNamespace></plugin></gazebo>'
LAUNCH = """<launch>
  <include file="$(find gazebo_ros)/launch/empty_world.launch"><arg name="gui" value="false"/></include>
  <param name="robot_description" value={robot}/>
  <rosparam>
    states: {{type: joint_state_controller/JointStateController, publish_rate: 50}}
    effort: {{type: effort_controllers/JointEffortController, joint: j}}
  </rosparam>
  <node name="spawn" pkg="gazebo_ros" type="spawn_model" args="-urdf -param robot_description -model robot" output="screen"/>
  <node name="spawner" pkg="controller_manager" type="spawner" args="states effort" output="screen"/>
</launch>"""


def launched_and_interrupted(after):
    """All that a launch prints whose roslaunch gets SIGINT so many s after the last node was started; its exit code."""
    robot = urdf(joint("j"), transmission("t", "j", "hardware_interface/EffortJointInterface"), PLUGIN)
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "robot.launch")
        with open(path, "w", encoding="utf-8") as file:
            file.write(LAUNCH.format(robot=quoteattr(robot)))
        port = free_port()
        process = subprocess.Popen(
            ["roslaunch", "-p", str(port), f"--sigint-timeout={PATIENCE}", path],
            text=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            start_new_session=True,
            env={**os.environ, "ROS_MASTER_URI": f"http://localhost:{port}", "ROS_HOME": folder, "PYTHONUNBUFFERED": "1"},
        )
        lines = []
        try:
            for line in process.stdout:
                lines.append(line)
                if "process[spawner-" in line:
                    threading.Timer(after, process.send_signal, (signal.SIGINT,)).start()
            process.wait(timeout=60)
        finally:
            if process.poll() is None:
                process.kill()
        return "".join(lines), process.returncode


class CtrlC(unittest.TestCase):
    def test_soon_and_late(self):
        for after in MOMENTS:
            text, code = launched_and_interrupted(after)
            what = f"{after} s after the launch:\n{text}"
            self.assertEqual(code, 0, what)
            self.assertIn("spawner-4] killing on exit", what)
            for trouble in ("Traceback", "KeyboardInterrupt", "Exception", "escalating", "[FATAL]"):
                self.assertNotIn(trouble, what)


if __name__ == "__main__":
    rostest.rosrun("gazebo_ros_control", "ctrl_c", CtrlC, sys.argv)
