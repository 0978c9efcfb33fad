#!/usr/bin/env python3
"""Sensors of type gpu_ray that measure by pictures: they see visuals, as in Gazebo, where geometry on paper has them. The room of
plugins.world has collisions alone, which they do not see."""

import math
import struct

import numpy as np
import rospy
import rostest
from models import plugin, ray, sdf
from plugin_world import PluginWorld
from sensor_msgs.msg import LaserScan, PointCloud, PointCloud2

FRONT = 1.5  # m of the wall's front from the sensor
SIDE = 0.5  # m, half the wall's width
BOX = "<geometry><box><size>0.2 1 2</size></box></geometry>"  # its width is twice SIDE
WALL = f'<link name="l"><visual name="v"><laser_retro>5</laser_retro>{BOX}</visual></link>'
FELT = f'<link name="l"><collision name="c">{BOX}</collision></link>'
RAYS = {"samples": 201, "low": -0.5, "high": 0.5, "near": 0.1, "far": 10.0}
ANGLES = np.linspace(-0.5, 0.5, 201)
EDGE = math.atan2(SIDE, FRONT)


class GpuRay(PluginWorld):
    def put(self, name, text, *place):
        self.spawn(name, text, *place)
        self.addCleanup(self._delete_model, name)

    def scanner(self, library, kind, vertical="", sensor="gpu_ray", **tags):
        rays = ray("rays", plugin(library, topicName="scan", frameName="scanner", **tags), vertical=vertical, kind=sensor, **RAYS)
        self.put("scanner", sdf(f'<link name="l">{rays}</link>', static=True), 0.0, 0.0)
        return self.measure("/scan", kind, seconds=1.0, count=10)

    def test_visuals_are_seen_and_collisions_are_not(self):
        self.put("wall", sdf(WALL, static=True), FRONT + 0.1, 0.0, 0.5)
        self.put("felt", sdf(FELT, static=True), 1.0, 0.0, 0.5)
        scan = self.scanner("gazebo_ros_gpu_laser", LaserScan)
        ranges, retros = np.array(scan.ranges), np.array(scan.intensities)
        inside, outside = np.abs(ANGLES) < EDGE - 0.01, np.abs(ANGLES) > EDGE + 0.01
        np.testing.assert_allclose(ranges[inside], FRONT / np.cos(ANGLES[inside]), atol=1e-3)
        self.assertTrue(np.all(np.isposinf(ranges[outside])))  # not the room's walls
        self.assertEqual((set(retros[inside]), set(retros[outside])), ({5.0}, {0.0}))

    def test_a_sensor_of_type_ray_feels(self):
        self.put("wall", sdf(WALL, static=True), FRONT + 0.1, 0.0, 0.5)
        scan = self.scanner("gazebo_ros_laser", LaserScan, sensor="ray")
        self.assertAlmostEqual(scan.ranges[100], 3.0, places=4)  # the room's wall behind the visual

    def test_what_moves_is_seen_where_it_is(self):
        self.put("wall", sdf(WALL, static=True), FRONT + 0.1, 0.0, 0.5)
        self.assertAlmostEqual(self.scanner("gazebo_ros_gpu_laser", LaserScan).ranges[100], FRONT, delta=1e-3)
        self._delete_model("wall")
        self.spawn("wall", sdf(WALL, static=True), FRONT + 1.1, 0.0, 0.5)
        self.assertAlmostEqual(self.measure("/scan", LaserScan, seconds=0.2, count=2).ranges[100], FRONT + 1.0, delta=1e-3)

    def test_rows_of_a_block_of_rays(self):
        self.put("wall", sdf(WALL, static=True), FRONT + 0.1, 0.0, 0.5)
        rows = "<vertical><samples>3</samples><min_angle>-0.2</min_angle><max_angle>0.2</max_angle></vertical>"
        cloud = self.scanner("gazebo_ros_block_laser", PointCloud, vertical=rows)
        points = np.array([(p.x, p.y, p.z) for p in cloud.points]).reshape(3, 201, 3)
        inside = np.abs(ANGLES) < EDGE - 0.02
        np.testing.assert_allclose(points[:, inside, 0], FRONT, atol=2e-3)
        np.testing.assert_allclose(points[0, inside, 2], -math.tan(0.2) * FRONT / np.cos(ANGLES[inside]), atol=2e-3)

    def test_velodyne(self):
        self.put("wall", sdf(WALL, static=True), FRONT + 0.1, 0.0, 0.5)
        cloud = self.scanner("gazebo_ros_velodyne_gpu_laser", PointCloud2)
        xs = [struct.unpack_from("<f", cloud.data, i * cloud.point_step)[0] for i in range(cloud.width)]
        self.assertAlmostEqual(len(xs), np.count_nonzero(np.abs(ANGLES) < EDGE), delta=2)
        np.testing.assert_allclose(xs, FRONT, atol=2e-3)

    def test_rays_that_no_picture_shows_are_cast(self):
        up = "<vertical><samples>2</samples><min_angle>-1.5</min_angle><max_angle>1.5</max_angle></vertical>"
        cloud = self.scanner("gazebo_ros_block_laser", PointCloud, vertical=up)
        lowest = cloud.points[100]  # almost straight down, onto the floor's collision
        self.assertAlmostEqual(math.hypot(lowest.x, lowest.z), 0.5 / math.sin(1.5), delta=1e-3)


if __name__ == "__main__":
    rospy.init_node("gpu_ray_test", disable_rostime=True)
    rostest.rosrun("gazebo_plugins", "gpu_ray", "__main__")
