#!/usr/bin/env python3
"""Cars whose steering is position-commanded, under the steering controllers, in the simulator. In simulated time."""

import math
import time
import unittest

import numpy as np
import rospy
import rostest
from four_wheel_steering_msgs.msg import FourWheelSteering
from gazebo_msgs.srv import GetModelState
from gazebo_ros.srv import StepWorld
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from test_support import heading

WHEELBASE = 0.5  # m
STEP = 0.001  # s


def circle(points):
    """Radius of the circle through (N, 2) points, least squares, m."""
    x, y = np.asarray(points).T
    a, b, c = np.linalg.lstsq(np.column_stack((x, y, np.ones_like(x))), x * x + y * y, rcond=None)[0]
    return math.sqrt(c + (a * a + b * b) / 4)


class Car:
    """``run`` moves time on; ``command`` publishes until the wheels' odometry shows that it has arrived."""

    def __init__(self, name, message=Twist, topic="cmd_vel"):
        self.name = name
        self.step = rospy.ServiceProxy("/gazebo/step", StepWorld, persistent=True)
        self.state = rospy.ServiceProxy("/gazebo/get_model_state", GetModelState, persistent=True)
        self.odometry = None
        self.subscriber = rospy.Subscriber(f"/{name}/drive/odom", Odometry, self.receive)
        self.publisher = rospy.Publisher(f"/{name}/drive/{topic}", message, queue_size=1)
        end = time.monotonic() + 90
        while not (self.odometry and self.publisher.get_num_connections()):
            if time.monotonic() > end:
                raise AssertionError(f"the controller of {name} does not run")
            self.step(20)  # the spawner waits for the world, the world for the test
            time.sleep(0.02)

    def receive(self, message):
        self.odometry = message

    def close(self):
        self.publisher.unregister()
        self.subscriber.unregister()

    def pose(self):
        return self.state(self.name, "").pose

    def run(self, seconds):
        assert self.step(round(seconds / STEP)).success
        return self.pose()

    def command(self, message, speed, turn=0.0):
        def off():
            now = self.odometry.twist.twist
            return math.hypot(math.hypot(now.linear.x, now.linear.y) - speed, now.angular.z - turn)

        end = time.monotonic() + 60
        while off() > 0.02:
            if time.monotonic() > end:
                raise AssertionError(f"{self.name} does not reach {speed} m/s and {turn} rad/s but {self.odometry.twist.twist}")
            self.publisher.publish(message)
            self.run(0.05)
            time.sleep(0.005)

    def path(self, seconds, forwards=0.0):
        """(N, 2) positions of the point ``forwards`` of the middle, every 0.2 s."""
        points = []
        for _ in range(round(seconds / 0.2)):
            pose = self.run(0.2)
            points.append(
                (
                    pose.position.x + forwards * math.cos(heading(pose.orientation)),
                    pose.position.y + forwards * math.sin(heading(pose.orientation)),
                )
            )
        return points


def twist(forwards, turn):
    message = Twist()
    message.linear.x, message.angular.z = forwards, turn
    return message


class SteeredCars(unittest.TestCase):
    def setUp(self):
        rospy.wait_for_service("/gazebo/step", 60)

    def car(self, *args):
        car = Car(*args)
        self.addCleanup(car.close)
        return car

    def straight(self, car, metres, speed, message):
        car.command(message, speed)
        start = car.run(1.0)  # the wheels spin at first
        end = car.run(metres / speed)
        self.assertAlmostEqual(
            math.dist((start.position.x, start.position.y), (end.position.x, end.position.y)), metres, delta=0.03 * metres
        )
        self.assertAlmostEqual(heading(end.orientation), heading(start.orientation), delta=0.01)
        self.assertAlmostEqual(end.position.z, 0.06, delta=1e-3)

    def test_ackermann_steering(self):
        car = self.car("ackermann")
        self.straight(car, 5.0, 1.0, twist(1.0, 0.0))
        for angle in (0.4, -0.5):  # the controller takes the angle of the front wheel
            rate = 0.5 / WHEELBASE * math.tan(angle)
            car.command(twist(0.5, angle), 0.5, rate)
            car.run(1.0)
            start = heading(car.pose().orientation)
            radius = circle(car.path(4.0, forwards=-WHEELBASE / 2))
            self.assertAlmostEqual(radius, WHEELBASE / math.tan(abs(angle)), delta=0.03 * radius)
            turned = math.remainder(heading(car.pose().orientation) - start, 2 * math.pi)
            self.assertAlmostEqual(turned, 4.0 * rate, delta=0.06)
        car.command(twist(0.0, 0.0), 0.0)
        before = car.run(0.5).position
        after = car.run(2.0).position
        self.assertLess(math.dist((before.x, before.y), (after.x, after.y)), 1e-3)

    def test_four_wheel_steering_turns(self):
        car = self.car("four_wheel_steering")
        self.straight(car, 5.0, 1.0, twist(1.0, 0.0))
        car.command(twist(0.5, 0.5), 0.5, 0.5)
        car.run(1.0)
        start = heading(car.pose().orientation)
        radius = circle(car.path(4.0))
        self.assertAlmostEqual(radius, 1.0, delta=0.03)
        self.assertAlmostEqual(math.remainder(heading(car.pose().orientation) - start, 2 * math.pi), 2.0, delta=0.06)

    def test_four_wheel_steering_goes_sideways(self):
        car = self.car("four_wheel_steering", FourWheelSteering, "cmd_four_wheel_steering")
        car.command(FourWheelSteering(speed=0.5, front_steering_angle=0.6, rear_steering_angle=0.6), 0.5)
        car.run(1.0)
        start = car.pose()
        end = car.run(3.0)
        course = math.atan2(end.position.y - start.position.y, end.position.x - start.position.x)
        self.assertAlmostEqual(math.remainder(course - heading(start.orientation), 2 * math.pi), 0.6, delta=0.02)
        self.assertAlmostEqual(heading(end.orientation), heading(start.orientation), delta=0.01)
        self.assertAlmostEqual(math.dist((start.position.x, start.position.y), (end.position.x, end.position.y)), 1.5, delta=0.045)


if __name__ == "__main__":
    rospy.init_node("steered_cars_test")
    rostest.rosrun("gazebo_ros_control", "steered_cars", SteeredCars)
