#!/usr/bin/env python3
"""Plugins in C++ that come with Gazebo itself. Figures are physics on paper, or those of the same scene in a real Gazebo 11.1, and each
test says which."""

import importlib.util
import math
import os
import sys
import unittest

import rospy
import rostest
from gazebo_ros.srv import Timeline

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from simulator import HearingCase  # noqa: E402

BODY = """<link name="{name}"><pose>{pose} 0 0 0</pose><inertial><mass>{mass}</mass><inertia><ixx>{inertia}</ixx><iyy>{inertia}</iyy>
<izz>{inertia}</izz></inertia></inertial>{more}</link>"""
JOINT = '<joint name="{name}" type="{type}"><parent>{parent}</parent><child>{child}</child>{more}</joint>'
CUBE = '<collision name="c"><geometry><box><size>0.1 0.1 0.1</size></box></geometry></collision>'
SENSOR = """<sensor name="s" type="force_torque"><always_on>{on}</always_on><update_rate>{rate}</update_rate>
<plugin name="breaks" filename="libBreakableJointPlugin.so">{inside}</plugin></sensor>"""


def body(name, pose="0 0 0", mass=1.0, inertia=0.1, more=""):
    return BODY.format(name=name, pose=pose, mass=mass, inertia=inertia, more=more)


def joint(name, kind, parent, child, axis="", more=""):
    return JOINT.format(name=name, type=kind, parent=parent, child=child, more=(f"<axis>{axis}</axis>" if axis else "") + more)


def model(*parts, pose="0 0 0"):
    held = joint("hold", "fixed", "world", "base")
    return f'<sdf version="1.6"><model name="any"><pose>{pose} 0 0 0</pose>{body("base", mass=5)}{held}{"".join(parts)}</model></sdf>'


def plugin(name, inside=""):
    return f'<plugin name="{name}" filename="lib{name}Plugin.so">{inside}</plugin>'


def bench(kind="fixed", force="<breaking_force_N>30</breaking_force_N>", on=1, rate=1000, axis=""):
    """2 kg that hang at 1.5 m."""
    sensor = SENSOR.format(on=on, rate=rate, inside=force)
    return model(
        body("w", "0 0 -0.5", 2, 0.02, CUBE), joint("j", kind, "base", "w", axis, "<pose>0 0 0.5 0 0 0</pose>" + sensor), pose="0 0 2"
    )


