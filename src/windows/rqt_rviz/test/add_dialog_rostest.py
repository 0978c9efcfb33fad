#!/usr/bin/env python3
"""RViz's dialog *Add* in a window on a private display, by real clicks: a display of a package that declares it and is not built."""

import os
import signal
import tempfile
import unittest

import rospkg
import rostest
from rqt_testing.desktop import Desktop
from rviz_offscreen import qt

PACKAGE = """<package format='2'><name>my_displays</name><version>0.0.1</version><description>d</description>
<maintainer email='a@b.cd'>a</maintainer><license>BSD</license><depend>rviz</depend>
<export><rviz plugin='${prefix}/plugins.xml'/></export></package>"""
PLUGINS = """<library path='lib/libmy_displays'>
<class name='my_displays/Arc' type='my::Arc' base_class_type='rviz::Display'><description>An arc.</description></class></library>"""
_TRIES = 4  # software OpenGL ends RViz in its first frame by SIGSEGV, one start in some twenty


class AddDialog(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        package = os.path.join(self.folder.name, "my_displays")
        os.mkdir(package)
        for name, text in (("package.xml", PACKAGE), ("plugins.xml", PLUGINS)):
            with open(os.path.join(package, name), "w") as file:
                file.write(text)

    def window(self, desktop):
        script = os.path.join(rospkg.RosPack().get_path("rqt_rviz"), "scripts", "rqt_rviz")
        path = f"{self.folder.name}:{os.environ['ROS_PACKAGE_PATH']}"
        for left in reversed(range(_TRIES)):
            window = desktop.run(
                [script, "--clear-config"], ROS_PACKAGE_PATH=path, ROS_HOME=self.folder.name, QT_API=(qt.package() or "").lower()
            )
            window.wait(lambda window=window: window.process.poll() is not None or window.ask("entry", "Add"), "RViz's window", 120)
            if window.process.poll() != -signal.SIGSEGV or not left:
                return window

    def test_a_display_that_is_not_built_is_told_and_costs_only_itself(self):
        with Desktop("1280x940x24") as desktop:
            window = self.window(desktop)
            told = "my_displays/Arc of the package my_displays cannot be added"
            window.wait(
                lambda: f"{told}, its library libmy_displays is not built: catkin build my_displays" in window.output(), "what to build"
            )
            window.click_text("Add")
            window.click_text("Arc")
            if os.environ.get("ADD_PICTURE"):
                desktop.screenshot(os.environ["ADD_PICTURE"])
            window.click_text("OK")
            window.wait(lambda: "Could not find library corresponding to plugin my_displays/Arc" in window.output(), "RViz's own word")
            window.wait(lambda: window.ask("entry", "Arc"), "the display that failed, among the others")
            window.click_text("Add")  # and others can be added
            window.click_text("Axes")
            window.click_text("OK")
            window.wait(lambda: window.ask("entry", "Axes"), "a display that is built")
            if os.environ.get("ADD_PICTURE"):
                desktop.screenshot(os.environ["ADD_PICTURE"] + ".after.png")
            self.assertEqual(window.output().count(told), 1)
            window.end()


if __name__ == "__main__":
    rostest.rosrun("rqt_rviz", "add_dialog", AddDialog)
