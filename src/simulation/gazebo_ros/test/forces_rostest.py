#!/usr/bin/env python3
"""Plugins that come with Gazebo: lift and drag, buoyancy, wind, velocities. Figures are those of a real Gazebo 11.1
(scripts/real_gazebo/records: lift_glides, lift_sideslip, lift_radial, buoyancy_told, wind_steady, velocity_initial)."""

import importlib.util
import os
import sys
import unittest

import rospy
import rostest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from simulator import HearingCase  # noqa: E402

MODEL = """<sdf version="1.6"><model name="b">{mode}<pose>{pose}</pose><link name="l"><gravity>{gravity}</gravity>
<inertial><pose>{centre}</pose><mass>{mass}</mass><inertia><ixx>{moments[0]}</ixx><iyy>{moments[1]}</iyy><izz>{moments[2]}</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia>
</inertial><collision name="c"><geometry><box><size>0.2 0.2 0.2</size></box></geometry></collision></link>{more}</model></sdf>"""
PLUGIN = '<plugin name="{0}" filename="lib{0}Plugin.so">{1}</plugin>'
WING = (
    "<air_density>1.2</air_density><area>0.2</area><a0>0.05</a0><cla>4.75</cla><cda>0.64</cda><cma>-1.8</cma>"
    "<alpha_stall>0.34</alpha_stall>"
)
WIND = "<enable_wind>{}</enable_wind>"


def model(*plugins, pose="0 0 5 0 0 0", mass=1.0, moments=(0.1, 0.1, 0.1), centre="0 0 0 0 0 0", gravity=1, mode=""):
    more = "".join(PLUGIN.format(*plugin) for plugin in plugins)
    return MODEL.format(pose=pose, mass=mass, moments=moments, centre=centre, gravity=gravity, mode=mode, more=more)


def wing(elements, linear, pose):
    lift = ("LiftDrag", f"<link_name>l</link_name>{WING}{elements}")
    thrown = ("InitialVelocity", f"<linear>{linear}</linear>")
    return model(lift, thrown, pose=pose, mass=1.5, moments=(0.05, 0.06, 0.07), centre="0.05 0 0.02 0 0 0")


@unittest.skipUnless(importlib.util.find_spec("gazebo_cpp._core"), "this system lacks what Gazebo's headers need")
class ForcesTest(HearingCase):
    def setUp(self):
        super().setUp()
        self.assertTrue(self.sim.set_physics(gravity=(0.0, 0.0, -9.8)).success)

    def at(self, text, steps, **wanted):
        """Spawns the model, steps and compares coordinates of its pose."""
        self.done(self.sim.spawn("b", text))
        self.sim.step(steps)
        pose = self.sim.model("b").pose
        for name, value in wanted.items():
            got = getattr(pose.orientation, name[1:]) if name.startswith("q") else getattr(pose.position, name)
            self.assertAlmostEqual(got, value, delta=max(1e-4 * abs(value), 1e-5), msg=f"{name}: {pose}")

    def test_a_wing_glides(self):
        self.at(wing("<cp>0.02 0 0</cp>", "12 0 0", "0 0 50 0 -0.1 0"), 500, x=5.779807, z=50.22519)

    def test_a_wing_slips_to_the_side(self):
        elements = "<cp>-0.1 0.3 0.05</cp><forward>2 0.4 0</forward><upward>0 0 3</upward>"
        self.at(wing(elements, "9 4 -1", "0 0 50 0.1 -0.05 0.3"), 500, x=4.469161, y=2.00198, z=48.52573)

    def test_fins_all_round(self):
        self.at(wing("<radial_symmetry>true</radial_symmetry>", "10 2 -2", "0 0 50 0 0 0"), 500, x=5.126863, y=0.3712322, z=49.00902)

    def test_a_body_rises_in_water_and_turns(self):
        told = "<link name='l'><center_of_volume>0.01 0 0.05</center_of_volume><volume>0.0055</volume></link>"
        self.at(
            model(("Buoyancy", told), pose="0 0 50 0.1 0 0", mass=5, moments=(0.2, 0.2, 0.2)),
            400,
            z=50.07782,
            qx=0.00501624,
            qy=-0.08957165,
        )

    def test_a_body_of_waters_density_stays(self):
        """Archimedes: 8 l of its collision, 8 kg."""
        self.at(model(("Buoyancy", "<fluid_density>1000</fluid_density>"), mass=8), 500, x=0, y=0, z=5)

    def test_wind(self):
        moments = (0.1, 0.1, 0.1)
        self.at(model(pose="0 0 5 0 0 0.7", mass=2, moments=moments, gravity=0, mode=WIND.format(1)), 500, x=0.05181365, y=0.003619873, z=5)

    def test_no_wind_for_who_does_not_ask(self):
        self.at(model(gravity=0, mode=WIND.format(0)), 500, x=0, y=0, z=5)

    def test_a_first_velocity_comes_back_with_a_reset(self):
        text = model(("InitialVelocity", "<linear>1 2 3</linear><angular>0 0 1</angular>"), gravity=0)
        self.at(text, 500, x=0.5, y=1.0, z=6.5, qz=0.2474039)
        self.sim.empty("reset_world")
        self.sim.step(500)
        self.assertAlmostEqual(self.sim.model("b").pose.position.z, 6.5, delta=1e-4)

    def test_random_ways_keep_to_their_limits_and_are_the_same_again(self):
        text = model(
            (
                "RandomVelocity",
                "<link>l</link><initial_velocity>0 0.5 0</initial_velocity><velocity_factor>5</velocity_factor>"
                "<update_period>0.1</update_period><min_x>-1</min_x><max_x>-2</max_x><min_z>0</min_z><max_z>0</max_z>",
            ),
            gravity=0,
        )
        ways = []
        for _ in range(2):
            self.done(self.sim.spawn("b", text))
            self.sim.step(50)
            first = self.sim.model("b").twist.linear
            self.assertEqual((round(first.x, 6), round(first.y, 6), round(first.z, 6)), (0, 0.5, 0))
            self.sim.step(200)
            later = self.sim.model("b").twist.linear
            self.assertTrue(-2 <= later.x <= -1 and abs(later.y) <= 5 and abs(later.z) < 1e-9, later)
            ways.append((later.x, later.y))
            self.done(self.sim.delete("b"))
            self.sim.empty("reset_simulation")  # the first period counts from the start of the world, as in Gazebo
        self.assertEqual(ways[0], ways[1])

    def test_a_link_that_is_not_there_is_one_line(self):
        for plugin, tag in (("LiftDrag", "link_name"), ("RandomVelocity", "link")):
            self.done(self.sim.spawn("b", model((plugin, f"<{tag}>lost</{tag}>"))))
            self.wait(lambda tag=tag: any(f"<{tag}>: the model has no link 'lost'" in line for line in self.log))
            self.done(self.sim.delete("b"))


if __name__ == "__main__":
    rospy.init_node("forces_rostest")
    rostest.rosrun("gazebo_ros", "forces", ForcesTest)
