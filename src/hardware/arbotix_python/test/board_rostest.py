#!/usr/bin/env python3
"""The driver with a board on a pseudo-terminal: wheels, servos and pins over the real protocol."""

import subprocess
import time
import unittest

import rospy
import rostest
from arbotix_msgs.msg import Analog
from board_simulator import BOARD, BoardSimulator
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from ros_helpers import Collector, RunningClock
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64

WIDTH, TICKS = 0.26, 4100


class Board(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.board = BoardSimulator(servo_ids=(4,), encoders=(2**31 - 50, -(2**31) + 50))  # about to wrap
        cls.board.registers[BOARD][18 + 2] = 200
        rospy.set_param(
            "/arbotix",
            {
                "port": cls.board.port,
                "timeout": 1.0,
                "joints": {"pan": {"id": 4}},
                "analog_sensors": {"battery": {"pin": 2, "rate": 10}},
                "controllers": {
                    "base": {
                        "type": "diff_controller",
                        "base_width": WIDTH,
                        "ticks_meter": TICKS,
                        "Kp": 12,
                        "Kd": 12,
                        "Ki": 0,
                        "Ko": 50,
                        "accel_limit": 1.0,
                    }
                },
            },
        )
        cls.driver = subprocess.Popen(["rosrun", "arbotix_python", "arbotix_driver"])

    @classmethod
    def tearDownClass(cls):
        cls.driver.send_signal(2)
        cls.driver.wait(timeout=60)
        speeds = cls.board.wheel_speeds[-1]
        cls.board.close()
        assert speeds == (0, 0), "the driver left the wheels turning"

    def test_drive(self):
        odometry = Collector("/odom", Odometry)
        commands = rospy.Publisher("/cmd_vel", Twist, queue_size=1, latch=True)
        twist = Twist()
        twist.linear.x, twist.angular.z = 0.3, 0.5
        goal = (int((0.3 - 0.5 * WIDTH / 2) * TICKS / 30), int((0.3 + 0.5 * WIDTH / 2) * TICKS / 30))
        end = time.monotonic() + 60
        while goal not in self.board.wheel_speeds:  # over and over, as one holds a key: a driver that starts may be deaf
            self.assertLess(time.monotonic(), end, self.board.wheel_speeds)
            commands.publish(twist)
            time.sleep(0.01)
        odometry.wait_for(lambda m: m.twist.twist.linear.x > 0.2, "motion")
        odometry.wait_for(
            lambda m: len(odometry.messages) > 30 and m is odometry.messages[-1] and m.twist.twist.linear.x == 0,
            "stop after the time-out of 1 s",
        )
        self.assertEqual(self.board.gains, [12, 12, 0, 50])
        for before, after in zip(self.board.wheel_speeds, self.board.wheel_speeds[1:]):
            self.assertLessEqual(max(abs(a - b) for a, b in zip(after, before)), TICKS / 10)
        # the encoders count three frames of 1/30 s of each set point; both wrapped round 2**31 on the way
        way = sum((left + right) / 2 for left, right in self.board.wheel_speeds) * 3 / TICKS
        turned = sum(right - left for left, right in self.board.wheel_speeds) * 3 / TICKS / WIDTH
        chord = odometry.messages[-1].pose.pose.position
        self.assertGreater(turned, 0)
        self.assertAlmostEqual((chord.x**2 + chord.y**2) ** 0.5, way, delta=0.05 * way)

    def test_servo(self):
        states = Collector("/joint_states", JointState)
        publisher = rospy.Publisher("/pan/command", Float64, queue_size=1, latch=True)
        publisher.publish(0.8)
        states.wait_for(lambda m: "pan" in m.name and abs(m.position[m.name.index("pan")] - 0.8) < 0.003, "pan at 0.8")
        registers = self.board.registers[4]
        self.assertEqual(registers[30] + 256 * registers[31], round(512 + 0.8 / (5.235987756 / 1024)))

    def test_health(self):
        diagnostics = Collector("/diagnostics", DiagnosticArray)

        def reported(message):
            pairs = {pair.key: pair.value for entry in message.status if entry.name == "pan" for pair in entry.values}
            return pairs.get("Voltage") == "11.8" and pairs.get("Temperature") == "31"

        diagnostics.wait_for(reported, "voltage and temperature")

    def test_pin(self):
        Collector("/arbotix/battery", Analog).wait_for(lambda m: m.value == 200, "battery reading")


if __name__ == "__main__":
    rospy.init_node("board_rostest")
    clock = RunningClock()
    rostest.rosrun("arbotix_python", "board", Board)
    clock.stop()
