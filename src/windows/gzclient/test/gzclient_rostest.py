#!/usr/bin/env python3
"""The window of a running simulator: stream, services, and real clicks in a browser; what they do is asked by ROS."""
import os
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

import numpy as np
import rospy
import rostest
from gazebo_msgs.srv import GetModelState, GetPhysicsProperties, GetWorldProperties
from gazebo_ros.srv import CommandJoint, CommandJointRequest
from ode_sim import World, math3
from ode_sim.math3 import Pose
from ode_sim.viewer import Refused
from std_srvs.srv import Empty

from gzclient.ros_simulation import RosSimulation

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


def names():
    return call("get_world_properties", GetWorldProperties).model_names


def paused():
    return call("get_physics_properties", GetPhysicsProperties).pause


def streams():
    """Whether the server sends frames to anybody."""
    import rosgraph
    return any(topic == "/gazebo/view" for topic, _ in rosgraph.Master(rospy.get_name()).getSystemState()[1])


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
        before = self.simulation.describe().revision
        still = "<sdf version='1.6'><model name='x'><static>1</static><link name='l'/></model></sdf>"
        self.simulation.insert("extra", still, Pose((9.0, 9.0, 1.0)))
        frame = self.frame(lambda frame: frame.revision != before)
        record = self.simulation.describe()
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
        self.simulation.set_physics(replace(physics, iters=77), (0.0, 0.0, -5.0))
        self.assertEqual((self.simulation.physics()[0].iters, self.simulation.physics()[1]), (77, (0.0, 0.0, -5.0)))
        self.simulation.set_physics(physics, gravity)
        light = self.simulation.describe().lights[0]
        self.simulation.set_light(replace(light, diffuse=(1.0, 0.0, 0.0, 1.0)))
        self.assertEqual(self.simulation.describe().lights[0].diffuse, (1.0, 0.0, 0.0, 1.0))

    def test_the_saved_world_can_be_started(self):
        saved = World.load(self.simulation.save())
        self.assertEqual(list(saved.models)[:3], ["ground_plane", "box", "door"])
        self.assertIn(EVIL, saved.models)
        self.assertGreater(saved.time, 0.0)


class Browser(unittest.TestCase):
    """gzclient as a user starts it, and Debian's Chromium."""

    @classmethod
    def setUpClass(cls):
        if not os.environ.get("GZCLIENT_BROWSER_TEST"):
            raise unittest.SkipTest("a browser takes minutes on a busy machine; GZCLIENT_BROWSER_TEST=1 runs it")
        if not shutil.which("chromium") or not shutil.which("chromedriver"):
            raise unittest.SkipTest("no chromium and chromedriver here: apt install chromium chromium-driver")
        call("pause_physics", Empty)
        environment = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY")}
        cls.client = subprocess.Popen(["rosrun", "gazebo_ros", "gzclient", "--port", "0"], env=environment, text=True,
                                      stdout=subprocess.PIPE, start_new_session=True)
        line = cls.client.stdout.readline()
        cls.address = line.split()[-1]
        cls.folder = tempfile.TemporaryDirectory(prefix="chromium_", ignore_cleanup_errors=True)
        cls.browser = cls.open()

    @classmethod
    def open(cls):
        from selenium import webdriver
        from selenium.webdriver.chrome.options import Options
        from selenium.webdriver.chrome.service import Service
        options = Options()
        for word in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
                     "--disable-background-networking", "--disable-component-update", "--disable-sync",
                     "--disable-dev-shm-usage", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
                     "--window-size=640,480", f"--user-data-dir={cls.folder.name}"):
            options.add_argument(word)
        options.binary_location = shutil.which("chromium")
        browser = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)
        browser.set_page_load_timeout(PATIENCE)
        browser.set_script_timeout(PATIENCE)
        # few pictures a second: they are drawn by the processor, which has more to do
        browser.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source":
            "window.requestAnimationFrame = f => setTimeout(() => f(performance.now()), 400);"
            "window.cancelAnimationFrame = clearTimeout;"})
        browser.get(cls.address)
        return browser

    @classmethod
    def tearDownClass(cls):
        cls.browser.quit()
        os.killpg(cls.client.pid, signal.SIGINT)
        cls.client.wait(PATIENCE)
        cls.folder.cleanup()
        call("unpause_physics", Empty)

    def text(self):
        return self.browser.execute_script("return document.body.innerText")

    def click(self, label):
        """The button, tab or box of that label, by a click where it is."""
        from selenium.webdriver.common.by import By
        quoted = f'"{label}"' if "'" in label else f"'{label}'"
        path = (f"//button[normalize-space(.)={quoted}]|//*[@role='tab'][normalize-space(.)={quoted}]"
                f"|//*[normalize-space(text())={quoted}]/following::input[@type='checkbox'][1]")

        def found():
            return next(iter(self.browser.find_elements(By.XPATH, path)), None)
        element = wait(found, f"a button {label}")
        self.browser.execute_script("arguments[0].scrollIntoView({block: 'center'})", element)
        self.browser.execute_script("arguments[0].click()", element)

    def test_clicks(self):
        wait(lambda: "Iterations" in self.text() and "paused" in self.text(), "the page")
        self.assertTrue(streams())
        wait(lambda: EVIL in self.text(), "a name with markup in it, as text")
        self.assertNotEqual(self.browser.title, "owned")
        self.click("Play")
        wait(lambda: not paused(), "play")
        wait(lambda: "real-time factor" in self.text(), "the real-time factor")
        self.click("Pause")
        wait(paused, "pause")
        self.click("box")
        wait(lambda: "Mass (kg)" in self.text(), "properties of the box")
        self.click("Copy")
        wait(lambda: "box_0" in names(), "a copy")
        self.click("Undo")
        wait(lambda: "box_0" not in names(), "undo")
        self.click("Delete")
        wait(lambda: "box" not in names(), "delete")
        self.click("Undo")
        wait(lambda: "box" in names(), "undo of delete")
        self.click("Insert")
        self.click("Cylinder")
        wait(lambda: "unit_cylinder" in names(), "a cylinder")
        np.testing.assert_allclose(model_position("unit_cylinder"), (0.0, 0.0, 0.5), atol=1e-6)
        self.click("View")
        for kind in ("Collisions", "Joints", "Labels"):
            self.click(kind)
        self.reconnects()
        self.closing_the_page_ends_the_stream()

    def reconnects(self):
        for _ in range(3):
            self.browser.refresh()
            wait(lambda: "Iterations" in self.text() and "unit_cylinder" in self.text(), "the page again")
        severe = [line["message"] for line in self.browser.get_log("browser")
                  if line["level"] == "SEVERE" and "favicon" not in line["message"]]
        self.assertEqual(severe, [])

    def closing_the_page_ends_the_stream(self):
        self.browser.get("about:blank")
        wait(lambda: not streams(), "the end of the stream: nobody looks")
        self.assertIsNone(self.client.poll())


if __name__ == "__main__":
    rospy.init_node("gzclient_test", disable_rostime=True)
    rostest.rosrun("gzclient", "gzclient", "__main__")
