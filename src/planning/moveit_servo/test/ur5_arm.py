"""The UR5 in the simulator, as its tests see it."""

import unittest

import numpy as np
import rospy
import tf2_ros
from controller_manager_tests.client import ManagerClient
from geometry_msgs.msg import TwistStamped, Vector3
from sensor_msgs.msg import JointState
from test_support.waiting import wait_until

JOINTS = ["shoulder_pan_joint", "shoulder_lift_joint", "elbow_joint", "wrist_1_joint", "wrist_2_joint", "wrist_3_joint"]
HOME = [0.0, -1.5707, 1.5707, -1.5707, -1.5707, 0.0]
SECONDS = 2.0
PERIOD, HALTS = 0.008, 4  # of ur_simulated_config.yaml
VELOCITY = np.array([0.0, 0.05, -0.04])  # m/s


def twist():
    message = TwistStamped()
    message.header.frame_id = "world"
    message.twist.linear = Vector3(*VELOCITY)
    return message


class Ur5Test(unittest.TestCase):
    CONTROLLER = "arm_controller"

    @classmethod
    def setUpClass(cls):
        cls.transforms = tf2_ros.Buffer()
        cls.listener = tf2_ros.TransformListener(cls.transforms)
        cls.state = None
        cls.states = rospy.Subscriber("/joint_states", JointState, lambda message: setattr(cls, "state", message))
        ManagerClient().wait_until_running(cls.CONTROLLER)

    @classmethod
    def joint(cls, name):
        return cls.state.position[cls.state.name.index(name)]

    @classmethod
    def is_home(cls):
        return cls.state and np.allclose([cls.joint(name) for name in JOINTS], HOME, atol=0.01)

    def tip(self):
        """Where the arm stands, m in world, once it does."""
        begin = rospy.Time.now()

        def standing():
            return self.state and self.state.header.stamp > begin and np.abs(self.state.velocity).max() < 2e-3 and self.state.header.stamp

        since = wait_until(standing, "an arm that stands")

        def transform():
            """The last one, unless it is of before."""
            if not self.transforms.can_transform("world", "ee_link", rospy.Time()):
                return None
            last = self.transforms.lookup_transform("world", "ee_link", rospy.Time())
            return last.transform.translation if last.header.stamp >= since else None

        now = wait_until(transform, "a transform of the tip")
        return np.array([now.x, now.y, now.z])

    def send(self, node, topic, message, ended):
        """For SECONDS of simulated time, then nothing more until ``ended()``."""
        publisher = rospy.Publisher(f"/{node}/{topic}", type(message), queue_size=1)
        wait_until(publisher.get_num_connections, node)
        rate = rospy.Rate(100)
        end = rospy.Time.now() + rospy.Duration(SECONDS - 0.1)  # it goes on for incoming_command_timeout
        while rospy.Time.now() < end:
            message.header.stamp = rospy.Time.now()
            publisher.publish(message)
            rate.sleep()
        wait_until(ended, "the halt")

    def assert_way(self, moved, time, least):
        """The tip moved along VELOCITY for that time, s, or at least for that part of it."""
        speed = np.linalg.norm(VELOCITY)
        way = moved @ VELOCITY / speed
        self.assertLess(np.linalg.norm(np.cross(moved, VELOCITY)) / speed, 0.006)  # aside
        self.assertLess(way, time * speed + 0.006)
        self.assertGreater(way, least * time * speed)
