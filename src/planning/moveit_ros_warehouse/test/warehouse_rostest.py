#!/usr/bin/env python3
"""Robot states are saved, listed, renamed and deleted by name."""

import unittest

import rospy
import rostest
from moveit_msgs.msg import RobotState
from moveit_msgs.srv import (
    CheckIfRobotStateExistsInWarehouse,
    DeleteRobotStateFromWarehouse,
    GetRobotStateFromWarehouse,
    ListRobotStatesInWarehouse,
    RenameRobotStateInWarehouse,
    SaveRobotStateToWarehouse,
)


def call(name, kind, *arguments):
    rospy.wait_for_service(name, 30)
    return rospy.ServiceProxy(name, kind)(*arguments)


class Warehouse(unittest.TestCase):
    def names(self, pattern="", robot="arm"):
        return call("list_robot_states", ListRobotStatesInWarehouse, pattern, robot).states

    def test_states_by_name(self):
        state = RobotState()
        state.joint_state.name, state.joint_state.position = ["elbow"], [0.5]
        for name, robot in (("home", "arm"), ("homely", "arm"), ("away", "arm"), ("home", "other")):
            self.assertTrue(call("save_robot_state", SaveRobotStateToWarehouse, name, robot, state).success)
        self.assertFalse(call("save_robot_state", SaveRobotStateToWarehouse, "", "arm", state).success)
        self.assertEqual(self.names(), ["away", "home", "homely"])
        self.assertEqual(self.names("home.*"), ["home", "homely"])
        self.assertEqual(call("list_robot_state", ListRobotStatesInWarehouse, "home.*", "arm").states, ["home", "homely"])
        with self.assertRaisesRegex(rospy.ServiceException, "is no regular expression"):
            self.names("[")
        self.assertEqual(call("get_robot_state", GetRobotStateFromWarehouse, "home", "arm").state.joint_state.position, (0.5,))
        with self.assertRaisesRegex(rospy.ServiceException, "there is no state 'ghost' of robot 'arm'; there are: away, home, homely"):
            call("get_robot_state", GetRobotStateFromWarehouse, "ghost", "arm")
        call("rename_robot_state", RenameRobotStateInWarehouse, "away", "far away", "arm")
        self.assertEqual(self.names(), ["far away", "home", "homely"])
        call("delete_robot_state", DeleteRobotStateFromWarehouse, "home", "arm")
        self.assertFalse(call("has_robot_state", CheckIfRobotStateExistsInWarehouse, "home", "arm").exists)
        self.assertTrue(call("has_robot_state", CheckIfRobotStateExistsInWarehouse, "home", "other").exists)


if __name__ == "__main__":
    rospy.init_node("warehouse_rostest")
    rostest.rosrun("moveit_ros_warehouse", "warehouse", Warehouse)
