#!/usr/bin/env python3
"""What a plugin in C++ learns of shapes, height maps, joints, batteries and the air, and how it changes them. The figures and words are
those that the same questions had as answers in a real Gazebo 11.1."""

import importlib.util
import os
import sys
import tempfile
import unittest

import numpy as np
import rospy
import rostest
from PIL import Image
from std_msgs.msg import String
from test_support.hearing import heard

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from simulator import HearingCase  # noqa: E402

MODEL = """<sdf version="1.6"><model name="{name}"><static>{static}</static><pose>{pose}</pose><link name="l"><collision name="c"><geometry>
{shape}</geometry></collision></link><plugin name="s" filename="libgazebo_ros_test_surveyor.so">{more}</plugin></model></sdf>"""
ARM = """<sdf version="1.6"><model name="arm"><link name="a"><pose>20 0 1 0 0 0</pose></link><link name="b"><pose>20 1 1 0 0 0.3</pose>
<inertial><mass>2</mass><inertia><ixx>0.1</ixx><ixy>0</ixy><ixz>0</ixz><iyy>0.2</iyy><iyz>0</iyz><izz>0.3</izz></inertia></inertial>
<battery name="bat"><voltage>12.6</voltage></battery></link>
<joint name="j" type="revolute"><parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz><limit><lower>-1</lower><upper>1</upper></limit>
<dynamics><spring_stiffness>3</spring_stiffness><spring_reference>0.5</spring_reference></dynamics></axis></joint>
<plugin name="s" filename="libgazebo_ros_test_surveyor.so">{more}</plugin></model></sdf>"""
TOUCHED = """<sdf version="1.6"><model name="cube"><pose>0 0 0.3 0 0 0</pose><link name="l"><inertial><mass>1</mass></inertial>
<collision name="c"><geometry><box><size>0.2 0.2 0.2</size></box></geometry></collision>
<sensor name="feeler" type="contact"><contact><collision>c</collision></contact></sensor></link>
<plugin name="t" filename="libTouchPlugin.so"><sensor>feeler</sensor><target>{target}</target><namespace>touchy</namespace>
<time>0.5</time><enabled>true</enabled></plugin>
<plugin name="s" filename="libgazebo_ros_test_surveyor.so"><hear>/touchy/touched</hear></plugin></model></sdf>"""


