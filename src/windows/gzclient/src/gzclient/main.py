"""gzclient: from the command line to the page and its window.

The port and the window come first. ROS, and what draws the page, are imported when a browser has knocked and starts the page
that it has been given: a gzclient that nobody looks at, as launch files start it, holds a port and nothing else.
"""

from __future__ import annotations

import os
import socket
import sys
import time
from typing import Any
from urllib.parse import urlsplit

import node_signals
from node_signals import orphans, verbose
from ode_sim_viewer.website import Unavailable, Website

from gzclient import command_line, desktop
from gzclient.plots import Plots

_LOOK = 0.25  # wall s between two looks at whether the window has been closed
_MASTER = "http://localhost:11311"


def main(arguments: list[str]) -> int:
    """Exit code: 0 the window was closed or the node ended, 1 it could not be opened."""
    options = command_line.parse([word for word in arguments if ":=" not in word])  # ROS remappings
    _wait_for_master()
    for line in command_line.remarks(options):
        _say(line)
    plots = Plots()
    try:
        website = Website(options.port, options.listen, token=True, links={"Plots and topics": plots.answer})
    except Unavailable as error:
        _say(str(error))
        return 1
    window = _open(website, options)

    def closed() -> bool:
        return window is not None and window.closed

    try:
        while not closed():
            if window is not None and window.process is not None or website.knocked(_LOOK):
                return _serve(website, options, closed)
        return 0
    finally:
        if window is not None:
            window.close()
        website.close()
        plots.close()


def _serve(website: Website, options: Any, closed: Any) -> int:
    import rospy

    orphans.end_with_launch()
    node_signals.init_node("gzclient", anonymous=True, disable_rostime=True, log_level=verbose.level(options.verbose))
    from gzclient.page import make_page

    try:
        page = make_page(website, options.shadows)
    except Unavailable as error:
        rospy.logerr("gzclient: %s", error)
        return 1
    try:
        page.run(lambda: rospy.is_shutdown() or closed())
    finally:
        page.close()
    return 0


def _open(website: Website, options: Any) -> desktop.Window | None:
    """The window of the desktop, where there is one; the address on the terminal in any case."""
    window = None
    if desktop.available() and not options.no_window:
        window = desktop.Window(website.local_address)
        if window.process is None:
            _say("no browser was found to show the window with; install chromium")
    print(f"gzclient: the simulator's window is at {website.address}", flush=True)
    return window


def _say(line: str) -> None:
    print(f"gzclient: {line}", file=sys.stderr, flush=True)


def _wait_for_master() -> None:
    uri = os.environ.get("ROS_MASTER_URI", _MASTER)
    warned = False
    while not _listens(uri):
        if not warned:
            _say(f"no ROS master at {uri}; waiting for one (start the simulator)")
            warned = True
        time.sleep(0.5)


def _listens(uri: str) -> bool:
    """Whether somebody takes connections there; what it is, rospy finds out."""
    try:
        place = urlsplit(uri)
        socket.create_connection((place.hostname or "localhost", place.port or 80), timeout=2.0).close()
        return True
    except (OSError, ValueError):
        return False
