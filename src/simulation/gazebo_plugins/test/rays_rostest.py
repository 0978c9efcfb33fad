#!/usr/bin/env python3
"""Lasers and range sensors in a room, and before people, against geometry. Time passes only through the step service.

With ~after_reset all of it is tested on plugins that have run for a while and were then reset with the simulation."""

import math

import numpy as np
import rospy
import rostest
from models import link, plugin, ray, sdf
from plugin_world import PluginWorld, xyz
from sensor_msgs.msg import LaserScan, PointCloud, Range

LASER = (0.5, 0.3)  # where the scanners stand in the room
ROOM = (3.0, 2.0)  # half sides
#: Walks 2 m in 4 s at y = -1; its <pose> is that of the service, which the script overrides.
PERSON = """<sdf version="1.6"><actor name="person"><skin><filename>walk.dae</filename></skin>
<animation name="walking"><filename>walk.dae</filename><interpolate_x>true</interpolate_x></animation>
<script><loop>false</loop><trajectory id="0" type="walking"><waypoint><time>0</time><pose>-1 -1 0 0 0 0</pose></waypoint>
<waypoint><time>4</time><pose>1 -1 0 0 0 0</pose></waypoint></trajectory></script></actor></sdf>"""
COVERS = "<vertical><samples>3</samples><min_angle>-0.2</min_angle><max_angle>0.2</max_angle></vertical>"


def to_wall(angles):
    """Analytic distances from LASER to the walls."""
    with np.errstate(divide="ignore"):
        x = np.where(np.cos(angles) > 0, ROOM[0] - LASER[0], ROOM[0] + LASER[0]) / np.abs(np.cos(angles))
        y = np.where(np.sin(angles) > 0, ROOM[1] - LASER[1], ROOM[1] + LASER[1]) / np.abs(np.sin(angles))
    return np.minimum(x, y)


