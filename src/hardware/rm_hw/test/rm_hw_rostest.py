#!/usr/bin/env python3
"""rm_hw driving motors of the bench through a serial port, with every fault while it runs, and every way to end."""

import math
import os
import re
import signal
import subprocess
import tempfile
import unittest

import rospy
import rosservice
import rostest
from controller_manager_msgs.srv import LoadController, SwitchController
from rm_hw.srv import BenchCommand
from rm_msgs.msg import ActuatorState
from rm_msgs.srv import EnableImuTrigger
from sensor_msgs.msg import JointState
from std_msgs.msg import Bool, Float64
from test_support import wait_until

PATIENCE = 60.0
GEAR = 19.2032
CONTROLLERS = ("joint_states_controller", "arm_position", "arm_velocity", "arm_effort", "wheel_effort", "yaw_effort", "arm_broken")


class Watch:
    """Latest messages, and the log: what rm_hw writes to its terminal, for /rosout connects later than the first line."""

    def __init__(self):
        self.state, self.truth, self.joints = None, None, None
        self.log = tempfile.NamedTemporaryFile("r", suffix=".log", errors="replace")
        rospy.Subscriber("/actuator_states", ActuatorState, lambda m: setattr(self, "state", m))
        rospy.Subscriber("/motor_bench/joint_states", JointState, lambda m: setattr(self, "truth", m))
        rospy.Subscriber("/joint_states", JointState, lambda m: setattr(self, "joints", m))
        self.lines = ""

    def of(self, motor, field):
        """A field of /actuator_states for one motor."""
        state = self.state
        return getattr(state, field)[state.name.index(motor)]

    def real(self, motor, field):
        """What the bench knows about one motor, behind its gearbox."""
        truth = self.truth
        return getattr(truth, field)[truth.name.index(motor)]

    def said(self, pattern):
        """Whether a line since ``forget`` matches."""
        self.lines += self.log.read()
        return re.search(pattern, self.lines) is not None

    def forget(self):
        self.log.read()
        self.lines = ""

    def hears(self, pattern):
        """Wait for a line: it may come later than the state it tells of."""
        try:
            wait_until(lambda: self.said(pattern), f"a line '{pattern}'")
        except AssertionError as error:
            raise AssertionError(f"{error}; but\n{self.lines}") from None

    def fresh(self, count=2):
        """Wait for newer messages of everything."""
        for _ in range(count):
            self.state = self.truth = None
            wait_until(lambda: self.state and self.truth, "fresh messages")


def bench(command):
    answer = rospy.ServiceProxy("/motor_bench/command", BenchCommand)(command)
    assert answer.success, answer.message


class RmHwTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.watch = Watch()
        cls.commands = {name: rospy.Publisher(f"/{name}/command", Float64, queue_size=1, latch=True) for name in CONTROLLERS[1:-1]}
        rospy.wait_for_service("/motor_bench/command", PATIENCE)
        cls.start()

    @classmethod
    def start(cls):
        cls.watch.state = None
        with open(cls.watch.log.name, "a") as log:
            cls.process = subprocess.Popen(
                ["rosrun", "rm_hw", "rm_hw", "__name:=rm_hw"], stdout=log, stderr=log, env={**os.environ, "PYTHONUNBUFFERED": "1"}
            )
        wait_until(lambda: cls.watch.truth and cls.watch.state and not any(cls.watch.state.halted), "all motors answer")
        for name in CONTROLLERS:
            assert rospy.ServiceProxy("/controller_manager/load_controller", LoadController)(name).ok
        cls.running = []

    @classmethod
    def tearDownClass(cls):
        cls.process.send_signal(signal.SIGINT)
        cls.process.wait()

    def run_only(self, *names):
        """Switch so that exactly these controllers run."""
        stop, start = [n for n in self.running if n not in names], [n for n in names if n not in self.running]
        self.assertTrue(rospy.ServiceProxy("/controller_manager/switch_controller", SwitchController)(start, stop, 2, True, 0.0).ok)
        type(self).running = list(names)

    def setUp(self):
        if self.process.poll() is not None:
            self.start()
        self.watch.forget()
        self.run_only()

    def drive(self, controller, value):
        """Start a controller, then send its command: starting() resets it."""
        self.run_only(controller)
        wait_until(lambda: self.commands[controller].get_num_connections() > 0, f"{controller} listens")
        self.commands[controller].publish(value)

    def test_actuator_states(self):
        state = self.watch.state
        self.assertEqual(sorted(state.name), ["arm_motor", "wheel_motor", "yaw_motor"])
        self.assertEqual((self.watch.of("yaw_motor", "bus"), self.watch.of("yaw_motor", "id")), ("can1", 0x205))
        self.assertEqual(self.watch.of("arm_motor", "type"), "rm_3508")
        self.assertEqual(self.watch.of("arm_motor", "temperature"), 25)
        wait_until(lambda: self.watch.of("arm_motor", "frequency") > 100.0, "frames come fast")
        self.assertEqual(rosservice.get_service_type("/rm_hw/imu_trigger"), "rm_msgs/EnableImuTrigger")
        self.assertFalse(rospy.ServiceProxy("/rm_hw/imu_trigger", EnableImuTrigger)("none", True).is_success)

    def test_turning_by_hand(self):
        wait_until(lambda: self.watch.real("wheel_motor", "velocity") == 0.0, "the wheel rests")
        self.watch.fresh()
        before, truth = self.watch.of("wheel_motor", "position"), self.watch.real("wheel_motor", "position")
        bench("turn wheel_motor 1.5")
        wait_until(lambda: abs(self.watch.real("wheel_motor", "position") - truth - 1.5) < 1e-3, "the shaft is turned")
        self.watch.fresh()
        self.assertAlmostEqual(self.watch.of("wheel_motor", "position") - before, 1.5, delta=2e-3)
        self.assertNotEqual(self.watch.of("wheel_motor", "circle"), 0)

    def test_position_and_velocity_controllers(self):
        self.run_only("joint_states_controller")
        wait_until(lambda: self.watch.joints is not None, "joint states")
        zero = self.watch.joints.position[self.watch.joints.name.index("arm")]
        target = zero - 0.5
        self.drive("arm_position", target)
        self.run_only("arm_position", "joint_states_controller")

        def arm(field):
            return getattr(self.watch.joints, field)[self.watch.joints.name.index("arm")]

        # what is left over is gravity (at most 0.981 Nm) and dry friction (0.14 Nm) over p = 30
        wait_until(lambda: abs(arm("position") - target) < 1.15 / 30 and abs(arm("velocity")) < 0.01, "the arm is there")
        # joint_states and actuator_states are of different moments: they agree when the arm rests
        wait_until(
            lambda: abs(self.watch.of("arm_motor", "executed_effort") * GEAR - 30 * (target - arm("position"))) < 0.05,
            "the effort is the controller's",
        )
        truth = self.watch.real("arm_motor", "position")
        self.drive("arm_velocity", 3.1415)
        wait_until(lambda: self.watch.real("arm_motor", "position") > truth + 4 * math.pi, "two turns at velocity control")

    def test_effort_is_limited_and_stops_with_its_controller(self):
        bench("hold arm_motor")
        self.drive("arm_effort", 100.0)
        wait_until(lambda: self.watch.of("arm_motor", "commanded_effort") > 1.0, "the command arrives")
        self.watch.fresh()
        self.assertAlmostEqual(self.watch.of("arm_motor", "commanded_effort"), 100.0 / GEAR, places=6)
        self.assertAlmostEqual(self.watch.of("arm_motor", "executed_effort"), 2.5 / GEAR, places=6)
        wait_until(lambda: abs(self.watch.real("arm_motor", "effort") - 2.5) < 0.02, "2.5 Nm at the shaft")
        wait_until(lambda: abs(self.watch.of("arm_motor", "effort") * GEAR - 2.5) < 0.02, "and measured so")
        wait_until(lambda: abs(self.watch.of("arm_motor", "velocity")) < 1e-3, "it is stuck")
        self.run_only()
        wait_until(lambda: self.watch.real("arm_motor", "effort") == 0.0, "no controller, no current")
        bench("release arm_motor")

    def test_a_controller_that_raises_gets_no_current_and_others_keep_theirs(self):
        for motor in ("arm_motor", "wheel_motor"):
            bench(f"hold {motor}")
        fail = rospy.Publisher("/arm_broken/fail", Bool, queue_size=1, latch=True)
        self.run_only("arm_broken", "wheel_effort")
        wait_until(lambda: self.commands["wheel_effort"].get_num_connections() > 0, "wheel_effort listens")
        self.commands["wheel_effort"].publish(0.1)
        wait_until(lambda: self.watch.real("arm_motor", "effort") > 1.0, "current from the controller that will raise")
        wait_until(lambda: abs(self.watch.real("wheel_motor", "effort") - 0.1) < 0.02, "0.1 Nm at the other motor")
        fail.publish(True)
        self.watch.hears(r"'arm_broken'.*update\(\) raised ZeroDivisionError: on purpose")
        wait_until(lambda: self.watch.real("arm_motor", "effort") == 0.0, "no current after the exception")
        self.watch.fresh(5)
        self.assertEqual(self.watch.real("arm_motor", "effort"), 0.0)
        self.assertAlmostEqual(self.watch.real("wheel_motor", "effort"), 0.1, delta=0.02)
        self.assertIsNone(self.process.poll())
        type(self).running = ["wheel_effort"]
        fail.publish(False)
        for motor in ("arm_motor", "wheel_motor"):
            bench(f"release {motor}")

    def test_no_number_never_reaches_the_motor(self):
        bench("hold arm_motor")
        self.drive("arm_effort", 1.0)
        wait_until(lambda: self.watch.real("arm_motor", "effort") > 0.9, "1 Nm")
        self.commands["arm_effort"].publish(float("nan"))
        self.watch.hears("command to joint 'arm' is nan: sending 0 Nm")
        wait_until(lambda: self.watch.real("arm_motor", "effort") == 0.0, "no current")
        for _ in range(20):
            self.watch.fresh(1)
            self.assertTrue(math.isfinite(self.watch.of("arm_motor", "executed_effort")))
            self.assertEqual(self.watch.real("arm_motor", "effort"), 0.0)
        bench("release arm_motor")

    def test_a_motor_leaves_and_returns(self):
        self.drive("wheel_effort", 0.1)
        bench("leave arm_motor")
        wait_until(lambda: self.watch.of("arm_motor", "halted"), "the absent motor is disabled")
        self.watch.hears(r"'arm_motor' .*sent nothing for 2 s and is disabled: check its power")
        self.assertFalse(self.watch.of("wheel_motor", "halted"))
        wait_until(lambda: self.watch.of("wheel_motor", "executed_effort") > 0.09, "the other motor obeys")
        before = self.watch.real("wheel_motor", "position")
        wait_until(lambda: self.watch.real("wheel_motor", "position") > before + 1.0, "the other motor goes on")
        bench("return arm_motor")
        wait_until(lambda: not self.watch.of("arm_motor", "halted"), "it is used again")
        self.watch.hears(r"'arm_motor' .*is answering")

    def test_lost_and_late_frames_are_survived(self):
        bench("drop arm_motor 0.5")
        bench("late wheel_motor 0.005")
        for _ in range(30):
            self.watch.fresh(1)
            self.assertFalse(any(self.watch.state.halted))
        bench("drop arm_motor 0")
        bench("late wheel_motor 0")

    def test_garbage_on_the_line(self):
        bench("garbage can0 500")
        self.watch.hears("can0: .*no CAN frames and were ignored")
        self.watch.fresh()
        self.assertFalse(any(self.watch.state.halted))

    def test_hot_motor_is_disabled_until_it_has_cooled(self):
        bench("heat arm_motor 85")
        self.watch.hears("'arm_motor' is at 8. C: above 99 C it is disabled")
        self.assertFalse(self.watch.of("arm_motor", "halted"))
        bench("heat arm_motor 105")
        wait_until(lambda: self.watch.of("arm_motor", "halted"), "it is disabled")
        self.assertFalse(self.watch.of("wheel_motor", "halted"))
        bench("heat arm_motor 25")
        wait_until(lambda: not self.watch.of("arm_motor", "halted"), "it is used again")

    def test_bus_off(self):
        bench("busoff can1")
        wait_until(lambda: self.watch.of("yaw_motor", "halted"), "its motor is disabled")
        self.assertFalse(self.watch.of("arm_motor", "halted"))
        bench("recover can1")
        wait_until(lambda: not self.watch.of("yaw_motor", "halted"), "it is used again")

    def test_adapter_unplugged_and_plugged_in(self):
        bench("unplug can1")
        self.watch.hears("can1 is lost .*disabled until it is back")
        wait_until(lambda: self.watch.of("yaw_motor", "halted"), "its motor is disabled")
        self.assertFalse(self.watch.of("arm_motor", "halted"))
        bench("plug can1")
        wait_until(lambda: not self.watch.of("yaw_motor", "halted"), "it is used again")
        self.watch.hears("Successfully connected to can1")

    def end(self, how):
        bench("hold arm_motor")
        self.drive("arm_effort", 1.0)
        wait_until(lambda: abs(self.watch.real("arm_motor", "effort") - 1.0) < 0.02, "1 Nm")
        self.process.send_signal(how)
        self.process.wait()
        wait_until(lambda: self.watch.real("arm_motor", "effort") == 0.0, "the current is off")
        bench("release arm_motor")

    def test_interrupt_switches_off(self):
        self.end(signal.SIGINT)
        self.assertEqual(self.process.returncode, 0)

    def test_terminate_switches_off(self):
        self.end(signal.SIGTERM)

    def test_kill_switches_off(self):
        self.end(signal.SIGKILL)


if __name__ == "__main__":
    rospy.init_node("rm_hw_test")
    rostest.rosrun("rm_hw", "rm_hw_driver", RmHwTest)
