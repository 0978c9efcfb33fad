#!/usr/bin/env python3
"""The UR5 in the simulator is jogged through a controller of velocities; expected is way = speed * time."""

import numpy as np
import rospy
import rostest
from control_msgs.msg import JointJog
from std_msgs.msg import Float64MultiArray
from test_support.waiting import wait_until
from ur5_arm import HALTS, Ur5Test, twist


class Velocities(Ur5Test):
    CONTROLLER = "velocities"

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        # The spawner puts the arm there when the world goes already.
        wait_until(cls.is_home, "the pose to begin with")
        cls.said = []  # time, s, and velocities, rad/s
        cls.commands = rospy.Subscriber(
            "/velocities/command", Float64MultiArray, lambda message: cls.said.append((rospy.get_time(), message.data)), tcp_nodelay=True
        )

    def jog(self, topic, message):
        """The time, s, from the first velocity until the halt."""
        self.said.clear()

        def halted():
            return len(self.said) > HALTS and not any(any(each) for _, each in self.said[-HALTS:])

        self.send("servo_server", topic, message, halted)
        self.assertTrue(all(len(each) == 6 for _, each in self.said))
        first, last = (next(time for time, each in said if any(each)) for said in (self.said, self.said[::-1]))
        return last - first

    def test_the_tip_moves_at_the_velocity_of_the_twist(self):
        before = self.tip()
        time = self.jog("delta_twist_cmds", twist())
        moved = self.tip() - before
        self.assert_way(moved, time + 0.05, 0.85)  # what was commanded last holds until the halt comes
        self.assertLess(np.linalg.norm(self.tip() - before - moved), 0.001)  # it stands

    def test_a_joint_moves_at_its_velocity(self):
        self.tip()
        angle = self.joint("elbow_joint")
        time = self.jog("delta_joint_cmds", JointJog(joint_names=["elbow_joint"], velocities=[-0.1]))
        self.tip()
        self.assertAlmostEqual(self.joint("elbow_joint") - angle, -0.1 * time, delta=0.02)
        self.assertAlmostEqual(min(each[2] for _, each in self.said), -0.1, places=6)


if __name__ == "__main__":
    rospy.init_node("velocities_test")
    rostest.rosrun("moveit_servo", "velocities", Velocities)
