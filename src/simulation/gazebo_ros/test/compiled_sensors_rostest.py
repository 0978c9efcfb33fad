#!/usr/bin/env python3
"""Plugins of sensors in C++: what Gazebo's own classes tell them."""

import importlib.util
import math
import os
import re
import sys
import unittest

import rospy
import rostest
from std_msgs.msg import Float64MultiArray
from test_support.hearing import heard

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from simulator import HearingCase, pose  # noqa: E402

MODEL = """<sdf version="1.6"><model name="post"><pose>0 0 0.5 0 0 {yaw}</pose><link name="l"><inertial><mass>2</mass></inertial>
<collision name="c"><geometry><box><size>1 1 1</size></box></geometry></collision>{sensors}</link></model></sdf>"""
TABLE = """<sdf version="1.6"><model name="post"><static>1</static><pose>0 0 0.5 0 0 0</pose><link name="l">
<collision name="top"><geometry><box><size>4 4 1</size></box></geometry></collision>{sensors}</link></model></sdf>"""
WALL = """<sdf version="1.6"><model name="wall"><static>1</static><pose>3.5 0 1 0 0 0</pose><link name="l"><collision name="c">
<laser_retro>70</laser_retro><geometry><box><size>1 10 4</size></box></geometry></collision></link></model></sdf>"""
WEIGHT = """<sdf version="1.6"><model name="post">
<link name="base"><pose>0 0 1 0.2 0 0</pose><inertial><mass>5</mass></inertial></link>
<joint name="hold" type="fixed"><parent>world</parent><child>base</child></joint>
<link name="w"><pose>0.3 0.2 1.2 0.4 0 0.3</pose><inertial><pose>0.1 0 0.05 0 0 0</pose><mass>2</mass></inertial></link>
<joint name="j" type="fixed"><parent>base</parent><child>w</child><pose>0.02 0 0 0 0 0.7</pose>{sensors}</joint></model></sdf>"""
RAY = """<sensor name="eye" type="{type}"><update_rate>50</update_rate><pose>0.5 0 0.4 0 0 0</pose><ray><scan>
<horizontal><samples>3</samples><min_angle>-0.5</min_angle><max_angle>0.5</max_angle></horizontal>
<vertical><samples>2</samples><min_angle>0</min_angle><max_angle>1.2</max_angle></vertical></scan>
<range><min>0.1</min><max>5</max></range></ray><plugin name="p" filename="libgazebo_ros_test_{plugin}.so"/></sensor>"""
SENSOR = """<sensor name="{type}" type="{type}"><update_rate>{rate}</update_rate>{block}<plugin name="first" filename="libother.so"/>
<plugin name="p" filename="libgazebo_ros_test_feeler.so"><mark>7</mark></plugin></sensor>"""

# A robot without a name; the sensor has no <ray>, as those of Livox's plugin.
LIDAR = """<robot><link name="l"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
<gazebo reference="l"><turnGravityOff>true</turnGravityOff><sensor name="eye" type="ray"><update_rate>50</update_rate>
<plugin name="p" filename="libgazebo_ros_test_comber.so"><pattern>package://gazebo_ros/test/comb.txt</pattern>
<ray><range><min>0.1</min><max>5</max></range></ray></plugin></sensor></gazebo></robot>"""