@unittest.skipUnless(importlib.util.find_spec("gazebo_cpp._core"), "this system lacks what Gazebo's headers need")
class StockTest(HearingCase):
    def setUp(self):
        super().setUp()
        self.assertTrue(self.sim.set_physics(gravity=(0.0, 0.0, -9.8)).success)

    def logged(self, *words):
        self.wait(lambda: any(all(word in line for word in words) for line in self.log))

    def weight(self, name="bench"):
        state = self.sim.link(f"{name}::w").link_state
        return state.pose.position.z, state.twist.linear.z

    # ---------------------------------------------------------------------------------------------------- joints that break

    def test_a_joint_breaks_when_it_bears_too_much(self):
        """2 kg weigh 19.6 N: 20 N more break what holds 30. Height and speed are those of a real Gazebo 11.1."""
        for kind, axis in (
            ("fixed", ""),
            ("revolute", "<xyz>0 1 0</xyz>"),
            ("revolute", "<xyz>0 1 0</xyz><limit><lower>0</lower><upper>0</upper></limit>"),
        ):
            for on in (0, 1):
                with self.subTest(kind, axis=axis, on=on):
                    self.done(self.sim.spawn("bench", bench(kind, axis=axis, on=on)))
                    self.sim.step(300)
                    self.near(self.weight(), (1.5, 0.0), 3)
                    self.done(self.sim.push("bench::w", (0.0, 0.0, -20.0), 0.2))
                    self.sim.step(100)
                    self.near(self.weight(), (1.402, -1.96), 2)
                    self.sim.step(1000)
                    self.near(self.weight(), (0.05, 0.0), 2)  # it lies on the ground
                    self.sim.delete("bench")

    def test_what_it_bears_at_rest_breaks_it_or_not(self):
        for force, z in (("<breaking_force_N>19</breaking_force_N>", 1.305), ("<breaking_force_N>20</breaking_force_N>", 1.5), ("", 1.305)):
            with self.subTest(force):  # without the element it is 1 N
                self.done(self.sim.spawn("bench", bench(force=force)))
                self.sim.step(200)
                self.assertAlmostEqual(self.weight()[0], z, delta=3e-3)
                self.sim.delete("bench")

    def test_it_breaks_when_the_sensor_measures(self):
        """A sensor of 10 Hz: at 0.4 s. From there it falls freely, pushed for another 0.1 s; as a real Gazebo 11.1 has it."""
        self.done(self.sim.spawn("bench", bench(rate=10)))
        self.sim.step(300)
        self.done(self.sim.push("bench::w", (0.0, 0.0, -20.0), 0.2))
        self.sim.step(100)
        self.near(self.weight(), (1.5, 0.0), 3)
        self.sim.step(200)
        self.assertAlmostEqual(self.weight()[0], 1.1525, delta=0.03)

    def test_a_broken_joint_stays_broken(self):
        """As in a real Gazebo 11.1: after a reset it falls again."""
        self.done(self.sim.spawn("bench", bench(force="<breaking_force_N>10</breaking_force_N>", axis="<xyz>0 1 0</xyz>", kind="revolute")))
        self.sim.step(800)
        self.assertAlmostEqual(self.weight()[0], 0.05, delta=5e-3)
        self.done(self.sim.joint("j"))
        self.sim.drive("j", 1.0, 0.1)
        self.sim.empty("reset_simulation")
        self.near(self.weight(), (1.5, 0.0), 6)
        self.sim.step(200)
        self.near(self.weight(), (1.303, -1.96), 2)
        self.done(self.sim.spawn("other", bench()))  # places in the shared arrays are given anew
        self.sim.step(10)
        self.assertAlmostEqual(self.weight("other")[0], 1.5, delta=1e-3)

    def test_moments_from_before_it_broke_are_refused_and_those_after_are_not(self):
        self.done(self.sim.spawn("bench", bench()))
        timeline = self.sim.proxy("timeline", Timeline)
        timeline(action=4)
        self.addCleanup(timeline, action=4)
        (before,) = timeline(action=1).numbers
        self.done(self.sim.push("bench::w", (0.0, 0.0, -20.0), 0.1))
        self.sim.step(200)
        _, after = timeline(action=1).numbers
        falling = self.weight()
        self.refused(timeline(action=2, number=before))
        self.assertEqual(self.weight(), falling)
        self.sim.step(50)
        self.done(timeline(action=2, number=after))
        self.near(self.weight(), falling, 9)

    def test_it_belongs_into_a_force_torque_sensor(self):
        imu = f'<sensor name="s" type="imu">{plugin("BreakableJoint")}</sensor>'
        self.done(self.sim.spawn("bench", model(body("w", more=imu))))
        self.logged("BreakableJoint", "it belongs into a sensor of type force_torque; s is of type imu")

    # ---------------------------------------------------------------------------------------------------- gears

    def gears(self, inside, name="gear"):
        turns = "<xyz>1 0 0</xyz>"
        gear = joint("gear", "gearbox", "inn", "out", turns, f"<gearbox_reference_body>base</gearbox_reference_body><axis2>{turns}</axis2>")
        hinges = joint("input", "revolute", "base", "inn", turns) + joint("output", "revolute", "base", "out", turns)
        wheels = body("inn", "0 0.3 0", 1, 0.05) + body("out", "0 -0.3 0", 1, 0.02)
        box = plugin("VariableGearbox", f"<gearbox_joint_name>{name}</gearbox_joint_name>{inside}")
        self.done(self.sim.spawn("gears", model(wheels, hinges, gear, box, pose="0 0 1")))

    def test_a_gearbox_whose_ratio_changes(self):
        """0.3 N m turn the input; both angles are those of a real Gazebo 11.1, which are on the curve."""
        self.gears("<x_y_dydx>0 0 1</x_y_dydx><x_y_dydx>1 2 3</x_y_dydx><x_y_dydx>2 3 0.5</x_y_dydx>")
        self.done(self.sim.drive("input", 0.3, 3.0))
        for steps, turned, out in ((500, 0.445, 0.6431), (500, 1.3429, 2.6777), (500, 3.9291, 3.9646), (1500, 19.8858, 11.9429)):
            self.sim.step(steps)
            self.assertAlmostEqual(self.sim.joint("input").position[0], turned, delta=2e-3)
            self.assertAlmostEqual(self.sim.joint("output").position[0], out, delta=2e-3)

    def test_gears_that_are_none(self):
        for inside, name, words in (
            ("", "gear", "<x_y_dydx> is missing"),
            ("<x_y_dydx>1 0 1</x_y_dydx><x_y_dydx>1 2 3</x_y_dydx>", "gear", "the inputs' angles have to be finite and to grow"),
            ("<x_y_dydx>1 0 1</x_y_dydx>", "input", "joint 'input' is not of type gearbox"),
            ("<x_y_dydx>1 0 1</x_y_dydx>", "none", "the model has no joint 'none'"),
        ):
            self.gears(inside, name)
            self.logged("VariableGearbox", words)
            self.sim.step(1)
            self.sim.delete("gears")

    # ---------------------------------------------------------------------------------------------------- joints that are controlled

    def spinners(self, inside):
        parts = [
            body(f"{name}_link", "0 0 0", 1, 0.5) + joint(name, "revolute", "base", f"{name}_link", "<xyz>0 0 1</xyz>")
            for name in ("placed", "left_spin", "right_spin", "pushed")
        ]
        self.done(self.sim.spawn("spinners", model(*parts, plugin("JointControl", inside), pose="0 0 1")))

    def test_joints_are_controlled_from_the_start(self):
        """0.5 kg m2 each: 20 N m/rad and 2 N m s/rad, 10 N m s/rad, and 0.2 N m. After 0.4 s they are where a real Gazebo 11.1 has them;
        on paper they swing, come as 1 - exp(-20 t), and go on by 0.4 rad/s2. The first begins with a jerk: its error was 0 before."""
        self.spinners(
            """<controller type="position"><joint>placed</joint><target>0.5</target><pid_gains>20 0 2</pid_gains></controller>
            <controller type="velocity"><joint>(.*)_spin</joint><target>1.5</target><pid_gains>10 0 0</pid_gains></controller>
            <controller type="force"><joint>pushed</joint><target>0.2</target></controller>"""
        )
        self.sim.step(400)
        for name, turned, rate in (("placed", 0.7157, 0.1514), ("left_spin", 0.5265, 1.4995), ("right_spin", 0.5265, 1.4995)):
            self.assertAlmostEqual(self.sim.joint(name).position[0], turned, delta=5e-3)
            self.assertAlmostEqual(self.sim.joint(name).rate[0], rate, delta=0.02)
        self.assertAlmostEqual(self.sim.joint("pushed").rate[0], 0.16, delta=1e-3)

    def test_controllers_that_are_none(self):
        self.spinners('<controller type="position"><joint>nobody</joint><target>1</target></controller><note>x</note>')
        self.logged("no joint of model spinners is called 'nobody'")
        self.logged("<note> means nothing here")
        self.sim.delete("spinners")
        self.spinners("<controller><joint>placed</joint></controller>")
        self.logged("the type has to be force, position or velocity")

    # ---------------------------------------------------------------------------------------------------- who follows

    def follower(self, x, y, inside="<left_joint>left</left_joint><right_joint>right</right_joint>"):
        """Rates of both wheels of a robot that stands: 0.1 m and 0.5 m apart; a post of 0.1 m stands at (x, y) before its eye."""
        eye = """<sensor name="eye" type="depth"><update_rate>30</update_rate><camera><horizontal_fov>1.2</horizontal_fov>
            <image><width>101</width><height>21</height></image><clip><near>0.05</near><far>20</far></clip></camera></sensor>"""
        ball = '<collision name="c"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>'
        wheels = body("l", "0 0.25 0", 1, 0.01, ball) + body("r", "0 -0.25 0", 1, 0.01, ball) + body("eye", more=eye)
        joints = joint("right", "revolute", "base", "r", "<xyz>0 1 0</xyz>") + joint("left", "revolute", "base", "l", "<xyz>0 1 0</xyz>")
        text = model(wheels, joints, joint("looks", "fixed", "base", "eye"), plugin("Follower", inside), pose="0 0 3")
        post = "<cylinder><radius>0.1</radius><length>2</length></cylinder>"
        post = f'<visual name="v"><geometry>{post}</geometry></visual>'
        self.done(
            self.sim.spawn(
                "post",
                f'<sdf version="1.6"><model name="post"><static>1</static><pose>{x} {y} 3 0 0 0</pose>'
                f'<link name="l">{post}</link></model></sdf>',
            )
        )
        self.done(self.sim.spawn("follower", text))

        def rates():
            self.sim.step(20)
            return [self.sim.joint(name).rate[0] for name in ("left", "right")]

        self.wait(lambda: any(abs(rate) > 1e-3 for rate in rates()) or self.sim.world().sim_time > 30)
        found = rates()
        self.clear(())
        return found

    def test_a_robot_follows_what_is_nearest(self):
        """-0.1 m/s of both wheels, and 0.1 rad/s at the edge of the picture, where tan(0.6) is the edge's bearing."""
        self.near(self.follower(2.0, 0.0), (-1.0, -1.0), 1)
        aside = 0.6 / 1.9 / math.tan(0.6) * 0.1 * 0.25 / 0.1
        self.near(self.follower(2.0, 0.6), (-1.0 + aside, -1.0 - aside), 2)
        self.near(self.follower(2.0, -0.6, ""), (-1.0 + aside, -1.0 - aside), 2)  # the first joint of the model is the right one

    def test_a_follower_has_to_see(self):
        self.done(self.sim.spawn("follower", model(plugin("Follower"))))
        self.logged("Follower", "the model has no sensor of type depth to look with")


if __name__ == "__main__":
    rospy.init_node("stock_rostest")
    rostest.rosrun("gazebo_ros", "stock", StockTest)
