#!/usr/bin/env python3
"""The UR5 in the simulator is jogged as the package's example says; expected is way = speed * time."""

import actionlib
import numpy as np
import rospy
import rostest
from actionlib_msgs.msg import GoalStatus
from control_msgs.msg import FollowJointTrajectoryAction, FollowJointTrajectoryGoal, JointJog
from controller_manager_msgs.srv import SwitchController
from std_msgs.msg import Float64MultiArray
from test_support.waiting import wait_until
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint
from ur5_arm import HALTS, HOME, JOINTS, PERIOD, SECONDS, Ur5Test, twist


class Ur5(Ur5Test):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.said = {"servo_server": [], "trajectories": []}  # positions of the joints
        cls.commands = [
            rospy.Subscriber(
                "/joint_group_position_controller/command", Float64MultiArray, lambda message: cls.said["servo_server"].append(message.data)
            ),
            rospy.Subscriber(
                "/arm_controller/command", JointTrajectory, lambda message: cls.said["trajectories"].append(message.points[0].positions)
            ),
        ]
        cls.client = actionlib.SimpleActionClient("/arm_controller/follow_joint_trajectory", FollowJointTrajectoryAction)

    def switch(self, start, stop):
        rospy.wait_for_service("/controller_manager/switch_controller", timeout=60.0)
        switch = rospy.ServiceProxy("/controller_manager/switch_controller", SwitchController)
        wait_until(lambda: switch(start_controllers=[start], stop_controllers=[stop], strictness=2).ok, f"{start} to start")

    def setUp(self):
        self.assertTrue(self.client.wait_for_server(rospy.Duration(60)))
        goal = FollowJointTrajectoryGoal()
        goal.trajectory.joint_names = JOINTS
        goal.trajectory.points = [JointTrajectoryPoint(positions=HOME, time_from_start=rospy.Duration(1.0))]
        self.assertEqual(self.client.send_goal_and_wait(goal, rospy.Duration(60)), GoalStatus.SUCCEEDED)
        wait_until(self.is_home, "the pose to begin with")

    def jog(self, node, topic, message):
        """The time, s, for which the arm was commanded to move."""
        said = self.said[node]
        before = len(said)

        def halted():
            """As many commands as a halt has are where the last motion led."""
            last = said[-HALTS - 1 :]
            return len(said) > before + HALTS and all(each == last[0] for each in last)

        self.send(node, topic, message, halted)
        time = (len(said) - before - HALTS) * PERIOD  # a busy computer leaves periods out
        self.assertGreater(time, 0.5 * SECONDS)
        self.assertLess(time, 1.05 * SECONDS)
        return time

    def assert_jogs(self, node):
        before = self.tip()
        time = self.jog(node, "delta_twist_cmds", twist())
        moved = self.tip() - before
        # The controller loses what a busy computer brings too late; servo.test, which makes the time itself, judges the length.
        self.assert_way(moved, time, 0.75)
        self.assertLess(np.linalg.norm(self.tip() - before - moved), 0.001)  # it stands
        angle = self.joint("elbow_joint")
        time = self.jog(node, "delta_joint_cmds", JointJog(joint_names=["elbow_joint"], velocities=[0.1]))
        self.tip()
        self.assertLess(self.joint("elbow_joint") - angle, 0.1 * time + 0.01)
        self.assertGreater(self.joint("elbow_joint") - angle, 0.075 * time)

    def test_by_the_trajectory_controller(self):
        self.assert_jogs("trajectories")

    def test_by_the_group_controller(self):
        self.switch("joint_group_position_controller", "arm_controller")
        self.addCleanup(self.switch, "arm_controller", "joint_group_position_controller")
        self.assert_jogs("servo_server")


if __name__ == "__main__":
    rospy.init_node("ur5_test")
    rostest.rosrun("moveit_servo", "ur5", Ur5)
