"""A simulator and its window as a user starts them, for tests by real clicks; what a click did is asked by ROS."""

import contextlib
import os
import signal
import subprocess
import tempfile
import unittest

import numpy as np
import rosgraph
import rospy
from browser import PATIENCE, Browser, missing, wait
from gazebo_msgs.srv import GetModelState, GetPhysicsProperties, GetWorldProperties
from gazebo_ros.srv import DescribeWorld
from ode_sim.description.exchange import loads
from ode_sim.math3 import quat_to_rpy
from ode_sim_viewer import simulation  # noqa: F401  how a world is described

HERE = os.path.dirname(os.path.realpath(__file__))
FIELD = 0.9  # rad, ode_sim_viewer.eye


def call(name, service, *arguments):
    rospy.wait_for_service(f"/gazebo/{name}", PATIENCE)
    return rospy.ServiceProxy(f"/gazebo/{name}", service)(*arguments)


def names():
    return call("get_world_properties", GetWorldProperties).model_names


def position(name):
    p = call("get_model_state", GetModelState, name, "").pose.position
    return np.array((p.x, p.y, p.z))


def yaw(name):
    q = call("get_model_state", GetModelState, name, "").pose.orientation
    return quat_to_rpy((q.x, q.y, q.z, q.w))[2]


def sim_time():
    return call("get_world_properties", GetWorldProperties).sim_time


def world():
    return loads(call("describe_world", DescribeWorld).world)


def material(name):
    return world().model(name).description.links[0].visuals[0].material


def sides(name):
    """Of a box, m."""
    model = world().model(name)
    return model and tuple(round(side, 6) for side in model.description.links[0].collisions[0].geometry.size)


def paused():
    return call("get_physics_properties", GetPhysicsProperties).pause


def streams(topic="/gazebo/view"):
    """Whether the server sends frames to anybody."""
    return any(name == topic for name, _ in rosgraph.Master(rospy.get_name()).getSystemState()[1])


def errors(page):
    """Lines of its console that say that something is wrong."""
    usual = (
        "Unable to preventDefault inside passive event listener",  # three.js's own, at every press on the scene
        "Tried to update non-existent component",
    )  # viser's own, of a control that goes while it is set
    return [line for line in page.complaints() if not any(word in line for word in usual)]


class Session(unittest.TestCase):
    """One page, in the order of the tests' names.

    :cvar WORLD: of this folder, begun paused. :cvar LAST: prefix of the test that closes the page
    """

    WORLD = "table.world"
    LAST = "test_9"

    @classmethod
    def setUpClass(cls):
        if missing():
            raise unittest.SkipTest(f"not installed: {missing()} (apt install chromium chromium-driver)")
        cls.home = tempfile.TemporaryDirectory(prefix="home_", ignore_cleanup_errors=True)
        cls.addClassCleanup(cls.home.cleanup)
        cls.server = cls.start("rosrun", "gazebo_ros", "gzserver", "-u", os.path.join(HERE, cls.WORLD))
        call("get_world_properties", GetWorldProperties)
        cls.client = cls.start("rosrun", "gazebo_ros", "gzclient", "--port", "0", stdout=subprocess.PIPE)
        address = cls.client.stdout.readline().split()[-1]
        assert not streams(), "nobody looks yet"
        cls.page = Browser(address)

        cls.addClassCleanup(cls.page.close)

    @classmethod
    def start(cls, *words, stdout=subprocess.DEVNULL):
        """Without a display, in a home folder of the test's, to the end of the tests at most."""
        environment = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY")}
        process = subprocess.Popen(words, text=True, start_new_session=True, env={**environment, "HOME": cls.home.name}, stdout=stdout)
        cls.addClassCleanup(cls.end, process)
        return process

    @staticmethod
    def end(process):
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGINT)
            process.wait(PATIENCE)
        if process.stdout is not None:
            process.stdout.close()

    def setUp(self):
        self.page.driver.get_log("browser")

    def tearDown(self):
        if self._testMethodName.startswith(self.LAST):
            return
        if os.environ.get("BROWSER_SHOTS"):
            from selenium.common.exceptions import WebDriverException

            with contextlib.suppress(WebDriverException):  # the browser is busy: the test was about something else
                self.page.shot(os.path.join(os.environ["BROWSER_SHOTS"], f"{self._testMethodName}.png"))
        self.assertEqual(errors(self.page), [])
