#!/usr/bin/env python3
"""What the IMU controller publishes."""

import unittest

import rospy
from control_test_robots import client
from sensor_msgs.msg import Imu


class ImuSensor(unittest.TestCase):
    def messages(self, controller, topic, seconds=2.0):
        published = client.Topic(topic, Imu)
        with client.running(controller):
            if controller != "silent":
                published.next()
            client.sim_sleep(seconds)
            published.close()
            return published.messages

    def test_all_fields_at_the_rate(self):
        messages = self.messages("imus", "/base_imu")
        last = messages[-1]
        self.assertEqual(last.header.frame_id, "base_imu_link")
        self.assertEqual((last.orientation.x, last.orientation.y, last.orientation.z, last.orientation.w), (0.1, 0.2, 0.3, 0.927362))
        self.assertEqual(last.orientation_covariance, tuple(range(1, 10)))
        self.assertEqual((last.angular_velocity.x, last.angular_velocity.y, last.angular_velocity.z), (0.4, 0.5, 0.6))
        self.assertEqual(last.angular_velocity_covariance, (0.0,) * 9)
        acceleration = last.linear_acceleration
        self.assertEqual((acceleration.x, acceleration.y, acceleration.z), (0.7, 0.8, 9.9))
        stamps = [message.header.stamp.to_sec() for message in messages]
        self.assertAlmostEqual((stamps[-1] - stamps[0]) / (len(stamps) - 1), 0.05, delta=0.002)

    def test_what_is_not_measured_is_marked(self):
        last = self.messages("imus", "/gyro")[-1]
        self.assertEqual(last.orientation_covariance[0], -1.0)
        self.assertEqual(last.linear_acceleration_covariance[0], -1.0)
        self.assertEqual(last.angular_velocity_covariance, tuple(range(9, 0, -1)))
        self.assertEqual(last.angular_velocity.z, 3.0)

    def test_rate_zero_is_silent_and_none_is_refused(self):
        self.assertEqual(self.messages("silent", "/gyro", 1.0), [])
        self.assertFalse(client.loads("no_rate"))


if __name__ == "__main__":
    import rostest

    rospy.init_node("imu_sensor")
    rostest.rosrun("imu_sensor_controller", "imu_sensor", "__main__")