@unittest.skipUnless(importlib.util.find_spec("gazebo_cpp._core"), "this system lacks what Gazebo's headers need")
class SensorsTest(HearingCase):
    def setUp(self):
        super().setUp()
        self.got = {}

    def values(self, topic, sensors, steps, count, yaw=0.0, model=MODEL):
        """The values of a topic, with the one that is latched at the start, after so many steps."""
        got = []
        self.listen(topic, Float64MultiArray, lambda m: got.append(m.data))
        self.done(self.sim.spawn("post", model.format(sensors=sensors, yaw=yaw)))
        self.wait(lambda: heard(self.subscribers[1:]))
        self.sim.step(steps)
        self.wait(lambda: len(got) >= count)
        return got

    def test_rays(self):
        self.done(self.sim.spawn("wall", WALL))
        fans = []
        self.listen("/scan/fan", Float64MultiArray, lambda m: fans.append(m.data))
        got = self.values("/scan/values", RAY.format(type="ray", plugin="scanner"), 100, 5)
        self.wait(lambda: len(fans) >= 5)
        self.assertEqual([round(m[0], 6) for m in got], [0.02, 0.04, 0.06, 0.08, 0.1])
        near, side = 2.5, 2.5 / math.cos(0.5)  # of the face of the wall; the upper row looks over it
        expected = [side, near, side, 5.0, 5.0, 5.0]
        for each, wanted in zip(fans[0], expected):
            self.assertAlmostEqual(each, wanted, delta=1e-3)
        self.assertEqual(got[0][1:6], (-0.5, 0.5, 3.0, 2.0, 5.0))
        for each, wanted in zip(got[0][6:12], expected[:3] + [math.inf] * 3):
            self.assertTrue(each == wanted or abs(each - wanted) < 1e-3, got[0])
        self.assertEqual(got[0][12:], (70.0, 70.0, 70.0, 0.0, 0.0, 0.0))

    def test_between_rays_and_a_single_one(self):
        """As gazebo_plugins' rays_rostest.py has it of the sensors of Python."""
        self.done(self.sim.spawn("wall", WALL))
        across = "<samples>3</samples><min_angle>-0.5</min_angle><max_angle>0.5</max_angle>"
        sensor = RAY.format(type="ray", plugin="scanner").replace(across, across + "<resolution>2</resolution>")
        sensor = re.sub("<vertical>.*</vertical>", "<vertical><samples>1</samples><min_angle>1</min_angle></vertical>", sensor)
        got = self.values("/scan/values", sensor.replace("<max>5</max>", "<max>2.7</max>"), 100, 5)[-1]
        self.assertEqual(got[3:5], (6.0, 1.0))
        # The wall is 2.5 m ahead; to both sides it is 2.85 m away, which counts as 2.7 without intensity.
        expected = [math.inf, 2.62, 2.54, 2.54, 2.62, math.inf]  # 0.4 and 0.8 of the way from a side to the middle
        for each, wanted in zip(got[6:12], expected):
            self.assertTrue(each == wanted or abs(each - wanted) < 1e-3, got)
        self.assertEqual(got[12:], (35.0, 35.0, 35.0, 35.0, 35.0, 0.0))

    def test_rays_of_ode_that_a_plugin_looks_for_itself(self):
        """Gazebo's law: an added ray reaches from its start to max - min, and its range is min more than where it meets something."""
        self.done(self.sim.spawn("wall", WALL))
        got = []
        self.listen("/comb", Float64MultiArray, lambda m: got.append(m.data))
        self.done(self.sim.spawn("lidar", LIDAR, pose(z=1.0, qz=math.sin(0.15), qw=math.cos(0.15)), kind="urdf"))
        self.wait(lambda: heard(self.subscribers[1:]))
        self.sim.step(40)
        self.wait(lambda: len(got) >= 2)
        # told the angles -0.3, 0, 2.84 and 1 from a heading of 0.3: the wall's face is 3 m ahead, nothing is behind, and 1.3 goes past it
        expected = (0.1 + 3.0, 70, 0.1 + 3.0 / math.cos(0.3), 70, 5.0, 0, 5.0, 0)
        self.near(got[-1], (0.04, *expected, *expected), 1e-4)
        self.done(self.sim.set_model("wall", pose(x=4.5, z=1.0)))
        self.sim.step(20)
        self.wait(lambda: len(got) >= 3)
        self.near(got[-1][1:4], (0.1 + 4.0, 70, 0.1 + 4.0 / math.cos(0.3)), 1e-4)

    def feel(self, kind, rate=100, block="", **more):
        got = self.values("/feel/" + kind, SENSOR.format(type=kind, rate=rate, block=block), 50, 1 + rate // 20, **more)
        self.assertEqual(got[0], (7.0, 1.0))  # its own <plugin> of two; found by its scoped name, which its link knows
        return got[-1]

    def near(self, values, wanted, delta):
        self.assertEqual(len(values), len(wanted))
        for value, each in zip(values, wanted):
            self.assertAlmostEqual(value, each, delta=delta, msg=str(values))

    def test_imu(self):
        self.near(self.feel("imu", yaw=0.3), (0.05, 0, 0, 0, 0, 0, 9.8, 0, 0, 0), 0.01)

    def test_contact(self):
        """The smaller of the two is the first, as in Gazebo: the box, not the ground; what it bears points up."""
        _, points, own, force, other = self.feel("contact", block="<contact><collision>c</collision></contact>")
        self.assertGreaterEqual(points, 3)
        self.assertEqual(own, 1.0)
        self.assertAlmostEqual(force, 2 * 9.8, delta=0.2)
        self.assertAlmostEqual(other, -2 * 9.8, delta=0.2)

    def test_contact_of_a_large_model_with_a_small_one(self):
        """The sensor's own collision need not be the first."""
        self.done(
            self.sim.spawn(
                "pebble",
                """<sdf version="1.6"><model name="any"><pose>0 0 1.1 0 0 0</pose><link name="l"><inertial>
            <mass>3</mass></inertial><collision name="c"><geometry><box><size>0.2 0.2 0.2</size></box></geometry></collision></link></model>
            </sdf>""",
            )
        )
        got = self.values(
            "/feel/contact",
            SENSOR.format(type="contact", rate=100, block="<contact><collision>top</collision></contact>"),
            50,
            6,
            model=TABLE,
        )
        _, points, own, force, other = got[-1]
        self.assertGreaterEqual(points, 3)
        self.assertEqual(own, 0.0)
        self.assertAlmostEqual(force, 3 * 9.8, delta=0.5)
        self.assertAlmostEqual(other, -3 * 9.8, delta=0.5)

    def test_gps(self):
        self.near(self.feel("gps"), (0.05, 0.0, 0.0, 0.5), 1e-3)

    def test_altimeter(self):
        self.near(self.feel("altimeter"), (0.05, 0.0, 0.0), 1e-3)

    def test_magnetometer(self):
        self.near(self.feel("magnetometer", yaw=math.pi / 2), (0.05, 22.8758, -5.5645, -42.3884), 1e-3)

    def sonar(self, pitch):
        return self.feel("sonar", block=f"<pose>0 0 0.4 0 {pitch} 0</pose><sonar><min>0.1</min><max>5</max><radius>1</radius></sonar>")

    def test_sonar(self):
        """Its cone is turned ahead; the lower edge falls by one in five, from 0.9 m above the ground."""
        self.near(self.sonar(-math.pi / 2), (0.05, 0.9 * math.sqrt(26)), 1e-3)

    def test_sonar_and_a_wall(self):
        self.done(self.sim.spawn("wall", WALL))
        self.near(self.sonar(-math.pi / 2), (0.05, 3.0), 1e-3)

    def test_sonar_that_meets_nothing(self):
        self.near(self.sonar(math.pi), (0.05, 5.0), 1e-9)

    def logical_camera(self, yaw):
        """What it tells of a wall, 3.5 m from the origin."""
        self.done(self.sim.spawn("wall", WALL))
        block = (
            "<logical_camera><near>0.6</near><far>5</far><horizontal_fov>1</horizontal_fov><aspect_ratio>1.3</aspect_ratio>"
            "</logical_camera>"
        )
        return self.feel("logical_camera", block=block, yaw=yaw)

    def test_logical_camera(self):
        """It names what is before it, but neither itself nor the ground."""
        self.near(self.logical_camera(0.0), (0.05, len("wall"), 3.5, 0, 0.5), 1e-3)

    def test_logical_camera_that_looks_away(self):
        self.near(self.logical_camera(math.pi), (0.05,), 1e-3)

    def scale(self, frame, direction):
        """2 kg aside on a joint whose frames are all turned."""
        block = f"""<pose>0 0 0 0 0.5 0</pose><force_torque><frame>{frame}</frame><measure_direction>{direction}</measure_direction>
            </force_torque>"""
        return self.feel("force_torque", block=block, model=WEIGHT)

    def test_force_torque_in_the_axes_of_the_child(self):
        """These three are what Gazebo 11.1 measured."""
        self.near(self.scale("child", "child_to_parent"), (0.05, 0, -7.6326, -18.0528, 0.3816, 1.4442, -0.6106, 1), 2e-3)

    def test_force_torque_in_the_axes_of_the_parent(self):
        self.near(self.scale("parent", "parent_to_child"), (0.05, 0, 3.8939, 19.2093, 0.0988, -1.5786, 0.3200, 1), 2e-3)

    def test_force_torque_in_the_axes_of_the_sensor(self):
        self.near(self.scale("sensor", "child_to_parent"), (0.05, 4.3398, -5.8377, -18.2002, 1.3654, 0.8588, 0.0501, 1), 2e-3)

    def test_a_sensor_that_is_not_there_in_cpp_is_one_line(self):
        self.done(self.sim.spawn("post", MODEL.format(yaw=0, sensors=SENSOR.format(type="rfid", rate=5, block=""))))
        self.wait(lambda: any("plugin p" in line and "a sensor of this type is not there in C++" in line for line in self.log))
        self.assertIn("post", self.sim.world().model_names)

    def test_a_plugin_of_rays_in_another_sensor_is_one_line(self):
        block = "<imu/><plugin name='ray' filename='libRayPlugin.so'/>"
        self.done(self.sim.spawn("post", MODEL.format(yaw=0, sensors=SENSOR.format(type="imu", rate=5, block=block))))
        self.wait(lambda: any("plugin ray" in line and "belongs into a sensor of type ray" in line for line in self.log))


if __name__ == "__main__":
    rospy.init_node("compiled_sensors_rostest")
    rostest.rosrun("gazebo_ros", "compiled_sensors", SensorsTest)
