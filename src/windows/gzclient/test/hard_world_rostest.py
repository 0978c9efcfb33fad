#!/usr/bin/env python3
"""The window under what it has to bear: broken meshes, malicious names, reconnects, three pages, a slow network, and a server that comes
back with a world of a million triangles. By clicks in a real browser."""

import contextlib
import os
import shutil
import sys
import tempfile
from html import escape
from urllib.parse import urlsplit

import rospy
import rostest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from browser import Browser, share, wait  # noqa: E402
from hardships import BROKEN, SlowNetwork, broken_bodies, heavy_bodies, swinging_balls, write_world  # noqa: E402
from session import Session, errors, paused, streams  # noqa: E402

EVIL = "<img src=x onerror=document.title='owned'>"
RED = """<model name='red'><pose>-2 3 0.6 0 0 0</pose><link name='l'><gravity>0</gravity><visual name='v'><geometry><sphere>
<radius>0.6</radius></sphere></geometry><material><script><name>Gazebo/Red</name></script></material></visual></link></model>"""
NAMED = """<model name='{0}'><pose>-3 0 1 0 0 0</pose><link name='{0}'><visual name='{0}'><geometry><box><size>0.5 0.5 0.5</size></box>
</geometry></visual><collision name='{0}'><geometry><box><size>0.5 0.5 0.5</size></box></geometry></collision>
<sensor name='{0}' type='ray'><ray><scan><horizontal><samples>2</samples><min_angle>0</min_angle><max_angle>1</max_angle></horizontal>
</scan><range><min>0.1</min><max>1</max></range></ray></sensor></link><joint name='{0}' type='revolute'>
<parent>world</parent><child>{0}</child>
<axis><xyz>0 0 1</xyz></axis></joint></model>
<light name='{0} light' type='point'><pose>0 0 5 0 0 0</pose></light>"""


class HardWorld(Session):
    LAST = "test_6"

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="hard_world_")
        cls.addClassCleanup(shutil.rmtree, cls.folder, ignore_errors=True)
        named = NAMED.format(escape(EVIL, quote=True))
        cls.WORLD = write_world(
            os.path.join(cls.folder, "hard.world"), RED + named + broken_bodies(cls.folder) + swinging_balls(12), escape(EVIL, quote=True)
        )
        super().setUpClass()

    def not_owned(self):
        self.assertNotEqual(self.page.driver.title, "owned")
        self.assertEqual(self.page.driver.execute_script("return document.querySelectorAll(\"img[src='x']\").length"), 0)

    def test_1_what_is_whole_is_drawn_beside_broken_meshes(self):
        page = self.page
        page.see("Iterations", "red", *BROKEN)
        page.click("red")
        page.see("Mass (kg)")
        page.click("Look at")
        wait(lambda: share(page.scene(), (255, 0, 0)) > 1000, "the red ball")
        page.click("missing.dae")
        page.see("missing.dae", "Mass (kg)")

    def test_2_names_with_markup_are_text(self):
        page = self.page
        page.fill("Search", "onerror")
        page.see(f"{EVIL} light")
        page.click(EVIL)
        page.see("Position (m)")
        page.link(EVIL)
        page.see(f"{EVIL}::{EVIL}")
        page.click("Look at")
        page.click("Joints")
        page.see(EVIL)
        page.click("Scene")
        for kind in ("Labels", "Joints", "Link frames"):
            page.check(kind)
        page.click("World")
        page.click(f"{EVIL} light")
        page.see("Highlights", "Range (m)")
        page.click(EVIL)
        page.click("Copy")
        page.see(f"{EVIL}_0")
        page.click("Undo")
        page.fill("Search", "")
        page.click("Scene")
        for kind in ("Labels", "Joints", "Link frames"):
            page.check(kind)
        page.click("World")
        self.not_owned()

    def test_3_reconnects(self):
        page = self.page
        page.click("Play")
        wait(lambda: not paused(), "play")
        for _ in range(4):  # scripts/bench page does more of them, and measures
            page.driver.refresh()
            page.see("real-time factor", "b9")
            page.click("Pause")
            wait(paused, "pause")
            page.click("Play")
            wait(lambda: not paused(), "play")
        self.not_owned()

    def test_4_three_pages_see_the_same_world_and_one_holds_the_controls(self):
        with contextlib.ExitStack() as stack:
            pages = [self.page, *(stack.enter_context(Browser(self.page.address, frames=2)) for _ in range(2))]
            first, second, third = pages
            for page in pages:
                page.see("real-time factor", "b9")
            second.check("Hold the controls")
            for page in (first, third):
                page.click("Pause")
                page.see("Another page holds the controls")
            self.assertFalse(paused())
            second.click("Pause")
            for page in pages:
                page.see("paused")
            second.click("Reset world")
            for page in pages:
                page.see("Iterations 0")
            second.click("red")
            second.click("Delete")
            for page in pages:
                wait(lambda page=page: "red" not in page.text().split("\n"), "a world without the red ball")
            second.close()  # it takes the controls along with it
            wait(
                lambda: not third.driver.execute_script("return [...document.querySelectorAll('input[type=checkbox]')][0].checked"),
                "the controls are free, and the box says so",
            )
            third.click("Undo")
            for page in (first, third):
                wait(lambda page=page: "red" in page.text().split("\n"), "the red ball again")
            third.click("Play")
            first.see("real-time factor")
            for page in (first, third):
                self.assertEqual(errors(page), [])

    def test_5_a_slow_network(self):
        address = urlsplit(self.page.address)
        with SlowNetwork(address.port) as network, Browser(f"http://localhost:{network.port}/?{address.query}", frames=2) as page:
            page.see("real-time factor", "b9")
            for _ in range(3):
                page.click("Pause")
                page.see("paused")
                wait(paused, "pause")
                page.click("Play")
                page.see("real-time factor")
            self.assertEqual(errors(page), [])
        wait(streams, "the page that is left goes on")

    def test_5b_the_server_comes_back_with_two_hundred_models_of_a_million_triangles(self):
        page = self.page
        self.end(self.server)
        page.see("no simulator answers")
        heavy = write_world(os.path.join(self.folder, "heavy.world"), heavy_bodies(self.folder))
        type(self).server = self.start("rosrun", "gazebo_ros", "gzserver", "-u", heavy)
        page.see("m0", "more: search")
        wait(lambda: "b9" not in page.text(), "the models of the new world only")
        page.fill("Search", "m199")
        page.click("m199")
        page.see("Mass (kg)")
        page.click("Play")
        wait(lambda: not paused(), "play")
        page.see("real-time factor")
        page.click("Delete")
        wait(lambda: "m199" not in page.text().split("\n"), "a world without it")
        page.click("Undo")
        wait(lambda: "m199" in page.text().split("\n"), "it is there again")

    def test_6_the_page_is_closed(self):
        self.page.close()
        wait(lambda: not streams(), "the end of the stream: nobody looks")
        self.assertIsNone(self.client.poll())


if __name__ == "__main__":
    rospy.init_node("hard_world_test", disable_rostime=True)
    rostest.rosrun("gzclient", "hard_world", "__main__")