class Rays(PluginWorld):
    def scanner(self, library, message_type, **sensor):
        """The last message of one scanner in the room."""
        rays = {
            key: sensor.pop(key)
            for key in ("samples", "low", "high", "near", "far", "noise", "resolution", "vertical", "kind")
            if key in sensor
        }
        tags = {"topicName": "scan", "frameName": "scanner", **sensor}
        self.spawn("scanner", sdf(link("l", extra=ray("rays", plugin(library, **tags), **rays)), static=True), *LASER)
        self.addCleanup(self._delete_model, "scanner")
        return self.measure("/scan", message_type, seconds=1.0, count=10)

    def test_laser(self):
        scan = self.scanner("gazebo_ros_laser", LaserScan)
        self.assertEqual((scan.header.frame_id, scan.scan_time, scan.time_increment), ("scanner", 0.0, 0.0))
        angles = scan.angle_min + scan.angle_increment * np.arange(360)
        self.assertAlmostEqual(angles[-1], scan.angle_max, places=5)
        expected, ranges = to_wall(angles), np.array(scan.ranges)
        inside = expected < 3.2
        self.assertTrue(0 < np.count_nonzero(~inside) < 360)
        self.assertTrue(np.all(np.isposinf(ranges[~inside])))  # REP 117
        np.testing.assert_allclose(ranges[inside], expected[inside], atol=1e-4)
        east = inside & (np.abs(np.tan(angles)) * 2.5 < 1.6) & (np.cos(angles) > 0)
        self.assertEqual((set(np.array(scan.intensities)[east]), scan.intensities[0]), ({7.0}, 0.0))

    def test_gpu_laser(self):
        scan = self.scanner("gazebo_ros_gpu_laser", LaserScan, kind="gpu_ray", samples=90)
        np.testing.assert_allclose(np.minimum(scan.ranges, 3.2), np.minimum(to_wall(np.linspace(-math.pi, 3.12413936, 90)), 3.2), atol=1e-4)

    def test_a_person_walks_by_and_both_kinds_of_laser_see_it(self):
        def look(kind):
            ranges = np.array(self.scanner("gazebo_ros_laser", LaserScan, kind=kind, far=10).ranges)
            self._delete_model("scanner")
            return ranges

        empty = {kind: look(kind) for kind in ("ray", "gpu_ray")}
        self.spawn("person", PERSON, 9.0, 9.0)
        self.addCleanup(self._delete_model, "person")
        self.step(0.01)
        started = self.pose("person").position.x
        for kind, walls in empty.items():
            seen = look(kind)
            at = self.pose("person").position
            nearer = seen < walls - 0.1
            self.assertTrue(3 < np.count_nonzero(nearer) < 90, np.count_nonzero(nearer))
            distance = math.hypot(at.x - LASER[0], at.y - LASER[1])
            self.assertAlmostEqual(seen[nearer].min(), distance, delta=0.5)
        self.step(1.0)
        at = self.pose("person").position
        self.assertGreater(at.x, started + 0.5)
        self.assertAlmostEqual(at.y, -1.0, delta=0.05)
        self.assertAlmostEqual(at.z, 1.0, delta=0.05)  # the hips
        self._reset()
        self.step(0.01)
        self.assertAlmostEqual(self.pose("person").position.x, -1.0, delta=0.02)

    def test_a_person_wanders_between_obstacles(self):
        wanders = PERSON.replace("</actor>", "<plugin name='w' filename='libActorPlugin.so'><target>0 -1 1.2138</target></plugin></actor>")
        self.spawn("person", wanders, -1.0, 1.0, 1.2138)
        self.addCleanup(self._delete_model, "person")
        places = []
        for _ in range(8):
            self.step(1.0)
            places.append(self.pose("person").position)
        self.assertTrue(all(-3.0 <= p.x <= 3.5 and -10.0 <= p.y <= 2.0 and abs(p.z - 1.2138) < 1e-6 for p in places))
        self.assertGreater(max(math.hypot(p.x - places[0].x, p.y - places[0].y) for p in places), 0.3)

    def test_noise_of_a_laser(self):
        scan = self.scanner("gazebo_ros_laser", LaserScan, noise=0.02, far=10)
        noise = np.array(scan.ranges) - to_wall(scan.angle_min + scan.angle_increment * np.arange(360))
        self.assertAlmostEqual(noise.std(), 0.02, delta=0.003)
        self.assertAlmostEqual(noise.mean(), 0.0, delta=0.004)

    def test_laser_between_its_rays(self):
        fine = self.scanner("gazebo_ros_laser", LaserScan, samples=181, resolution=2, low=-0.5, high=0.5, far=10)
        self.assertEqual(len(fine.ranges), 362)
        np.testing.assert_allclose(fine.ranges, to_wall(np.linspace(-0.5, 0.5, 362)), atol=2e-3)

    def test_between_a_ray_that_meets_a_wall_and_one_that_meets_none(self):
        """Linear up to max, and intensities the mean of the rays around it, as Gazebo's sensor has it."""
        scan = self.scanner("gazebo_ros_laser", LaserScan, samples=5, resolution=2, low=-0.6, high=0.6, near=0.1, far=2.6)
        rays = np.minimum(to_wall(np.linspace(-0.6, 0.6, 5)), 2.6)  # the middle three of them meet the east wall
        bright = np.where(rays < 2.6, 7.0, 0.0)
        at = np.linspace(0, 4, 10)
        low = np.floor(at).astype(int)
        high = np.minimum(low + 1, 4)
        expected = rays[low] + (at - low) * (rays[high] - rays[low])
        np.testing.assert_allclose(scan.ranges, np.where(expected >= 2.6, np.inf, expected), atol=1e-4)
        np.testing.assert_allclose(scan.intensities, (bright[low] + bright[high]) / 2, atol=1e-6)
        self.assertTrue(0 < np.count_nonzero(np.isfinite(scan.ranges)) < 10)

    def test_a_single_ray_looks_ahead(self):
        """Whatever its angles are, as Gazebo's: many a distance sensor is described so."""
        scan = self.scanner("gazebo_ros_laser", LaserScan, samples=1, low=-0.5, high=0.5, far=10)
        np.testing.assert_allclose(scan.ranges, to_wall(np.zeros(1)), atol=1e-4)

    def test_a_range_of_a_single_ray_looks_ahead(self):
        near = self.scanner("gazebo_ros_range", Range, samples=1, low=-0.5, high=0.5, far=10)
        self.assertAlmostEqual(near.range, to_wall(0.0), delta=1e-4)

    def test_laser_of_several_rows(self):
        scan = self.scanner("gazebo_ros_laser", LaserScan, samples=5, low=-0.4, high=0.4, vertical=COVERS, far=10)
        lowest, *others = np.array(scan.ranges).reshape(3, 5)
        level = to_wall(np.linspace(-0.4, 0.4, 5))
        np.testing.assert_allclose(others, [level, level / math.cos(0.2)], atol=1e-4)
        np.testing.assert_allclose(lowest, np.minimum(level / math.cos(0.2), 0.5 / math.sin(0.2)), atol=1e-4)

    def test_block_laser(self):
        cloud = self.scanner("gazebo_ros_block_laser", PointCloud, samples=91, low=-1, high=1, far=10)
        points = np.array([xyz(p) for p in cloud.points])
        np.testing.assert_allclose(np.hypot(*points[:, :2].T), to_wall(np.linspace(-1, 1, 91)), atol=1e-4)
        self.assertEqual(len(cloud.channels[0].values), 91)
        self.assertEqual(cloud.channels[0].values[45], 7.0)  # as bright as the east wall, whatever hokuyoMinIntensity says

    def test_block_laser_that_does_not_reach_the_walls(self):
        cloud = self.scanner("gazebo_ros_block_laser", PointCloud, samples=91, low=-1, high=1, near=2.45, far=2.6, gaussianNoise=0.01)
        short, there = np.linalg.norm([xyz(p) for p in cloud.points], axis=1), to_wall(np.linspace(-1, 1, 91))
        missed = there > 2.6
        self.assertTrue(20 < np.count_nonzero(missed) < 80)
        np.testing.assert_allclose(short[missed], 2.6, atol=1e-5)  # at max, without noise
        self.assertGreater(np.abs(short - there)[~missed & (there > 2.45)].max(), 1e-3)

    def test_range(self):
        near = self.scanner("gazebo_ros_range", Range, samples=5, low=-0.1, high=0.1, far=5, fov=0.3, radiation="infrared")
        self.assertAlmostEqual(near.range, 2.5, places=4)
        self.assertEqual((near.radiation_type, round(near.field_of_view, 6), near.max_range), (Range.INFRARED, 0.3, 5.0))

    def test_range_of_what_is_too_far(self):
        self.assertEqual(self.scanner("gazebo_ros_range", Range, samples=5, low=-0.1, high=0.1, far=1).range, 1.0)

    def test_sonar(self):
        heard = self.scanner("hector_gazebo_ros_sonar", Range, samples=5, low=-0.1, high=0.1, far=5, vertical=COVERS, frameId="s")
        self.assertEqual(heard.header.frame_id, "s")
        self.assertAlmostEqual(heard.range, 2.5, places=4)

    def test_rays_too_close_and_too_far(self):
        """REP 117: -inf nearer than the near limit, +inf farther than the far limit; the robot's own housing is neither."""
        near, far, face = 0.2, 2.0, 0.15  # m: limits, and where a thick wall begins, ahead
        housing = '<collision name="housing"><geometry><cylinder><radius>0.1</radius><length>0.2</length></cylinder></geometry></collision>'
        self.spawn(
            "wall",
            sdf(link("l", extra='<collision name="c"><geometry><box><size>1 6 1</size></box></geometry></collision>'), static=True),
            20 + face + 0.5,
            0,
            1,
        )
        for topic, noise in (("close", 0.0), ("close_noisy", 0.02)):
            scanner = ray(
                topic,
                plugin("gazebo_ros_laser", topicName=topic, frameName="s"),
                samples=181,
                low=-1.5,
                high=1.5,
                near=near,
                far=far,
                noise=noise,
                at="0 0 0 0 0 0",
            )
            self.spawn(topic, sdf(link("l", extra=housing + scanner), static=True), 20, 0, 1)
            angles = np.linspace(-1.5, 1.5, 181)
            distance = face / np.cos(angles)
            ranges = np.array(self.measure("/" + topic, LaserScan).ranges)
            self.assertTrue(np.all(np.isneginf(ranges[distance < near])), topic)
            self.assertTrue(np.all(np.isposinf(ranges[distance > far])), topic)
            between = (distance > near + 6 * noise) & (distance < far - 6 * noise)
            np.testing.assert_allclose(ranges[between], distance[between], atol=1e-4 + 6 * noise)
            self.assertTrue(np.count_nonzero(distance < near) > 40 and np.count_nonzero(between) > 20)
            self._delete_model(topic)
        self._delete_model("wall")


if __name__ == "__main__":
    rospy.init_node("rays_test", disable_rostime=True)
    rostest.rosrun("gazebo_plugins", "rays", Rays)
