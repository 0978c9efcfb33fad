#!/usr/bin/env python3
"""The window over a real rosmon: two nodes are shown, one is stopped and started again; then rosmon ends."""

import os
import signal
import subprocess
import unittest
from pathlib import Path

import rospy
import rostest
from rqt_testing.in_process import errors, find, open_plugin, screenshot, wait_until  # noqa: I100  before anything of Qt

LAUNCH = Path(__file__).resolve().parent / "two_nodes.launch"


class RqtRosmon(unittest.TestCase):
    def test_nodes_are_shown_and_obey(self):
        rosmon = subprocess.Popen(
            ["rosrun", "rosmon_core", "rosmon", "--disable-ui", "--name=rosmon_test", str(LAUNCH)],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            start_new_session=True,
        )
        self.addCleanup(rosmon.wait)
        self.addCleanup(lambda: rosmon.poll() is None and os.killpg(rosmon.pid, signal.SIGKILL))
        with open_plugin("rqt_rosmon") as gui:
            plugin, table = gui.plugin, find(gui, "node_table")

            def name(row):
                return table.item(row, 1).text().rstrip("/") + "/" + table.item(row, 0).text()

            def rows():
                return {name(row): table.item(row, 2).text() for row in range(table.rowCount())}

            def choose(wanted):
                table.clearSelection()
                table.selectRow(next(row for row in range(table.rowCount()) if name(row) == wanted))

            wait_until(lambda: rows() == {"/lab/talker.1": "running", "/idle": "running"}, 60)
            self.assertEqual(find(gui, "rosmon_combo").currentText(), "/rosmon_test/state")
            find(gui, "stop_button").click()
            self.assertEqual(find(gui, "message_label").text(), "Choose nodes in the table first.")
            choose("/lab/talker.1")
            find(gui, "stop_button").click()
            wait_until(lambda: rows() == {"/lab/talker.1": "idle", "/idle": "running"}, 60)
            self.assertEqual(plugin.chosen(), ["/lab/talker.1"], "what was chosen stays chosen")
            if os.environ.get("PICTURE"):
                screenshot(gui, os.environ["PICTURE"])
            find(gui, "start_button").click()
            wait_until(lambda: rows()["/lab/talker.1"] == "running", 60)
            rosmon.send_signal(signal.SIGINT)
            rosmon.wait(60)
            wait_until(lambda: find(gui, "message_label").text() == "/rosmon_test/state: this rosmon has ended.", 60)
            find(gui, "start_button").click()
        self.assertEqual(errors, [])


if __name__ == "__main__":
    rospy.init_node("rqt_rosmon_rostest")
    rostest.rosrun("rqt_rosmon", "rqt_rosmon_rostest", RqtRosmon)
