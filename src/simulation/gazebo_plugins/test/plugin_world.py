"""What the tests of plugins share: the world plugins.world, paused."""

import math

import numpy as np
import rospy
import test_support
from gazebo_msgs.srv import DeleteModel, GetJointProperties, GetLinkState, GetModelState, SetModelState, SpawnModel
from gazebo_ros.srv import StepWorld
from geometry_msgs.msg import Point, Pose, Quaternion
from listening import Ear, until
from std_msgs.msg import Bool
from std_srvs.srv import Empty

G = 9.8


def xyz(vector):
    return np.array((vector.x, vector.y, vector.z))


def yaw_of(pose):
    return 2 * math.atan2(pose.orientation.z, pose.orientation.w)


class PluginWorld(test_support.TestCase):
    """Time passes only through the step service."""

    @classmethod
    def setUpClass(cls):
        rospy.wait_for_message("/gazebo/ready", Bool, 60)
        for name, kind in {
            "step": StepWorld,
            "spawn_sdf_model": SpawnModel,
            "get_model_state": GetModelState,
            "get_link_state": GetLinkState,
            "get_joint_properties": GetJointProperties,
            "set_model_state": SetModelState,
            "delete_model": DeleteModel,
        }.items():
            setattr(cls, "_" + name, staticmethod(rospy.ServiceProxy("/gazebo/" + name, kind, persistent=True)))
        cls._reset = staticmethod(rospy.ServiceProxy("/gazebo/reset_simulation", Empty))
        cls._after_reset = rospy.get_param("~after_reset", False)

    def spawn(self, name, text, x, y, z=0.0):
        answer = self._spawn_sdf_model(name, text, "", Pose(Point(x, y, z), Quaternion(0, 0, 0, 1)), "")
        self.assertTrue(answer.success, answer.status_message)
        if self._after_reset:
            self.step(2.5)  # the slowest sensor, at 1 Hz, has spoken twice
            self._reset()

    def step(self, seconds):
        self.assertTrue(self._step(round(seconds * 1000)).success)

    def pose(self, name):
        return self._get_model_state(name, "").pose

    def link(self, name):
        return self._get_link_state(name, "").link_state

    def joint(self, name):
        return self._get_joint_properties(name).position[0]

    def measure(self, topic, kind, seconds=0.1, count=1):
        """The last of the messages that this much time brings, one in each ``count``-th part of it; ``count`` 0: of those of
        every step, which come faster than a queue of one holds."""
        ear = Ear(topic, kind)
        for wanted in range(1, count + 1) or (1,):
            self.step(seconds / max(count, 1))
            until(lambda: len(ear.messages) >= wanted, f"message {wanted} on {topic}")
        ear.close()
        if count:
            self.assertEqual(len(ear.messages), count, topic)
        return ear.messages[-1]

    def until_stepped(self, condition, what):
        """Something was published: it has arrived when time brings this about."""
        until(lambda: (self.step(0.01), condition())[1], what)
