#!/usr/bin/env python3
"""What the window shows of sensors, topics and physics, and what it keeps of the scene: in a real browser, by clicks."""

import os
import sys
import time
import xmlrpc.client

import numpy as np
import rosgraph
import rosnode
import rospy
import rostest
from gazebo_msgs.msg import ModelState
from gazebo_msgs.srv import GetPhysicsProperties, SetModelState
from geometry_msgs.msg import Point, Pose, Quaternion, Twist
from std_msgs.msg import String

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from browser import Browser, pixels, share, wait  # noqa: E402
from session import Session, call, paused, sim_time  # noqa: E402

EVIL = "/<img/src='x'/onerror=document.title='owned'>"  # a topic that the master takes
KINDS = {
    "Laser scans": ("/scan", (30, 60, 255)),
    "Sonars": ("/sonar", (255, 140, 0)),
    "Bumpers": ("/bumper", (220, 30, 160)),
    "Wrenches": ("/wrench", (120, 60, 220)),
    "Cameras": ("/cam/image_raw", None),
    "Depth clouds": ("/deep/points", None),
}


def physics():
    return call("get_physics_properties", GetPhysicsProperties)


def listened(topic):
    """Whether the window takes messages of it."""
    nodes = dict(rosgraph.Master(rospy.get_name()).getSystemState()[1]).get(topic, [])
    return any(node.startswith("/gzclient") for node in nodes)


def coarse(png):
    """Means of squares of 16 pixels: the page draws edges and lines finer when it has time to."""
    seen = pixels(png)
    rows, columns = seen.shape[0] // 16, seen.shape[1] // 16
    return seen[: 16 * rows, : 16 * columns].reshape(rows, 16, columns, 16, 3).mean(axis=(1, 3))


def differ(one, other):
    """Number of such squares that look otherwise."""
    return int((np.abs(coarse(one) - coarse(other)).max(axis=2) > 6).sum())


