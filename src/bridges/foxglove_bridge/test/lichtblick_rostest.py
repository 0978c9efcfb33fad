#!/usr/bin/env python3
"""The page as its user sees it: the address that is printed, by http; and, where Lichtblick itself is installed, in Debian's Chromium."""

import http.client
import json
import sys
import unittest
from urllib.parse import parse_qs, urlsplit

import rosgraph
import rospkg
import rospy
import rostest
from foxglove_bridge import page
from sensor_msgs.msg import JointState

sys.path.insert(0, rospkg.RosPack().get_path("gzclient") + "/test")
from browser import Browser, missing, share, wait  # noqa: E402

BRIDGE, PAGE = 28768, 28769
RED, GREEN = (255, 0, 0), (0, 200, 0)


def listened(topic):
    """Whether the bridge reads it, which it does for a panel that shows it."""
    return "/foxglove_bridge" in dict(rosgraph.Master(rospy.get_name()).getSystemState()[1]).get(topic, [])


def pointed():
    return rospy.wait_for_message("/joint_states", JointState, 10.0).position[0]


def lichtblick():
    """Whether the page is Lichtblick's own."""
    return "<title>Lichtblick" in (page.folder() / "index.html").read_text(encoding="utf-8")


class Served(unittest.TestCase):
    def get(self, path, **headers):
        """Status, headers and body."""
        near = http.client.HTTPConnection("127.0.0.1", PAGE, timeout=20)
        self.addCleanup(near.close)
        near.request("GET", path, headers=headers)
        answer = near.getresponse()
        return answer.status, answer.headers, answer.read()

    def setUp(self):
        def up():
            try:
                return self.get("/index.html")[0] == 200
            except OSError:
                return False

        wait(up, "the page")

    def test_1_the_address_leads_to_the_connection_and_the_layout(self):
        status, headers, _ = self.get("/")
        words = parse_qs(urlsplit(headers["Location"]).query)
        self.assertEqual((status, words["ds"], words["ds.url"]), (302, ["foxglove-websocket"], [f"ws://localhost:{BRIDGE}"]))
        place = urlsplit(words["layoutUrl"][0])
        self.assertEqual((place.port, place.path), (PAGE, "/layout/pointer.json"))
        wait(lambda: "Plot!Joint positions" in json.loads(self.get(place.path)[2])["configById"], "a plot of the joint")

    def test_2_only_this_machine_and_only_the_page(self):
        self.assertEqual(self.get("/", Host="evil.example")[0], 403)
        self.assertEqual(self.get("/../../../../../etc/passwd")[0], 404)

    @unittest.skipUnless(lichtblick(), "Lichtblick is not installed, or LICHTBLICK_PAGE does not name its folder")
    @unittest.skipIf(missing(), f"not installed: {missing()} (apt install chromium chromium-driver)")
    def test_3_lichtblick_shows_the_robot_and_commands_it(self):
        from selenium.webdriver.common.by import By
        from selenium.webdriver.common.keys import Keys

        wait(lambda: "Plot!Joint positions" in json.loads(self.get("/layout/x")[2])["configById"], "a plot of the joint")
        with Browser(f"http://localhost:{PAGE}/", size=(1400, 900), frames=0) as seen:
            for topic in ("/joint_states", "/tf", "/camera/image_raw"):
                wait(lambda topic=topic: listened(topic), f"a panel that shows {topic}")

            def canvases(colour):
                return max(share(each.screenshot_as_png, colour) for each in seen.driver.find_elements(By.TAG_NAME, "canvas"))

            wait(lambda: canvases(GREEN) > 2000, "the picture")
            wait(lambda: canvases(RED) > 500, "the robot in 3D")
            seen.see("Joint positions", "turn", "0.25")
            before = canvases(RED)
            seen.driver.find_element(By.XPATH, "//*[@title='Command']").click()
            message = wait(lambda: seen.driver.find_elements(By.TAG_NAME, "textarea"), "the message")[0]
            told = json.loads(message.get_attribute("value"))
            self.assertEqual((told["joint_names"], told["points"][0]["positions"]), (["turn"], [0.25]))
            told["points"][0]["positions"] = [1.5]
            message.send_keys(Keys.CONTROL, "a")
            message.send_keys(json.dumps(told))
            seen.driver.find_element(By.XPATH, "//button[normalize-space()='Publish']").click()
            wait(lambda: pointed() == 1.5, "the joint where the command put it")
            seen.see("1.5")
            wait(lambda: abs(canvases(RED) - before) > 100, "the robot turned in 3D")


if __name__ == "__main__":
    rospy.init_node("page_test")
    rostest.rosrun("foxglove_bridge", "page", "__main__")
