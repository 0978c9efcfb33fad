"""gzclient: from the command line to the page and its window.

What a page needs is imported when a browser has knocked: a gzclient that nobody looks at, as launch files start it,
holds a port and nothing else.
"""
from __future__ import annotations

import sys
import time
from typing import Any, List, Optional

import node_signals
import rosgraph
import rospy

from gzclient import command_line, desktop

_LOOK = 0.25  # wall s between two looks at whether the node has ended


def main(arguments: List[str]) -> int:
    """Exit code: 0 the window was closed or the node ended, 1 it could not be opened."""
    options = command_line.parse(rospy.myargv(arguments))
    _wait_for_master()
    node_signals.init_node("gzclient", anonymous=True, disable_rostime=True,
                           log_level=rospy.DEBUG if options.verbose else rospy.INFO)
    for line in command_line.remarks(options):
        rospy.logwarn("%s", line)
    from ode_sim.viewer.website import Unavailable, Website
    try:
        website = Website(options.port, options.listen)
    except Unavailable as error:
        rospy.logerr("gzclient: %s", error)
        return 1
    window = _open(website, options)

    def ended() -> bool:
        return rospy.is_shutdown() or window is not None and window.closed

    try:
        while not ended():
            if window is not None and window.process is not None or website.knocked(_LOOK):
                return _serve(website, options, ended)
        return 0
    finally:
        if window is not None:
            window.close()
        website.close()


def _serve(website: Any, options: Any, ended: Any) -> int:
    from ode_sim.viewer.website import Unavailable

    from gzclient.page import make_page
    try:
        page = make_page(website, options.shadows)
    except Unavailable as error:
        rospy.logerr("gzclient: %s", error)
        return 1
    try:
        page.run(ended)
    finally:
        page.close()
    return 0


def _open(website: Any, options: Any) -> Optional[desktop.Window]:
    """The window of the desktop, where there is one; the address on the terminal in any case."""
    window = None
    if desktop.available() and not options.no_window:
        window = desktop.Window(website.local_address)
        if window.process is None:
            rospy.logwarn("gzclient: no browser was found to show the window with; install chromium")
    print(f"gzclient: the simulator's window is at {website.address}", flush=True)
    return window


def _wait_for_master() -> None:
    warned = False
    while not rosgraph.is_master_online():
        if not warned:
            print(f"gzclient: no ROS master at {rosgraph.get_master_uri()}; waiting for one (start the simulator)",
                  file=sys.stderr, flush=True)
            warned = True
        time.sleep(0.5)
