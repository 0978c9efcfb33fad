#!/usr/bin/env python3
"""A controller in C++ beside its twin in Python on one simulated robot: the examples of the documentation, built as a user would."""

import os
import subprocess
import sys
import tempfile
import unittest

import rospy
import rostest
from std_msgs.msg import Float64

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from simulated_robot import DT, SimulatedRobot, joint, transmission, urdf  # noqa: E402

EXAMPLES = os.path.join(os.path.dirname(os.path.realpath(__file__)), *[os.pardir] * 4, "docs", "examples")
SINE = {"amplitude": 0.1, "frequency": 0.5}
PARAMETERS = {
    "python": {"type": "my_controllers/SineController", "joint": "left", **SINE},
    "cpp": {"type": "my_cpp_controllers/SineController", "joint": "right", **SINE},
    "no_joint": {"type": "my_cpp_controllers/SineController"},
    "clock": {"type": "controller_manager_tests/CompiledController", "joint": "middle"},
}


def build(folder):
    """The example in C++, outside of the workspace."""
    source = os.path.join(EXAMPLES, "my_cpp_controllers")
    for command in (["cmake", "-S", source, "-B", folder, f"-DCATKIN_DEVEL_PREFIX={folder}/devel"], ["cmake", "--build", folder, "-j2"]):
        done = subprocess.run(command, capture_output=True, text=True)
        assert done.returncode == 0, done.stdout + done.stderr
    os.environ["CMAKE_PREFIX_PATH"] = f"{folder}/devel:{os.environ['CMAKE_PREFIX_PATH']}"
    os.environ["ROS_PACKAGE_PATH"] = f"{EXAMPLES}:{os.environ['ROS_PACKAGE_PATH']}"


class CompiledTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        build(cls.folder.name)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def robot(self):
        position, effort = "hardware_interface/PositionJointInterface", "hardware_interface/EffortJointInterface"
        limit = '<limit lower="-3" upper="3" effort="10" velocity="5"/>'
        names = (("left", position), ("right", position), ("middle", effort))
        return SimulatedRobot(
            urdf(
                *(joint(name, limit, y=2.0 * i) for i, (name, _) in enumerate(names)),
                *(transmission(name, name, interface) for name, interface in names),
            ),
            parameters=PARAMETERS,
        )

    def test_twins_move_alike(self):
        with self.robot() as robot:
            self.assertFalse(robot.manager.load_controller("no_joint"))
            robot.start("python", "cpp")
            farthest = 0.0
            for _ in range(2000):
                robot.step()
                left, right = robot.joint("left").position(), robot.joint("right").position()
                self.assertAlmostEqual(left, right, delta=1e-12)
                farthest = max(farthest, abs(right))
            self.assertAlmostEqual(farthest, 0.1, delta=1e-4)
            robot.switch(stop=["cpp"])
            still = robot.joint("right").position()
            robot.run(0.2)
            self.assertEqual(robot.joint("right").position(), still)

    def test_the_clock_of_compiled_code_is_that_of_its_step(self):
        late = []
        rospy.Subscriber("/robot/clock/time", Float64, lambda message: late.append(message.data))
        with self.robot() as robot:
            robot.start("clock")
            while len(late) < 20:
                robot.step()
                rospy.rostime.wallsleep(DT)
            self.assertEqual(set(late), {0.0})
            self.assertEqual(robot.handle(type(robot.hw.get("hardware_interface::EffortJointInterface")), "middle").command, 2.0)


if __name__ == "__main__":
    rospy.init_node("compiled_rostest")
    rostest.rosrun("gazebo_ros_control", "compiled", CompiledTest)
