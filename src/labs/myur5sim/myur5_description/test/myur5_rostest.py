#!/usr/bin/env python3
"""The UR5 on its pedestal follows a trajectory goal; the calibration topic says that it may."""

import unittest

import actionlib
import numpy as np
import rospy
import rostest
from control_msgs.msg import (
    FollowJointTrajectoryAction,
    FollowJointTrajectoryActionResult,
    FollowJointTrajectoryGoal,
    JointTrajectoryControllerState,
)
from lab_tools.simulation import PATIENCE, Topic, run_free
from std_msgs.msg import Bool
from trajectory_msgs.msg import JointTrajectoryPoint

JOINTS = ["shoulder_pan_joint", "shoulder_lift_joint", "elbow_joint", "wrist_1_joint", "wrist_2_joint", "wrist_3_joint"]
TARGET = [0.5, -1.0, 1.2, -0.4, -1.0, 0.3]


class MyUr5(unittest.TestCase):
    def test_goal(self):
        states = Topic("/arm_controller/state", JointTrajectoryControllerState)
        states.wait_for(lambda m: True, "state")
        self.assertTrue(rospy.wait_for_message("/calibrated", Bool, PATIENCE).data)
        results = Topic("/arm_controller/follow_joint_trajectory/result", FollowJointTrajectoryActionResult)
        run_free()
        client = actionlib.SimpleActionClient("/arm_controller/follow_joint_trajectory", FollowJointTrajectoryAction)
        self.assertTrue(client.wait_for_server(rospy.Duration(1000)))
        goal = FollowJointTrajectoryGoal()
        goal.trajectory.joint_names = JOINTS
        goal.trajectory.points = [JointTrajectoryPoint(positions=TARGET, velocities=[0] * 6, time_from_start=rospy.Duration(2))]
        client.send_goal(goal)
        self.assertTrue(client.wait_for_result(rospy.Duration(1000)))
        result = client.get_result()
        self.assertEqual((result.error_code, result.error_string), (0, ""))
        # The server's stamp: this process's clock may lag behind a simulator that runs as fast as it can.
        arrived = results.wait_for(lambda m: True, "result").header.stamp
        tolerance = rospy.get_param("~tolerance")  # the integral of the effort interface takes a while to carry the weight
        states.wait_for(
            lambda m: m.header.stamp > arrived and np.abs(np.subtract(m.actual.positions, TARGET)).max() <= tolerance, "rest at the target"
        )


if __name__ == "__main__":
    rospy.init_node("myur5_rostest")
    rostest.rosrun("myur5_description", "myur5", MyUr5)
