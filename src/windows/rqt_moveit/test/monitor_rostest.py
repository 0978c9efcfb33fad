#!/usr/bin/env python3
"""A move_group, its parameters and a camera come and go while the window is open."""

import subprocess
import unittest

from rqt_testing.in_process import errors, find, open_plugin, wait_until  # isort: skip
import rospy
import rostest
from sensor_msgs.msg import CameraInfo, Image


def words(gui, table):
    view = find(gui, table)
    return {view.item(row, 0).text(): view.item(row, 1).text() for row in range(view.rowCount())}


def topics(gui):
    tree = find(gui, "topics_tree_widget")
    return {tree.topLevelItem(row).text(0) for row in range(tree.topLevelItemCount())}


class MonitorTest(unittest.TestCase):
    def test_all_come_and_go(self):
        with open_plugin("rqt_moveit") as gui:
            find(gui, "_spinbox_refreshrate").setValue(1)
            self.parameters_come(gui)
            self.node_comes_and_goes(gui)
            self.camera_comes_and_goes(gui)
        self.assertEqual(errors, [])

    def parameters_come(self, gui):
        wait_until(lambda: words(gui, "_view_params") == {"/robot_description": "Yes", "/robot_description_semantic": "No"})
        rospy.set_param("/robot_description_semantic", rospy.get_param("/srdf_for_later"))
        wait_until(lambda: words(gui, "_view_params")["/robot_description_semantic"] == "Yes")

    def node_comes_and_goes(self, gui):
        wait_until(lambda: words(gui, "_view_nodes") == {"/move_group": "Not running"})
        self.assertIn("demo.launch", find(gui, "status_label").text())
        node = subprocess.Popen(["rosrun", "moveit_ros_move_group", "move_group"])
        try:
            wait_until(lambda: words(gui, "_view_nodes") == {"/move_group": "Running"}, 60)
            self.assertEqual(find(gui, "status_label").text(), "")
        finally:
            node.terminate()
            node.wait(30)
        wait_until(lambda: words(gui, "_view_nodes") == {"/move_group": "Not running"})
        rospy.delete_param("/robot_description_semantic")
        wait_until(lambda: words(gui, "_view_params")["/robot_description_semantic"] == "No")

    def camera_comes_and_goes(self, gui):
        self.assertEqual(topics(gui), set())
        image = rospy.Publisher("/camera/depth/image_raw", Image, queue_size=1)
        info = rospy.Publisher("/camera_info", CameraInfo, queue_size=1)
        wait_until(lambda: topics(gui) == {"/camera/depth/image_raw", "/camera_info"})
        image.unregister()
        wait_until(lambda: topics(gui) == {"/camera_info"})
        info.unregister()
        wait_until(lambda: topics(gui) == set())


if __name__ == "__main__":
    rospy.init_node("monitor_rostest")
    rostest.rosrun("rqt_moveit", "monitor", MonitorTest)
