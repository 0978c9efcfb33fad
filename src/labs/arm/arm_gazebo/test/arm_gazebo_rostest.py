#!/usr/bin/env python3
"""The lab's main job: the arm goes to (1, 1, 1, 1) at its speed limit, exactly, and the links follow."""
import unittest

import numpy as np
import rospy
import rostest
from gazebo_msgs.srv import GetLinkState
from lab_tools.simulation import Topic, run_free
from lab_tools.urdf import pose_of
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64

JOINTS = ["j0", "j1", "j2", "j3"]
STEP, SPEED = 0.01, 0.1  # s per step of the world, rad/s


class ArmGazebo(unittest.TestCase):
    def test_to_one_one_one_one(self):
        states = Topic("/arm/joint_states", JointState)
        states.wait_for(lambda m: True, "joint states")
        run_free()
        publishers = [rospy.Publisher("/arm/joint%d_position_controller/command" % index, Float64, queue_size=1,
                                      latch=True) for index in range(4)]
        for publisher in publishers:
            publisher.publish(1.0)
        states.wait_for(lambda m: min(m.position) == 1.0, "all joints at 1 rad")

        times = np.array([m.header.stamp.to_sec() for m in states.messages])
        places = np.array([m.position for m in states.messages])
        self.assertEqual(states.messages[-1].name, JOINTS)
        for joint in range(4):
            moving = np.flatnonzero((places[:, joint] > 0) & (places[:, joint] < 1))
            steps = np.round((times[moving] - times[moving[0]]) / STEP)
            expected = places[moving[0], joint] + steps * STEP * SPEED
            np.testing.assert_allclose(places[moving, joint], expected, atol=1e-9)
            self.assertLessEqual(places[:, joint].max(), 1.0)

        text = rospy.get_param("/robot_description")
        expected = pose_of(text, "dyn4_r", "world", dict.fromkeys(JOINTS, 1.0))[:3, 3]
        state = rospy.ServiceProxy("/gazebo/get_link_state", GetLinkState)("arm::dyn4_r", "world").link_state
        place = [state.pose.position.x, state.pose.position.y, state.pose.position.z]
        np.testing.assert_allclose(place, expected, atol=1e-6)


if __name__ == "__main__":
    rospy.init_node("arm_gazebo_rostest")
    rostest.rosrun("arm_gazebo", "arm_gazebo", ArmGazebo)
