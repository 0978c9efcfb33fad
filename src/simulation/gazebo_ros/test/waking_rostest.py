#!/usr/bin/env python3
"""What has come to rest wakes through the services: after spawning_rostest.py, in the same world."""

import rospy
import rostest
from gazebo_msgs import srv
from geometry_msgs.msg import Pose
from simulator import Case, box, pose, xyz

SHELF = box(geometry="<box><size>1 1 0.2</size></box>", extra="<static>1</static>")
CAN = box(geometry="<box><size>0.2 0.2 0.2</size></box>")
LOOK, FALLS = 200, 0.5 * 9.8 * 0.2**2  # steps of 1 ms, and m fallen in them


class Waking(Case):
    """Two cans on each other on a static shelf, and one on the ground, all long at rest."""

    def setUp(self):
        super().setUp()
        self.done(self.sim.set_physics())
        self.done(self.sim.spawn("shelf", SHELF, pose(-20, 0, 2.0)))
        for name, at in (("low", (-20, 0, 2.2)), ("high", (-20, 0, 2.4)), ("apart", (-25, 0, 0.1))):
            self.done(self.sim.spawn(name, CAN, pose(*at)))
        self.sim.step(2500)

    def tearDown(self):
        for name in {"shelf", "low", "high", "apart", "pivot", "board"} & set(self.sim.world().model_names):
            self.sim.delete(name)

    def height(self, name):
        return self.sim.model(name).pose.position.z

    def falls(self, act, *names, by=FALLS):
        before = {name: self.height(name) for name in names}
        self.done(act())
        self.sim.step(LOOK)
        for name in names:
            self.assertAlmostEqual(before[name] - self.height(name), by, delta=0.003, msg=name)

    def test_delete_model(self):
        self.falls(lambda: self.sim.delete("shelf"), "low", "high")
        self.assertAlmostEqual(self.height("apart"), 0.1, 3)

    def test_delete_the_one_between(self):
        self.done(self.sim.delete("low"))
        self.sim.step(100)
        self.assertAlmostEqual(self.height("high"), 2.4 - 0.25 * FALLS, delta=0.003)
        self.sim.step(1000)
        self.assertAlmostEqual(self.height("high"), 2.2, 3)

    def test_set_model_state(self):
        self.falls(lambda: self.sim.set_model("shelf", pose(-20, 5, 2.0)), "low", "high")

    def test_set_link_state(self):
        self.falls(lambda: self.sim.set_link("shelf::link", pose(-20, 5, 2.0)), "low", "high")

    def test_set_physics_properties(self):
        self.falls(lambda: self.sim.set_physics(gravity=(0, 0, 1.0)), "low", "high", "apart", by=-0.5 * 0.2**2)

    def test_set_link_properties(self):
        """A board that two cans hold level: one gets heavier."""
        pivot = box(geometry="<box><size>0.1 0.2 0.2</size></box>", extra="<static>1</static>")
        self.done(self.sim.spawn("pivot", pivot, pose(-30, 0, 0.1)))
        self.done(self.sim.spawn("board", box(geometry="<box><size>1.2 0.2 0.05</size></box>"), pose(-30, 0, 0.225)))
        self.done(self.sim.set_model("low", pose(-30.4, 0, 0.35)))
        self.done(self.sim.set_model("high", pose(-29.6, 0, 0.35)))
        self.sim.step(3000)
        self.assertAlmostEqual(self.height("low"), 0.35, 2)
        change = self.sim.proxy("set_link_properties", srv.SetLinkProperties)
        self.done(change("low::link", Pose(), True, 5.0, 0.03, 0, 0, 0.03, 0, 0.03))
        self.sim.step(1000)
        self.assertLess(self.height("low"), 0.3)

    def test_apply_body_wrench_on_what_carries(self):
        self.sim.push("low::link", (400.0, 0, 0), 0.2)
        self.sim.step(1000)
        self.assertLess(self.height("high"), 2.3)

    def test_reset_world(self):
        self.done(self.sim.delete("shelf"))
        self.sim.step(2500)
        self.sim.empty("reset_world")
        self.assertEqual(xyz(self.sim.model("high").pose.position), (-20, 0, 2.4))
        self.sim.step(LOOK)
        self.assertAlmostEqual(2.4 - self.height("high"), FALLS, delta=0.003)


if __name__ == "__main__":
    rospy.init_node("waking_rostest")
    rostest.rosrun("gazebo_ros", "waking", "__main__")
