"""gzclient: from the command line to the page and its window."""
from __future__ import annotations

import glob
import sys
import time
from typing import List, Optional

import node_signals
import rosgraph
import rospy
from ode_sim.viewer import Page
from ode_sim.viewer.website import Unavailable

from gzclient import command_line, desktop
from gzclient.panels.controllers import ControllersPanel
from gzclient.panels.sensors import SensorsPanel
from gzclient.panels.topics import TopicsPanel
from gzclient.ros_simulation import RosSimulation


PANELS = (SensorsPanel, TopicsPanel, ControllersPanel)


def main(arguments: List[str]) -> int:
    """Exit code: 0 the window was closed or the node ended, 1 it could not be opened."""
    options = command_line.parse(rospy.myargv(arguments))
    _wait_for_master()
    node_signals.init_node("gzclient", anonymous=True, disable_rostime=True,
                           log_level=rospy.DEBUG if options.verbose else rospy.INFO)
    for line in command_line.remarks(options):
        rospy.logwarn("%s", line)
    try:
        page = Page(RosSimulation(), options.port, options.listen, "Gazebo", PANELS,
                    say=lambda line: rospy.logwarn("%s", line))
    except Unavailable as error:
        rospy.logerr("gzclient: %s", error)
        return 1
    page.drawing.shadows = options.shadows or bool(glob.glob("/dev/dri/renderD*"))
    window = _open(page, options)
    try:
        page.run(lambda: rospy.is_shutdown() or window is not None and window.closed)
    finally:
        if window is not None:
            window.close()
        page.close()
    return 0


def _open(page: Page, options) -> Optional[desktop.Window]:
    """The window of the desktop, where there is one; the address on the terminal in any case."""
    window = None
    if desktop.available() and not options.no_window:
        window = desktop.Window(page.website.local_address)
        if window.process is None:
            rospy.logwarn("gzclient: no browser was found to show the window with; install chromium")
    print(f"gzclient: the simulator's window is at {page.address}", flush=True)
    return window


def _wait_for_master() -> None:
    warned = False
    while not rosgraph.is_master_online():
        if not warned:
            print(f"gzclient: no ROS master at {rosgraph.get_master_uri()}; waiting for one (start the simulator)",
                  file=sys.stderr, flush=True)
            warned = True
        time.sleep(0.5)
