#!/usr/bin/env python3
"""The simulator as its window sees it: stream and services."""

import time
import unittest

import numpy as np
import rosgraph
import rospy
import rostest
from gazebo_msgs.srv import GetModelState, GetWorldProperties
from gazebo_ros.srv import CommandJoint, CommandJointRequest
from gzclient.ros_simulation import RosSimulation
from ode_sim import World, math3
from ode_sim.description import model as d
from ode_sim.description.sdf_writer import light_text
from ode_sim.math3 import Pose
from ode_sim_viewer import Refused
from ode_sim_viewer.simulation import SurfaceProperties
from std_srvs.srv import Empty

PATIENCE = 180.0  # s, on a machine that does other things too
EVIL = "<img src=x onerror=document.title='owned'>"


def wait(condition, what, seconds=PATIENCE):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        value = condition()
        if value:
            return value
        time.sleep(0.1)
    raise AssertionError(f"not in {seconds:g} s: {what}")


def call(name, service, *arguments):
    rospy.wait_for_service(f"/gazebo/{name}", PATIENCE)
    return rospy.ServiceProxy(f"/gazebo/{name}", service)(*arguments)


def model_position(name):
    p = call("get_model_state", GetModelState, name, "").pose.position
    return np.array((p.x, p.y, p.z))


def streams(topic):
    """Whether the server sends it to anybody."""
    return any(name == topic for name, _ in rosgraph.Master(rospy.get_name()).getSystemState()[1])


