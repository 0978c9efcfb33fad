#!/usr/bin/env python3
"""What servo_rostest.py leaves at its usual value: halts by the distance that stopping takes, points for Gazebo, mice of six axes."""

import os
import subprocess
import unittest

import numpy as np
import rospy
import rostest
from moveit_msgs.msg import CollisionObject
from sensor_msgs.msg import Joy
from servo_rostest import HALT_COLLISION, HOME, JOINTS, NO_WARNING, PERIOD, Arm, box, jacobian, jog, tip, twist
from std_msgs.msg import Float64
from std_srvs.srv import Empty
from test_support.hearing import deliver, heard
from test_support.waiting import wait_until

HERE = os.path.dirname(os.path.abspath(__file__))
ACCELERATION = 4.0  # rad/s^2, of each joint, of parameters.yaml
SAFETY, CHECK, NEAREST = 8.0, 0.1, 0.01  # of options.test: factor, s between two checks, m
WAY = 0.3 - 0.05 - 0.08  # m, from the hand, which is 0.16 m wide, to a box of 0.1 m that stands 0.3 m beside it


class Options(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.arm = Arm()
        cls.objects = rospy.Publisher("/collision_object", CollisionObject, queue_size=10)

    def place(self, node):
        self.arm.lead(node)
        self.arm.put(HOME)

    # ------------------------------------------------------------ stop_distance

    def approach(self, speed, way=WAY):
        """How far the box still is, m, where the arm halts that comes at this speed, m/s; and where it was when it began."""
        self.place("stops")
        times = []
        listener = rospy.Subscriber("/stops/internal/worst_case_stop_time", Float64, lambda message: times.append(message.data))
        self.addCleanup(listener.unregister)
        wait_until(lambda: self.objects.get_num_connections() >= 2 and heard([listener]), "the nodes")
        start = tip(HOME)[1]
        deliver(self.objects, box(start + [0, way + 0.05 + 0.08, 0], 0.1))
        self.arm.step(40)  # what appears comes near at a great speed: while the arm stands it does not count
        self.addCleanup(self.objects.publish, box((0, 0, 0), 0.1, CollisionObject.REMOVE))
        for _ in range(round(2 * way / speed / PERIOD)):
            self.arm.step(1, twist((0, speed, 0)))
            if self.arm.statuses[-1] == HALT_COLLISION:
                break
        self.assertEqual(self.arm.statuses[-1], HALT_COLLISION)
        joints = np.abs(np.linalg.solve(jacobian(self.arm.q), [0, speed, 0, 0, 0, 0]))
        self.assertAlmostEqual(max(times[-20:]), max(joints) / ACCELERATION, delta=0.05 * max(joints) / ACCELERATION)
        stays = self.arm.q.copy()
        self.arm.step(30, twist((0, speed, 0)))
        np.testing.assert_allclose(self.arm.q, stays, atol=3 * PERIOD * max(joints))
        self.assertEqual(list(self.arm.commands[-1].points[0].velocities), [0.0] * 6)
        return way - (tip(self.arm.q)[1] - start)[1], max(joints) / ACCELERATION

    def test_it_halts_where_it_could_just_stop(self):
        speed = 0.1
        left, stop_time = self.approach(speed)
        expected = speed * SAFETY * stop_time
        self.assertGreater(expected, 0.04)
        self.assertLess(left, 1.15 * expected)
        self.assertGreater(left, expected - speed * (CHECK + 5 * PERIOD))  # it goes on till the next check
        rospy.ServiceProxy("/stops/reset_servo_status", Empty)()
        self.arm.step(50, twist((0, -speed, 0)))  # on its way out it is free at full speed
        self.assertEqual(self.arm.statuses[-1], NO_WARNING)
        self.assertGreater(WAY - (tip(self.arm.q)[1] - tip(HOME)[1])[1], left + 0.03)

    def test_it_halts_at_the_nearest_distance_that_is_allowed(self):
        left, stop_time = self.approach(0.02, 0.04)
        self.assertLess(0.02 * SAFETY * stop_time, NEAREST)
        self.assertLess(left, NEAREST)
        self.assertGreater(left, NEAREST - 0.02 * (CHECK + 5 * PERIOD))

    # ------------------------------------------------------------ use_gazebo

    def test_a_trajectory_for_gazebo_repeats_its_point(self):
        self.place("gazebo")
        self.arm.step(20, jog(joint_3=0.4))
        points = self.arm.moving()[-1].points
        self.assertEqual(len(points), 30)
        np.testing.assert_allclose([point.time_from_start.to_sec() for point in points], PERIOD * np.arange(1, 31), atol=1e-9)
        for point in points:
            self.assertEqual(
                (point.positions, point.velocities, point.accelerations), (points[0].positions, points[0].velocities, (0.0,) * 6)
            )
        self.assertEqual(self.arm.moving()[-1].joint_names, JOINTS)
        self.arm.step(30)
        halt = self.arm.commands[-1]
        self.assertFalse(any(any(point.velocities) for point in halt.points))
        stays = self.arm.q.copy()
        self.arm.step(10)
        np.testing.assert_array_equal(self.arm.q, stays)

    # ------------------------------------------------------------ launch files

    def assert_mouse_moves(self, launch, joy, expected):
        """A mouse whose driver is this test: the package of the driver is the user's."""
        command = ["roslaunch", "moveit_servo", launch, f"config:={HERE}/mouse.yaml"]
        process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.addCleanup(process.communicate)
        self.addCleanup(process.terminate)
        self.place("servo_server")
        mouse = rospy.Publisher("/spacenav/joy", Joy, queue_size=1)
        wait_until(lambda: self.arm.tick() or mouse.get_num_connections(), "who translates the mouse")
        start = tip(HOME)[1]

        def moved():
            joy.header.stamp = rospy.Time(0, self.arm.now)
            mouse.publish(joy)
            self.arm.step()
            return np.linalg.norm(tip(self.arm.q)[1] - start) > 0.05

        wait_until(moved, "the arm to move")
        way = tip(self.arm.q)[1] - start
        np.testing.assert_allclose(way / np.linalg.norm(way), expected, atol=0.05)

    def test_a_mouse_by_the_program(self):
        joy = Joy(axes=[0.0, 0.5, -0.5, 0.0, 0.0, 0.0], buttons=[0, 0])
        self.assert_mouse_moves("spacenav_cpp.launch", joy, [0, np.sqrt(0.5), -np.sqrt(0.5)])


if __name__ == "__main__":
    rospy.init_node("options_test")
    rostest.rosrun("moveit_servo", "options", Options)
