"""The options of gzclient."""

from __future__ import annotations

import argparse

from gazebo_ros.commands.command_line import VERSION
from ode_sim_viewer.website import DEFAULT_PORT


def parse(arguments: list[str]) -> argparse.Namespace:
    """Options as gzclient of Gazebo 11 takes them, and those of the page; unknown ones are kept in ``unknown``.

    :param arguments: without the program name and without ROS remappings
    """
    parser = argparse.ArgumentParser(
        prog="gzclient",
        usage="gzclient [options]",
        allow_abbrev=False,
        description="Show the world of a running simulator: a window on a desktop, and a page for any browser.",
    )
    parser.add_argument("-v", "--version", action="version", version=VERSION)
    parser.add_argument("--verbose", action="store_true", help="say more on the terminal")
    parser.add_argument("-g", "--gui-plugin", action="append", default=[], metavar="LIBRARY", help="accepted")
    parser.add_argument("--port", type=int, default=DEFAULT_PORT, help=f"of the page; the next free one from here ({DEFAULT_PORT})")
    parser.add_argument("--listen", action="store_true", help="let other machines open the page; the token in its address is a password")
    parser.add_argument("--no-window", action="store_true", help="only serve the page, also where there is a desktop")
    parser.add_argument("--shadows", action="store_true", help="also where the graphics are computed by the processor")
    options, unknown = parser.parse_known_args(arguments)
    options.unknown = unknown
    if not 0 <= options.port < 65536:
        parser.error(f"--port {options.port}: a port is a number up to 65535")
    return options


def remarks(options: argparse.Namespace) -> list[str]:
    """What of the options has no effect, one line each."""
    lines = [
        f"-g {library}: plugins of the window are compiled for Gazebo's own; left out"
        for library in options.gui_plugin
        if "ros_paths" not in library
    ]
    return lines + [f"option '{option}' is unknown and left out" for option in options.unknown]