class Sensors(Session):
    WORLD = "sensing.world"

    def test_1_physics_is_set(self):
        page = self.page
        page.click("Physics")
        wait(lambda: page.value("Solver iterations") == "50", "what the world has")
        page.fill("Gravity (m/s²)", -5, 3)
        wait(lambda: physics().gravity.z == -5.0, "gravity")
        page.fill("Step (s)", 0.002)
        page.fill("Steps per second", 500)
        page.fill("Solver iterations", 77)
        wait(lambda: (physics().time_step, physics().max_update_rate, physics().ode_config.sor_pgs_iters) == (0.002, 500.0, 77), "the rest")
        page.fill("Gravity (m/s²)", -9.8, 3)
        wait(lambda: physics().gravity.z == -9.8, "gravity")

    def test_2_what_sensors_see_and_feel_is_drawn(self):
        page = self.page
        page.click("Play")
        wait(lambda: not paused(), "play")
        page.click("Scene")
        page.check("Grid")  # off: its lines are as thick as the page finds time for
        page.fill("Arrow for 1 N (m)", 0.1)  # out of the bodies on which the forces act
        page.click("Sensors")
        until = sim_time() + 2.0
        wait(lambda: sim_time() > until, "bodies at rest")
        for kind, (topic, colour) in KINDS.items():
            self.is_drawn_while_checked(kind, topic, colour)

    def is_drawn_while_checked(self, kind, topic, colour):
        """:param colour: of what is drawn; None where it has the colours of the world"""
        page, before = self.page, self.at_rest()

        def drawn(since, now):
            return differ(now, since) if colour is None else share(now, colour) - share(since, colour)

        page.check(kind)
        wait(lambda: listened(topic), f"{topic} is listened to")
        wait(lambda: drawn(before, page.scene()) > (4 if colour is None else 30), kind)
        shown = self.at_rest()
        if os.environ.get("BROWSER_SHOTS"):
            page.shot(os.path.join(os.environ["BROWSER_SHOTS"], f"{kind}.png"))
        page.check(kind)
        wait(lambda: not listened(topic), f"{topic} is not listened to any more")

        def gone():
            """It looks more as before than as with what was drawn."""
            now = page.scene()
            return abs(drawn(before, now)) < 0.5 * abs(drawn(shown, now))

        wait(gone, f"a view without {kind}")

    def at_rest(self):
        """The scene, once it is drawn as the simulation is now."""

        def still():
            first = self.page.scene()
            time.sleep(1.5)
            return first if differ(first, self.page.scene()) < 2 else None

        return wait(still, "a scene at rest")

    def test_3_topics_as_picture_text_and_plot(self):
        page = self.page
        page.click("Topics")
        master = xmlrpc.client.ServerProxy(os.environ["ROS_MASTER_URI"])
        self.assertEqual(master.registerPublisher("/stranger", EVIL, "std_msgs/String", "http://localhost:1/")[0], 1)
        said = rospy.Publisher("/said", String, queue_size=1, latch=True)
        said.publish(EVIL)
        page.click("Look for topics")
        page.choose("Topic", "/cam/image_raw")
        page.see("/cam/image_raw (sensor_msgs/Image)")
        wait(
            lambda: page.driver.execute_script(
                "return [...document.images].filter(i => i.naturalWidth === 160 && i.naturalHeight === 120).length"
            ),
            "the picture",
        )
        page.choose("Topic", "/sonar")
        page.see("radiation_type: 0", "range: ")
        page.fill("Plot", "rnage")
        page.see("there is no rnage in the message")
        page.fill("Plot", "range")
        wait(lambda: page.driver.execute_script("return document.querySelectorAll('.uplot canvas').length"), "a plot")
        page.choose("Topic", EVIL)
        page.see(f"{EVIL}: waiting for a message of std_msgs/String")
        page.choose("Topic", "/said")
        page.see("data: ", EVIL)
        self.assertNotEqual(page.driver.title, "owned")
        master.unregisterPublisher("/stranger", EVIL, "http://localhost:1/")

    def test_3b_plots_and_topics_open_in_a_tab_of_their_own(self):
        """*Window > Plots and topics*: without Lichtblick's page a line that says how to get it; with it, a bridge and the page."""
        page, driver = self.page, self.page.driver
        first = driver.current_window_handle

        def opened():
            page.click("Plots and topics")
            wait(lambda: len(driver.window_handles) == 2, "a second tab")
            driver.switch_to.window(next(handle for handle in driver.window_handles if handle != first))

        def back():
            driver.close()
            driver.switch_to.window(first)

        opened()
        page.see("rosrun foxglove_bridge lichtblick --install")
        back()
        folder = os.path.join(self.home.name, ".local/share/noetic_labs/lichtblick")
        os.makedirs(folder)
        with open(os.path.join(folder, "index.html"), "w", encoding="utf-8") as file:
            file.write("<title>of plots</title><p>Here are plots</p>")
        opened()
        page.see("Here are plots")
        self.assertIn("ds.url=ws%3A%2F%2Flocalhost%3A", driver.current_url)
        back()
        self.assertTrue(any(name.startswith("/lichtblick") for name in rosnode.get_node_names()))

    def test_4_a_replay_plays_without_the_simulator(self):
        page = self.page
        page.click("Record")
        page.button("Record")
        file = self.kept("Stop and keep the recording", ".html")
        with Browser(f"file://{file}") as other:
            self.assertEqual(other.driver.title, "Replay of sensing")
            wait(lambda: len(np.unique(pixels(other.scene()).reshape(-1, 3), axis=0)) > 20, "a scene")
            begin = other.scene()
            wait(lambda: differ(other.scene(), begin) > 3, "something that moves")
            self.assertEqual(other.complaints(), [])

    def kept(self, stop, ending):
        """A file of what is recorded while the block falls for a second; ``stop`` is the button that ends it."""
        self.page.see(stop)
        call("set_model_state", SetModelState, ModelState("block", Pose(Point(0.0, 2.0, 5.0), Quaternion(w=1.0)), Twist(), "world"))
        until = sim_time() + 1.0
        wait(lambda: sim_time() > until, "a second")
        self.page.click(stop)
        file = os.path.join(self.home.name, f"kept{ending}")
        with open(file, "wb") as stream:
            stream.write(self.page.downloaded(ending))
        return file

    def test_5_a_screenshot_is_what_the_page_shows(self):
        page = self.page
        page.click("Screenshot")
        shot, seen = pixels(page.downloaded(".png")), pixels(page.scene())
        self.assertEqual(shot.shape, seen.shape)
        self.assertLess(np.median(np.abs(shot - seen)), 10.0)

    def test_6_a_film_shows_what_moved(self):
        import cv2

        self.page.click("Film")
        film, pictures = cv2.VideoCapture(self.kept("Stop and keep the film", ".mp4")), []
        while (read := film.read())[0]:
            pictures.append(read[1])
        self.assertGreater(len(pictures), 10)
        self.assertEqual(film.get(cv2.CAP_PROP_FPS), 25.0)
        self.assertTrue(any(np.abs(picture.astype(float) - pictures[0]).max() > 60 for picture in pictures))


if __name__ == "__main__":
    rospy.init_node("sensors_test", disable_rostime=True)
    rostest.rosrun("gzclient", "sensors", "__main__")