class Stream(unittest.TestCase):
    """The simulator as the page sees it."""

    @classmethod
    def setUpClass(cls):
        call("get_world_properties", GetWorldProperties)
        cls.simulation = RosSimulation()
        cls.simulation.look(True)
        cls.frame(cls)

    @classmethod
    def tearDownClass(cls):
        cls.simulation.close()
        call("unpause_physics", Empty)

    def frame(self, condition=lambda frame: True):
        return wait(lambda: (frame := self.simulation.frame()) is not None and condition(frame) and frame, "a frame")

    def row(self, model, link):
        return self.simulation.describe().model(model).links[link]

    def test_frames_follow_the_world_also_while_it_is_paused(self):
        self.simulation.pause(True)
        self.frame(lambda frame: frame.paused)
        row = self.row("box", "link")
        self.simulation.set_pose("box", Pose((0.0, 2.0, 5.0), math3.quat_from_rpy(0.0, 0.0, 1.0)))
        frame = self.frame(lambda frame: abs(frame.poses[row][1] - 2.0) < 1e-4)
        np.testing.assert_allclose(frame.pose(row).p, model_position("box"), atol=1e-4)
        before = frame.iterations
        self.simulation.step(7)
        self.frame(lambda frame: frame.iterations == before + 7)
        self.simulation.pause(False)
        self.frame(lambda frame: not frame.paused and frame.iterations > before + 100 and frame.real_time_factor > 0.0)

    def test_what_comes_and_goes_is_another_revision(self):
        still = "<sdf version='1.6'><model name='x'><static>1</static><link name='l'/></model></sdf>"
        self.simulation.insert("extra", still, Pose((9.0, 9.0, 1.0)))
        record = self.simulation.describe()
        frame = self.frame(lambda frame: frame.revision == record.revision)  # a frame of before lacks the row
        self.assertEqual(record.model("extra").pose(frame).p, (9.0, 9.0, 1.0))
        with self.assertRaisesRegex(Refused, "already exists"):
            self.simulation.insert("extra", "<sdf version='1.6'><model name='x'><link name='l'/></model></sdf>", Pose())
        self.simulation.delete("extra")
        self.frame(lambda frame: frame.revision > record.revision)
        self.assertIsNone(self.simulation.describe().model("extra"))

    def test_joints_are_put_and_driven(self):
        self.simulation.pause(False)
        row = self.simulation.describe().model("door").joints["hinge"]
        self.simulation.command_joint("door", "hinge", "position", 1.0, (20.0, 0.0, 5.0))
        self.frame(lambda frame: abs(frame.joints[row] - 1.0) < 0.02)
        self.simulation.command_joint("door", "hinge", "none", 0.0)
        self.simulation.set_joint_position("door", "hinge", -0.5)
        self.frame(lambda frame: abs(frame.joints[row] + 0.5) < 0.05)
        self.simulation.command_joint("door", "hinge", "force", 1.0)
        self.frame(lambda frame: frame.joints[row] > 0.5)
        self.simulation.command_joint("door", "hinge", "velocity", -0.3, (5.0, 0.0, 0.0))
        self.frame(lambda frame: frame.joints[row] < 0.3)
        self.simulation.command_joint("door", "hinge", "none", 0.0)
        answer = call("command_joint", CommandJoint, "no_such", CommandJointRequest.FORCE, 1.0, 0.0, 0.0, 0.0)
        self.assertFalse(answer.success)
        self.assertIn("no_such", answer.status_message)
        self.assertFalse(call("command_joint", CommandJoint, "door::hinge", 9, 1.0, 0.0, 0.0, 0.0).success)
        self.assertFalse(call("command_joint", CommandJoint, "door::hinge", 1, float("nan"), 0.0, 0.0, 0.0).success)

    def test_mass_physics_and_light_are_set(self):
        from dataclasses import replace

        now = self.simulation.link_properties("box", "link")
        self.assertEqual(now.mass, 2.0)
        self.simulation.set_link_properties("box", "link", replace(now, mass=3.0, gravity=True))
        self.assertEqual(self.simulation.link_properties("box", "link").mass, 3.0)
        physics, gravity = self.simulation.physics()
        self.simulation.set_physics(replace(physics, iters=77, max_contacts=9, contact_surface_layer=0.002), (0.0, 0.0, -5.0))
        now = self.simulation.physics()
        self.assertEqual((now[0].iters, now[0].max_contacts, now[0].contact_surface_layer, now[1]), (77, 9, 0.002, (0.0, 0.0, -5.0)))
        self.simulation.set_physics(physics, gravity)
        light = self.simulation.describe().lights[0]
        self.simulation.set_light(replace(light, diffuse=(1.0, 0.0, 0.0, 1.0)))
        self.assertEqual(self.simulation.describe().lights[0].diffuse, (1.0, 0.0, 0.0, 1.0))
        spot = d.Light("lamp", "spot", range=5.0, spot=(0.3, 0.6, 1.0))
        self.simulation.insert("lamp", light_text(spot), Pose((1.0, 2.0, 3.0)))
        self.simulation.describe()
        self.simulation.set_light(replace(spot, range=33.0, pose=Pose((1.0, 2.0, 3.0))))  # Gazebo's service has no range
        now = next(light for light in self.simulation.describe().lights if light.name == "lamp")
        self.assertEqual((now.range, now.pose.p), (33.0, (1.0, 2.0, 3.0)))
        self.simulation.delete("lamp")

    def test_the_saved_world_can_be_started(self):
        saved = World.load(self.simulation.save())
        self.assertEqual(list(saved.models), ["ground_plane", "box", "door", EVIL])
        self.assertGreater(saved.time, 0.0)

    def test_gone_back_in_time(self):
        self.simulation.pause(True)
        self.simulation.set_pose("box", Pose((0.0, -3.0, 7.0)))
        self.simulation.keep()
        before = self.frame(lambda frame: frame.paused)
        self.simulation.step(300)
        self.simulation.keep()
        self.assertLess(model_position("box")[2], 6.9)
        first, last = self.simulation.moments()[-2:]
        self.assertAlmostEqual(last.time - first.time, 0.3, places=6)
        self.simulation.go_back(first.number)
        np.testing.assert_allclose(model_position("box"), (0.0, -3.0, 7.0), atol=1e-9)
        self.frame(lambda frame: frame.iterations == before.iterations and frame.paused)
        self.simulation.step(300)
        with self.assertRaisesRegex(Refused, "not kept"):
            self.simulation.go_back(10**6)
        self.simulation.record(0.1)
        self.simulation.step(500)
        self.simulation.record(0.0)
        self.assertGreaterEqual(len(self.simulation.moments()), 5)
        self.simulation.insert("late", "<sdf version='1.6'><model name='x'><static>1</static><link name='l'/></model></sdf>", Pose())
        self.assertEqual(self.simulation.moments(), ())
        self.simulation.delete("late")

    def test_contacts_bear_the_weight(self):
        self.simulation.pause(False)
        self.simulation.set_pose("box", Pose((0.0, 0.0, 0.5)))
        self.simulation.watch_contacts(True)
        mass = self.simulation.link_properties("box", "link").mass

        def borne():
            found = self.simulation.contacts()
            return abs(np.abs(found[:, 5]).sum() - 9.8 * mass) < 0.2 * mass

        wait(borne, "contacts that bear the box")
        self.simulation.watch_contacts(False)
        wait(lambda: not streams("/gazebo/view_contacts"), "the end of the stream of contacts")

    def test_colour_and_friction(self):
        known = self.simulation.describe()
        look = known.model("box").description.links[0].visuals
        self.simulation.paint("box", "link", (0.0, 0.0, 1.0, 0.5))
        self.frame(lambda frame: frame.revision != known.revision)
        visual = self.simulation.describe().model("box").description.links[0].visuals[0]
        self.assertEqual((visual.material.diffuse, visual.transparency), ((0.0, 0.0, 1.0, 1.0), 0.5))
        self.simulation.set_looks("box", {"link": look, "gone": look})
        self.assertEqual(self.simulation.describe().model("box").description.links[0].visuals, look)
        self.simulation.set_surface("box", "link", SurfaceProperties(0.3, 0.4, 0.1))
        self.assertEqual(self.simulation.surface("box", "link"), SurfaceProperties(0.3, 0.4, 0.1))
        for wrong in (
            lambda: self.simulation.paint("nobody", "", (1.0, 0.0, 0.0, 1.0)),
            lambda: self.simulation.set_looks("nobody", {}),
            lambda: self.simulation.set_looks("box", {"link": (1.0,)}),
            lambda: self.simulation.set_surface("box", "link", SurfaceProperties(-1.0, 0.0, 0.0)),
            lambda: self.simulation.set_surface("box", "link", SurfaceProperties(float("nan"), 0.0, 0.0)),
            lambda: self.simulation.surface("door", "frame"),
        ):
            with self.assertRaises(Refused):
                wrong()

    def test_a_move_by_hand_is_prompt(self):
        """What of the 100 ms from gizmo to pose is not the browser's: service, step and stream."""
        self.simulation.pause(True)
        row, took = self.row("box", "link"), []
        for number in range(30):
            begin = time.monotonic()
            self.simulation.set_pose("box", Pose((number * 0.01 + 0.5, 0.0, 2.0)))
            while abs(self.simulation.frame().poses[row][0] - number * 0.01 - 0.5) > 1e-5:
                self.assertLess(time.monotonic() - begin, PATIENCE)
                time.sleep(0.001)
            took.append(time.monotonic() - begin)
        self.assertLess(float(np.median(took)), 0.1)


if __name__ == "__main__":
    rospy.init_node("gzclient_test", disable_rostime=True)
    rostest.rosrun("gzclient", "gzclient", "__main__")
