#!/usr/bin/env python3
"""Joints that plugins make while the simulation runs. Figures are physics on paper."""

import importlib.util
import math
import os
import sys
import unittest

import rospy
import rostest
from gazebo_msgs.srv import GetJointProperties

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from simulator import HearingCase  # noqa: E402

G = 9.8
BODY = """<link name="{name}"><pose>{pose} 0 0 0</pose><inertial><mass>2</mass><inertia><ixx>0.02</ixx><iyy>0.02</iyy><izz>0.02</izz>
</inertia></inertial>{more}</link>"""
BALL = '<collision name="c"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>'
JOINT = '<joint name="{name}" type="{type}"><parent>{parent}</parent><child>{child}</child>{more}</joint>'
WAYS = ("early", "late", "model", "sdf")


def body(name, pose="0 0 0", more=""):
    return BODY.format(name=name, pose=pose, more=more)


def join(name, kind, parent, child, way="early", axis="0 1 0", pose="0 0 0", limits=(), damping=0.0):
    """A <join> of the test's plugin; of parent and child the models are named as well."""
    lower_upper = f"<lower>{limits[0]}</lower><upper>{limits[1]}</upper>" if limits else ""
    turns = f"<xyz>{axis}</xyz><limit>{lower_upper}</limit><dynamics><damping>{damping}</damping></dynamics>"
    more = f"<pose>{pose} 0 0 0</pose><axis>{turns}</axis>"
    inner = JOINT.format(name=name, type=kind, parent=parent.split("::")[-1], child=child.split("::")[-1], more=more)
    return f"""<join><name>{name}</name><type>{kind}</type><way>{way}</way><parent>{parent}</parent><child>{child}</child>{lower_upper}
        <axis>{axis}</axis><pose>{pose} 0 0 0</pose><damping>{damping}</damping>{inner}</join>"""


def model(name, *parts, pose="0 0 2"):
    return f'<sdf version="1.6"><model name="{name}"><pose>{pose} 0 0 0</pose>{"".join(parts)}</model></sdf>'


def joiner(*joins):
    return f'<plugin name="joiner" filename="libgazebo_ros_test_joiner.so">{"".join(joins)}</plugin>'


