#!/usr/bin/env python3
"""spawn_model -paused_until_controllers: an arm on effort joints does not fall before its controller runs, however late that is."""

import subprocess

import rospy
import rostest
import test_support
from gazebo_msgs.srv import DeleteModel, GetPhysicsProperties
from sensor_msgs.msg import JointState

SAG = 4.9 / 5000  # rad: the torque of the rod's weight over the gain
BARE = """<robot name="b"><link name="l"><inertial><mass value="1"/>
<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link></robot>"""


class Held(test_support.TestCase):
    def test_it_begins_where_it_was_spawned(self):
        seen = []
        rospy.Subscriber("/held/joint_states", JointState, lambda m: seen.append((m.header.stamp.to_sec(), m.position[0])))
        self.wait(lambda: len(seen) > 200 and seen[-1][0] > 1.0)
        positions = [position for _, position in seen]
        self.assertLess(max(map(abs, positions)), 3 * SAG)  # free it would hang, at 1.57, after a second
        self.assertAlmostEqual(positions[-1], SAG, delta=SAG / 10)

    def test_a_model_without_controllers_is_not_waited_for(self):
        rospy.wait_for_service("/gazebo/get_physics_properties", 60)
        physics = rospy.ServiceProxy("/gazebo/get_physics_properties", GetPhysicsProperties)
        rospy.wait_for_message("/held/joint_states", JointState, 90)
        self.wait(lambda: not physics().pause)  # the arm of the other test is held no more
        done = subprocess.run(
            ["rosrun", "gazebo_ros", "spawn_model", "-urdf", "-stdin", "-model", "bare", "-x", "5", "-paused_until_controllers"],
            input=BARE,
            text=True,
            capture_output=True,
            timeout=60,
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("no controllers to wait for", done.stdout + done.stderr)
        self.assertFalse(physics().pause)
        self.assertFalse(rospy.has_param("/gazebo/paused_until_controllers/bare"))
        rospy.ServiceProxy("/gazebo/delete_model", DeleteModel)("bare")

    def wait(self, condition):
        while not condition():
            self.assertFalse(rospy.is_shutdown())
            rospy.rostime.wallsleep(0.02)


if __name__ == "__main__":
    rospy.init_node("held_test", disable_rostime=True)
    rostest.rosrun("gazebo_ros_control", "held", Held)
