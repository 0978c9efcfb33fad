#!/usr/bin/env python3
"""A word of launch files where the name of a controller manager is expected."""

import sys
import unittest
from pathlib import Path

import rospy
import rostest
from actionlib_msgs.msg import GoalStatus
from moveit_msgs.msg import MoveItErrorCodes

sys.path.insert(0, str(Path(__file__).parent))
from simple_rostest import SimpleManager, execute, trajectory  # noqa: E402


class WordForAManager(unittest.TestCase):
    setUp, tearDown, start = SimpleManager.setUp, SimpleManager.tearDown, SimpleManager.start

    def test_what_controller_list_names_executes(self):
        rospy.wait_for_service("get_planning_scene", timeout=30.0)
        self.start()
        status, result, text = execute(trajectory(1.0)).result()
        self.assertEqual((status, result.error_code.val), (GoalStatus.SUCCEEDED, MoveItErrorCodes.SUCCESS), text)


if __name__ == "__main__":
    rospy.init_node("word_rostest")
    rostest.rosrun("moveit_simple_controller_manager", "word_for_a_manager", WordForAManager)