@unittest.skipUnless(importlib.util.find_spec("gazebo_cpp._core"), "this system lacks what Gazebo's headers need")
class MadeJointsTest(HearingCase):
    def setUp(self):
        super().setUp()
        self.assertTrue(self.sim.set_physics(gravity=(0.0, 0.0, -G)).success)

    def spawn(self, name, *parts, pose="0 0 2"):
        self.done(self.sim.spawn(name, model(name, *parts, pose=pose)))

    def order(self, text):
        """(holds, position, speed, greatest speed so far, N that the child bears upwards), after what was ordered."""
        rospy.wait_for_service("/joiner/order", 20)
        answer = rospy.ServiceProxy("/joiner/order", GetJointProperties)(text)
        return answer.success, answer.position[0], answer.rate[0], answer.damping[0], float(answer.status_message)

    def place(self, link):
        p = self.sim.link(link).link_state.pose.position
        return p.x, p.y, p.z

    # ---------------------------------------------------------------------------------------------------- one model and the world

    def test_a_link_swings_on_the_world(self):
        """From the horizontal: w^2 = 2 m g d / (I + m d^2) at the bottom, whichever way the joint was made."""
        fastest = math.sqrt(2 * 2 * G * 0.5 / (0.02 + 2 * 0.25))
        for way in WAYS:
            with self.subTest(way):
                self.spawn("any", body("w"), joiner(join("hinge", "revolute", "world", "any::w", way, pose="-0.5 0 0")))
                self.sim.step(1000)
                holds, angle, _, most, _ = self.order("look hinge")
                self.assertTrue(holds)
                self.near((most,), (fastest,), 1)
                x, _, z = self.place("any::w")
                self.near((x, z), (-0.5 + 0.5 * math.cos(angle), 2 - 0.5 * math.sin(angle)), 3)
                self.done(self.sim.delete("any"))

    def test_limits_hold_it(self):
        for way in WAYS:
            with self.subTest(way):
                hinge = join("hinge", "revolute", "world", "any::w", way, pose="-0.5 0 0", limits=(-0.2, 0.3), damping=2)
                self.spawn("any", body("w"), joiner(hinge))
                self.sim.step(2000)
                self.near(self.order("look hinge")[1:3], (0.3, 0.0), 3)
                self.done(self.sim.delete("any"))

    def test_force_and_damping(self):
        """About the vertical: 0.1 N m against 0.05 N m s make 2 rad/s; I/c = 0.4 s."""
        for way in WAYS:
            with self.subTest(way):
                self.spawn("any", body("w"), joiner(join("hinge", "revolute", "world", "any::w", way, axis="0 0 1", damping=0.05)))
                self.order("force hinge 0.1")
                self.sim.step(400)
                self.near(self.order("look hinge")[2:3], (2 * (1 - math.exp(-1)),), 2)
                self.sim.step(4000)
                self.near(self.order("look hinge")[2:3], (2.0,), 3)
                self.done(self.sim.delete("any"))

    def test_a_ball_joint_keeps_its_point(self):
        self.spawn("any", body("w"), joiner(join("ball", "ball", "world", "any::w", pose="-0.3 -0.4 0")))
        for _ in range(10):
            self.sim.step(100)
            self.assertAlmostEqual(math.dist(self.place("any::w"), (-0.3, -0.4, 2)), 0.5, delta=2e-3)

    # ---------------------------------------------------------------------------------------------------- loops, other models

    def test_it_closes_a_parallelogram(self):
        """Two cranks of 0.4 m, 1 m apart, a rod between them: they swing as one pendulum, from 45 degrees. The CoM of a crank (2 kg, 0.02
        kg m2) is at its end, that of the rod in its middle: w^2 = 2 g (3 m r) (1 - sin 45) / (2 (I + m r^2) + m r^2)."""
        r = 0.4 * math.sqrt(0.5)
        crank = self.hinge(f"{-r} 0 {r}")
        parts = (
            body("base") + JOINT.format(name="hold", type="fixed", parent="world", child="base", more=""),
            body("one", f"{r} 0 {-r}") + JOINT.format(name="a", type="revolute", parent="base", child="one", more=crank),
            body("two", f"{1 + r} 0 {-r}") + JOINT.format(name="b", type="revolute", parent="base", child="two", more=crank),
            body("rod", f"{0.5 + r} 0 {-r}")
            + JOINT.format(name="c", type="revolute", parent="one", child="rod", more=self.hinge("-0.5 0 0")),
        )
        self.spawn("any", *parts, joiner(join("close", "revolute", "any::rod", "any::two")))
        fastest = 0.0
        for _ in range(120):
            self.sim.step(10)
            rate = self.sim.joint("a").rate[0]
            fastest = max(fastest, abs(rate))
            self.assertAlmostEqual(self.sim.joint("b").rate[0], rate, delta=0.02)
            self.assertLess(math.dist(self.place("any::two"), [p + q for p, q in zip(self.place("any::one"), (1, 0, 0))]), 1e-3)
        self.near((fastest,), (math.sqrt(2 * G * 6 * 0.4 * (1 - math.sqrt(0.5)) / (2 * (0.02 + 2 * 0.16) + 2 * 0.16)),), 2)
        self.near(self.order("look close")[1:2], (self.sim.joint("b").position[0],), 2)

    @staticmethod
    def hinge(pose):
        return f"<pose>{pose} 0 0 0</pose><axis><xyz>0 1 0</xyz></axis>"

    def test_a_slide_between_two_models(self):
        """It drops by 0.2 m to its limit, and hangs there with its weight; when the joint lets go it falls on, and is held again where it
        is attached."""
        self.spawn("rail", body("r", more=BALL), JOINT.format(name="hold", type="fixed", parent="world", child="r", more=""), pose="0 0 3")
        for way in ("early", "late"):
            with self.subTest(way):
                slide = join("slide", "prismatic", "rail::r", "any::w", way, axis="0 0 1", limits=(-0.2, 0.0), damping=20)
                self.spawn("any", body("w", more=BALL), joiner(slide))
                self.sim.step(3000)
                holds, way_down, _, _, borne = self.order("look slide")
                self.assertTrue(holds)
                self.near((way_down, self.place("any::w")[2]), (-0.2, 1.8), 3)
                self.near((abs(borne),), (2 * G,), 1)
                self.assertFalse(self.order("drop slide")[0])
                self.sim.step(100)
                self.near((self.place("any::w")[2],), (1.8 - 0.5 * G * 0.01,), 2)
                self.assertTrue(self.order("attach slide")[0])
                self.sim.step(3000)
                self.assertGreater(self.place("any::w")[2], 1.4)
                self.done(self.sim.delete("any"))

    def test_what_hangs_on_a_model_falls_when_it_goes(self):
        self.spawn("rail", body("r"), JOINT.format(name="hold", type="fixed", parent="world", child="r", more=""), pose="0 0 3")
        joins = [join(kind, kind, "rail::r", f"any::{kind}") for kind in ("revolute", "ball", "universal", "fixed")]
        self.spawn("any", *(body(kind) for kind in ("revolute", "ball", "universal", "fixed")), joiner(*joins))
        self.sim.step(50)
        self.done(self.sim.delete("rail"))
        self.sim.step(100)
        for kind in ("revolute", "ball", "universal", "fixed"):
            self.assertLess(self.place(f"any::{kind}")[2], 1.97, kind)
            self.order(f"look {kind}")
            self.order(f"drop {kind}")

    def test_what_is_attached_does_not_collide_and_what_was_let_go_does(self):
        """Two balls of 0.1 m, 0.15 m between their middles."""
        self.spawn("rail", body("r", more=BALL), JOINT.format(name="hold", type="fixed", parent="world", child="r", more=""))
        hinge = join("hinge", "revolute", "rail::r", "any::w", axis="0 0 1", pose="-0.15 0 0")
        self.spawn("any", body("w", "0.15 0 0", more=BALL), joiner(hinge))
        self.sim.step(500)
        self.near(self.place("any::w"), (0.15, 0.0, 2.0), 3)
        self.order("drop hinge")
        self.sim.step(100)
        self.assertGreater(self.place("any::w")[0], 0.1505)

    def test_a_firm_joint_tells_what_it_bears(self):
        """Fixed, or with both limits at 0."""
        self.spawn("rail", body("r"), JOINT.format(name="hold", type="fixed", parent="world", child="r", more=""), pose="0 0 3")
        joins = (join("weld", "fixed", "rail::r", "any::a"), join("pin", "revolute", "rail::r", "any::b", "late", limits=(0, 0)))
        self.spawn("any", body("a"), body("b", "1 0 0"), joiner(*joins))
        self.sim.step(200)
        for name in ("weld", "pin"):
            holds, *_, borne = self.order(f"look {name}")
            self.assertTrue(holds, name)
            self.near((abs(borne),), (2 * G,), 1)
        self.near((*self.place("any::a"), *self.place("any::b")), (0.0, 0.0, 2.0, 1.0, 0.0, 2.0), 3)

    def test_a_pin_and_a_hinge_outlive_a_reset(self):
        joins = (join("pin", "fixed", "world", "any::a"), join("hinge", "revolute", "world", "any::b", pose="0 0 0.5"))
        self.spawn("any", body("a"), body("b", "1 0 0"), joiner(*joins))
        for reset in ("reset_world", "reset_simulation"):
            with self.subTest(reset):
                self.sim.push("any::b", (5.0, 0.0, 0.0), 0.1)
                self.sim.step(200)
                self.sim.empty(reset)
                self.sim.step(200)
                self.assertTrue(self.order("look pin")[0] and self.order("look hinge")[0])
                self.near((self.place("any::a")[2],), (2.0,), 3)
                self.assertAlmostEqual(math.dist(self.place("any::b"), (1, 0, 2.5)), 0.5, delta=2e-3)

    def test_position_by_hand_and_a_joint_that_is_removed(self):
        self.spawn("any", body("w"), joiner(join("hinge", "revolute", "world", "any::w", "model", axis="0 0 1", pose="-0.5 0 0")))
        self.near(self.order("move hinge 1.2")[1:2], (1.2,), 6)
        self.near(self.place("any::w"), (-0.5 + 0.5 * math.cos(1.2), 0.5 * math.sin(1.2), 2.0), 5)
        self.order("remove hinge")
        self.sim.step(100)
        self.assertLess(self.place("any::w")[2], 1.96)


if __name__ == "__main__":
    rospy.init_node("made_joints_rostest")
    rostest.rosrun("gazebo_ros", "made_joints", MadeJointsTest)
