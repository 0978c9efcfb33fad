#!/usr/bin/env python3
"""The example robot's two lidars stand on a plane, a wall before them: the clouds are checked against geometry."""

import unittest

import numpy as np
import rospy
import rostest
from gazebo_msgs.srv import DeleteModel, SpawnModel
from geometry_msgs.msg import Point, Pose, Quaternion
from sensor_msgs.msg import PointCloud2

POINT = np.dtype([("x", "<f4"), ("y", "<f4"), ("z", "<f4"), ("intensity", "<f4"), ("ring", "<u2"), ("time", "<f4")])
WALL = """<sdf version="1.6"><model name="wall"><static>true</static><link name="link"><collision name="c"><geometry><box>
<size>0.2 40 4</size></box></geometry></collision></link></model></sdf>"""
VLP_HEIGHT = 0.4 + 0.0377  # m, of its lasers in the example: the mount, and the lasers in the housing


def points(cloud):
    return np.frombuffer(cloud.data, POINT).reshape(cloud.height, cloud.width)


class Velodyne(unittest.TestCase):
    def test_points_lie_on_ground_and_wall(self):
        spawn = rospy.ServiceProxy("/gazebo/spawn_sdf_model", SpawnModel)
        spawn.wait_for_service(60)
        wall = Pose(Point(5.1, 0, 2), Quaternion(0, 0, 0, 1))  # its face is 5 m before the lidar
        self.assertTrue(spawn("wall", WALL, "", wall, "world").success)
        cloud = rospy.wait_for_message("/velodyne_points", PointCloud2, 60)
        self.assertEqual((cloud.header.frame_id, cloud.height, cloud.point_step, cloud.is_dense), ("velodyne", 1, 22, True))
        self.assertEqual([field.name for field in cloud.fields], ["x", "y", "z", "intensity", "ring", "time"])
        seen = points(cloud)[0]
        ground = np.abs(seen["z"] + VLP_HEIGHT) < 0.05
        before = np.abs(seen["x"] - 5) < 0.05
        self.assertEqual(seen[~(ground | before)][:5].tolist(), [])
        self.assertGreater(before.sum(), 1000)
        self.assertEqual(set(seen["ring"][before & ~ground & (seen["z"] > 0)]), set(range(8, 16)))
        pitch = np.degrees(np.arctan2(seen["z"], np.hypot(seen["x"], seen["y"])))
        np.testing.assert_allclose(pitch, seen["ring"] * 2.0 - 15.0, atol=1e-3)
        ranges = np.sqrt(seen["x"] ** 2 + seen["y"] ** 2 + seen["z"] ** 2)
        self.assertGreater(ranges.min(), 0.9)
        noise = seen["x"][before & ~ground] - 5
        self.assertTrue(0.004 < noise.std() < 0.009, noise.std())  # 8 mm along the ray
        columns = np.unwrap(np.arctan2(seen["y"], seen["x"]))
        self.assertTrue((np.diff(columns) > -1e-3).all(), "the points come as the device turns")

    def test_organized(self):
        spawn = rospy.ServiceProxy("/gazebo/spawn_urdf_model", SpawnModel)
        spawn.wait_for_service(60)
        rospy.ServiceProxy("/gazebo/delete_model", DeleteModel)("wall")
        pose = Pose(Point(0, 8, 0), Quaternion(0, 0, 0, 1))
        self.assertTrue(spawn("organized", rospy.get_param("/organized/robot_description"), "organized", pose, "world").success)
        cloud = rospy.wait_for_message("/organized/velodyne_points2", PointCloud2, 60)
        seen = points(cloud)
        self.assertEqual((cloud.height, cloud.width, cloud.is_dense), (32, 440, False))
        self.assertTrue((seen["ring"] == np.arange(32)[:, None]).all())
        level = np.isnan(seen["x"]).all(axis=1)
        self.assertTrue(level[-8:].all(), "the lasers that look up see nothing")
        self.assertFalse(np.isnan(seen["x"][0]).any(), "the lowest laser sees the ground all around")


if __name__ == "__main__":
    rospy.init_node("velodyne_rostest")
    rostest.rosrun("velodyne_description", "velodyne_rostest", Velodyne)