@unittest.skipUnless(importlib.util.find_spec("gazebo_cpp._core"), "this system lacks what Gazebo's headers need")
class SurveyTest(HearingCase):
    def setUp(self):
        super().setUp()
        self.told = []
        self.listen("/surveyed", String, lambda message: self.told.append(message.data))
        self.assertTrue(self.sim.set_physics(gravity=(0.0, 0.0, -9.8)).success)

    def lines(self, name, text):
        """What the plugin tells of the model that is spawned: {first word: [rest of the line, ...]}."""
        self.done(self.sim.spawn(name, text))
        self.wait(lambda: any(told.startswith(name + "\n") for told in self.told))
        (told,) = (told for told in self.told if told.startswith(name + "\n"))
        found = {}
        for line in told.splitlines()[1:]:
            word, _, rest = line.partition(" ")
            found.setdefault(word, []).append(rest)
        return found

    def shape(self, name, shape, pose="5 5 5 0 0 0", static=1, more=""):
        return self.lines(name, MODEL.format(name=name, shape=shape, pose=pose, static=static, more=more))

    def test_each_shape_has_its_volume_and_fills_its_message(self):
        for name, shape, wanted in (
            ("box", "<box><size>1 2 3</size></box>", "6 type: BOX box { size { x: 1 y: 2 z: 3 } }"),
            ("ball", "<sphere><radius>0.5</radius></sphere>", "0.523599 type: SPHERE sphere { radius: 0.5 }"),
            (
                "can",
                "<cylinder><radius>0.2</radius><length>0.6</length></cylinder>",
                "0.0753982 type: CYLINDER cylinder { radius: 0.2 length: 0.6 }",
            ),
            (
                "floor",
                "<plane><normal>0 0 1</normal><size>50 40</size></plane>",
                "0 type: PLANE plane { normal { x: 0 y: 0 z: 1 } size { x: 50 y: 40 } }",
            ),
            (
                "outline",
                "<polyline><point>0 0</point><point>1 0</point><point>1 1</point><height>0.7</height></polyline>",
                "0.7 type: POLYLINE polyline { height: 0.7 point { x: 0 y: 0 } point { x: 1 y: 0 } point { x: 1 y: 1 } }",
            ),
        ):
            with self.subTest(name):
                self.assertEqual(self.shape(name, shape, pose="0 0 0 0 0 0" if name == "floor" else "5 5 5 0 0 0")["shape"], [wanted])

    def test_a_mesh_has_the_volume_of_the_box_round_it(self):
        with tempfile.NamedTemporaryFile("w", suffix=".obj") as file:
            file.write("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n")
            file.flush()
            found = self.shape("mesh", f"<mesh><uri>file://{file.name}</uri><scale>2 1 1</scale></mesh>")
        self.assertEqual(found["shape"], [f'2 type: MESH mesh {{ filename: "file://{file.name}" scale {{ x: 2 y: 1 z: 1 }} }}'])

    def test_a_height_map_has_heights(self):
        row, column = np.mgrid[0:33, 0:33]
        with tempfile.NamedTemporaryFile(suffix=".png") as file:
            Image.fromarray((4 * column + 3 * row).astype(np.uint8)).save(file.name)
            found = self.shape("map", f"<heightmap><uri>file://{file.name}</uri><size>20 20 4</size><pos>0 0 1</pos></heightmap>")
        self.assertEqual(
            found["shape"],
            [
                "0 type: HEIGHTMAP heightmap { size { x: 20 y: 20 z: 4 } origin { x: 0 y: 0 z: 1 } width: 65 height: 65 "
                f'filename: "file://{file.name}" sampling: 2 }}'
            ],
        )
        self.assertEqual(found["map"], ["65 65 0 4"])
        self.assertEqual(
            found["row"],
            [
                "0 0.571429 1.14286 1.71429 2.28571",
                "0.428571 1 1.57143 2.14286 2.71429",
                "0.857143 1.42857 2 2.57143 3.14286",
                "1.28571 1.85714 2.42857 3 3.57143",
                "1.71429 2.28571 2.85714 3.42857 4",
            ],
        )
        self.assertEqual(found["beyond"], ["0 0"])

    def test_balls_and_cylinders_change_their_sizes(self):
        ball = self.shape("ball", "<sphere><radius>0.5</radius></sphere>", "0 0 0.5 0 0 0", 0, "<resize>0.2 0</resize>")
        self.assertEqual(ball["shape"], ["0.0335103 type: SPHERE sphere { radius: 0.2 }"])
        can = self.shape(
            "can", "<cylinder><radius>0.2</radius><length>0.6</length></cylinder>", "3 0 0.5 0 0 0", 0, "<resize>0.3 0.8</resize>"
        )
        self.assertEqual(can["shape"], ["0.226195 type: CYLINDER cylinder { radius: 0.3 length: 0.8 }"])
        self.sim.step(1500)
        self.assertAlmostEqual(self.sim.model("ball").pose.position.z, 0.2, delta=1e-3)  # where it lies with that radius
        self.assertAlmostEqual(self.sim.model("can").pose.position.z, 0.4, delta=1e-3)

    def test_joints_batteries_and_the_air(self):
        found = self.lines("arm", ARM.format(more=""))
        self.assertEqual(found["joint"], ["1e+08 1 0.3 0 -0 0.3 0 -0 0 0.375"])
        self.assertEqual(found["battery"], ["bat 12.6 0 11 5 0 1"])
        self.assertEqual(found["air"], ["adiabatic 281.65 89882.1 1.22498 1.11172"])

    def test_the_time_of_the_world_is_set(self):
        self.assertEqual(self.lines("arm", ARM.format(more="<time>100</time>"))["time"], ["100"])
        self.sim.step(2)
        self.assertAlmostEqual(self.sim.world().sim_time, 100.002, delta=1.5e-3)
        self.assertEqual(len(self.told), 1)  # nobody is reset by it
        self.sim.empty("reset_simulation")
        self.wait(lambda: self.told[1:] == ["arm\nreset"])

    def test_a_battery_whose_law_throws_keeps_its_voltage_and_the_world_goes_on(self):
        self.lines("arm", ARM.format(more="<throws/>"))
        self.sim.step(5)
        self.wait(lambda: [line for line in self.log if "law of a battery" in line])
        self.assertIn("told to fail. It is not called any more; the simulation goes on", self.log[-1])
        self.assertAlmostEqual(self.sim.world().sim_time, 0.005, delta=1e-9)

    def test_who_touches_nothing_but_the_target_for_long_enough_says_so(self):
        self.done(self.sim.spawn("cube", TOUCHED.format(target="ground_plane")))
        self.sim.step(400)  # falls for 0.2 s
        self.assertEqual(self.told, [])
        self.sim.step(600)
        self.wait(lambda: self.told == ["cube\nheard 1"])

    def test_who_touches_something_else_says_nothing(self):
        self.done(self.sim.spawn("cube", TOUCHED.format(target="somebody_else")))
        self.wait(lambda: heard(self.subscribers[1:]))  # it would be heard
        self.sim.step(1500)
        self.assertEqual(self.told, [])


if __name__ == "__main__":
    rospy.init_node("surveys_rostest")
    rostest.rosrun("gazebo_ros", "surveys", SurveyTest)
