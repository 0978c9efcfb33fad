#!/usr/bin/env python3
"""The lab's main job: the arm goes to (1, 1, 1, 1) at its speed limit, exactly, and the links follow."""

import unittest

import numpy as np
import rospy
import rostest
from controller_manager_msgs.srv import LoadController, SwitchController, SwitchControllerRequest
from gazebo_msgs.srv import DeleteModel, GetLinkState, SpawnModel
from geometry_msgs.msg import Pose, Quaternion
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
        publishers = [
            rospy.Publisher("/arm/joint%d_position_controller/command" % index, Float64, queue_size=1, latch=True) for index in range(4)
        ]
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

    def test_z_deleted_and_spawned_again_while_controllers_run(self):
        """Named to run last: the model goes and comes back, its controller manager with it, and it obeys again."""
        names = ["joint_state_controller"] + ["joint%d_position_controller" % index for index in range(4)]
        self.assertTrue(rospy.ServiceProxy("/gazebo/delete_model", DeleteModel)("arm").success)
        with self.assertRaises(rospy.ROSException):
            rospy.wait_for_service("/arm/controller_manager/load_controller", timeout=0.2)
        answer = rospy.ServiceProxy("/gazebo/spawn_urdf_model", SpawnModel)(
            "arm", rospy.get_param("/robot_description"), "/", Pose(orientation=Quaternion(w=1.0)), ""
        )
        self.assertTrue(answer.success, answer.status_message)
        again = rospy.ServiceProxy("/gazebo/spawn_urdf_model", SpawnModel)(
            "arm", rospy.get_param("/robot_description"), "/", Pose(orientation=Quaternion(w=1.0)), ""
        )
        self.assertFalse(again.success, "a second model of that name is refused")
        load = rospy.ServiceProxy("/arm/controller_manager/load_controller", LoadController)
        load.wait_for_service(60)
        self.assertTrue(all(load(name).ok for name in names))
        switch = rospy.ServiceProxy("/arm/controller_manager/switch_controller", SwitchController)
        self.assertTrue(switch(names, [], SwitchControllerRequest.STRICT, False, 0.0).ok)
        states = Topic("/arm/joint_states", JointState)
        publishers = [
            rospy.Publisher("/arm/joint%d_position_controller/command" % index, Float64, queue_size=1, latch=True) for index in range(4)
        ]
        for publisher, value in zip(publishers, (0.2, float("nan"), 0.2, float("inf"))):
            publisher.publish(value)
        states.wait_for(lambda m: m.position[0] == 0.2 and m.position[2] == 0.2, "j0 and j2 at 0.2 rad")
        newest = states.messages[-1].position
        self.assertTrue(np.isfinite(newest).all(), "commands that are no number reach no joint")
        self.assertEqual(newest[1], 0.0)


if __name__ == "__main__":
    rospy.init_node("arm_gazebo_rostest")
    rostest.rosrun("arm_gazebo", "arm_gazebo", ArmGazebo)
