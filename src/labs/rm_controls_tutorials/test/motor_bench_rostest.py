#!/usr/bin/env python3
"""The tutorial's commands as they are typed, with mon, against the motor bench."""

import os
import signal
import subprocess
import time
import unittest

import rospy
import rostest
from rm_msgs.msg import ActuatorState
from sensor_msgs.msg import JointState
from test_support import wait_until

SETUP = os.path.join(os.environ["CMAKE_PREFIX_PATH"].split(":")[0], "setup.bash")
POSITION, VELOCITY = (f"controllers/joint1_{kind}_controller" for kind in ("position", "velocity"))


def shell(command):
    return subprocess.run(["bash", "-c", f"source {SETUP}; {command}"], capture_output=True, text=True, timeout=120).stdout


def switch(start, stop):
    return shell(
        'rosservice call /controller_manager/switch_controller "start_controllers:\n'
        f"- '{start}'\nstop_controllers:\n- '{stop}'\nstrictness: 1\nstart_asap: true\ntimeout: 0.0\""
    )


class TutorialTest(unittest.TestCase):
    def mon(self, words):
        """``mon launch`` in a shell of its own; returns its log, which is read while it runs."""
        log = f"/tmp/{rospy.get_name().strip('/')}_{os.getpid()}_{words.split()[0]}.log"
        process = subprocess.Popen(
            ["bash", "-c", f"source {SETUP}; mon launch --flush-log --log={log} rm_controls_tutorials {words}"],
            start_new_session=True,
            stdin=subprocess.DEVNULL,
        )

        def end():
            os.killpg(process.pid, signal.SIGINT)
            process.wait()
            os.remove(log)

        self.addCleanup(end)

        def read():
            if not os.path.exists(log):
                return ""
            with open(log) as file:
                return file.read()

        return read

    def test_commands_of_the_tutorial(self):
        states, joints = [], []
        rospy.Subscriber("/actuator_states", ActuatorState, states.append)
        rospy.Subscriber("/joint_states", JointState, lambda m: joints.append((m.position[0], m.velocity[0], m.header.stamp.to_sec())))
        said = self.mon("load_rm_hw.launch interface:=slcan")
        wait_until(lambda: "Successfully connected to can0" in said(), "rm_hw is connected")
        said = self.mon("load_controllers.launch")
        wait_until(lambda: said().count("Loaded 'controllers/") == 3, "three lines, one per loaded controller")

        wait_until(lambda: states, "actuator states")
        self.assertEqual((states[-1].name, list(states[-1].id)), (["joint1_motor"], [0x201]))
        wait_until(lambda: states[-1].position[0] > 19.2 and abs(states[-1].velocity[0]) < 0.01, "the arm hangs")
        before, count = states[-1].position[0], len(states)
        shell("rostopic pub -1 /motor_bench/turn/joint1_motor std_msgs/Float64 'data: 0.5'")
        wait_until(
            lambda: max((s.position[0] for s in states[count:]), default=0.0) > before + 0.4 * 19.2,
            "the rotor is turned by hand, before the weight takes it back",
        )

        self.assertIn("ok: True", switch("controllers/joint_state_controller", ""))
        wait_until(lambda: joints, "joint states")
        self.assertIn("ok: True", switch(POSITION, VELOCITY), "it does not matter that the other does not run")
        shell(f"rostopic pub -1 /{POSITION}/command std_msgs/Float64 'data: 0.0'")
        # the weight of 0.981 Nm and the gearbox's dry friction of 0.14 Nm over the gain of 30
        wait_until(lambda: abs(joints[-1][0]) < 1.13 / 30 and abs(joints[-1][1]) < 0.01, "the arm is level")
        self.assertIn("ok: True", switch(VELOCITY, POSITION))
        start = joints[-1][0]
        shell(f"rostopic pub -1 /{VELOCITY}/command std_msgs/Float64 'data: 3.1415'")
        wait_until(lambda: joints[-1][0] > start + 13.0, "two turns and more")
        # the weight makes it faster and slower; the mean of a turn is the same however late a busy machine's loop may be
        turn = [(position, stamp) for position, _, stamp in joints if start + 6.5 < position < start + 12.8]
        (first, began), (last, ended) = turn[0], turn[-1]
        self.assertAlmostEqual((last - first) / (ended - began), 2.85, delta=0.5)


if __name__ == "__main__":
    rospy.init_node("tutorial_test")
    rostest.rosrun("rm_controls_tutorials", "tutorial_on_the_motor_bench", TutorialTest)
