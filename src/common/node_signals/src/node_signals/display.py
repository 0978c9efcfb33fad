"""Windows on a machine without a screen: one line that says what to do, where Qt prints a page and dumps core.

``rosrun`` and ``rviz`` of this package look first whether a window is asked for, and run what comes next on PATH; ``rosrun`` gives
nodes a ``python``, puts a working program in the place of one that Debian's cannot be, and finds programs in less time than Debian's.
"""

from __future__ import annotations

import ctypes
import os
import sys
from collections.abc import MutableMapping

from node_signals import programs, rviz_start
from node_signals.interpreter import supply_python

#: Programs that open a window and do not look for a display themselves, by package. rqt's and turtlesim's do.
WINDOWS = {
    "rviz": {"rviz"},
    "joint_state_publisher_gui": {"joint_state_publisher_gui"},
    "image_view": {"image_view", "stereo_view", "disparity_view"},
}
_REMEDY = (
    "start it on a desktop, through ssh -X, or with scripts/offscreen COMMAND (rosrun rviz_offscreen offscreen COMMAND) "
    "for a display that nobody sees"
)


def choose_platform(environment: MutableMapping[str, str]) -> None:
    """Qt on X11, by ``environment``, where a Wayland session has an X server, which RViz's OpenGL needs and rqt's plugins were written
    for.
    """
    if environment.get("WAYLAND_DISPLAY") and environment.get("DISPLAY") and not environment.get("QT_QPA_PLATFORM"):
        environment["QT_QPA_PLATFORM"] = "xcb"


def missing_display(x11_only: bool = False) -> str | None:
    """
    One line saying what is missing and what to do, or None when a window can be shown.

    :param x11_only: the window draws through X11, as RViz's does; Wayland alone is not enough
    """
    platform = os.environ.get("QT_QPA_PLATFORM", "").split(":")[0].split(";")[0]
    if platform not in ("", "xcb", "wayland", "wayland-egl"):
        return None
    wayland = platform != "xcb" and bool(os.environ.get("WAYLAND_DISPLAY"))
    if wayland and not x11_only:
        return None
    name = os.environ.get("DISPLAY")
    if not name:
        return (
            "this Wayland session has no X server, which it draws through: install Debian's package xwayland and log in again"
            if wayland
            else f"no display to open a window on (DISPLAY is not set): {_REMEDY}"
        )
    try:
        x11 = ctypes.CDLL("libX11.so.6")
    except OSError:
        return None
    x11.XOpenDisplay.restype = ctypes.c_void_p
    x11.XCloseDisplay.argtypes = [ctypes.c_void_p]
    connection = x11.XOpenDisplay(None)
    if not connection:
        return f"the display {name} (DISPLAY) cannot be opened: {_REMEDY}"
    x11.XCloseDisplay(connection)
    return None


def asked_for(words: list[str]) -> str | None:
    """The window that a command, ``words``, opens: ``rviz ...`` or ``rosrun [--prefix COMMAND] [--debug] PACKAGE PROGRAM ...``."""
    if os.path.basename(words[0]) != "rosrun":
        package = program = os.path.basename(words[0])
    else:
        at = _place_of_package(words)
        package, program = (words[at:] + ["", ""])[:2]
    return program if program in WINDOWS.get(package, ()) else None


def _place_of_package(words: list[str]) -> int:
    at = 1
    while at < len(words) and words[at].startswith("-"):
        at += 2 if words[at] in ("-p", "--prefix") else 1
    return at


def in_working_order(words: list[str]) -> list[str]:
    """``words``, a command; ``rosrun tf view_frames``, which Debian's tf ends with a trace, as the program of tf2 that draws the same
    frames.pdf.
    """
    at = _place_of_package(words)
    if os.path.basename(words[0]) == "rosrun" and words[at:] == ["tf", "view_frames"]:
        return words[:at] + ["tf2_tools", "view_frames.py"]
    return words


def next_on_path(command: str) -> str:
    """The program called as ``command`` that PATH would give without this one: another workspace's, or Debian's."""
    name, own = os.path.basename(command), os.path.realpath(os.path.dirname(command))
    found = [folder for folder in os.get_exec_path() if os.access(os.path.join(folder, name), os.X_OK)]
    places = [os.path.realpath(folder) for folder in found]
    if own in places:  # what stands before has handed over to this one
        found = [folder for folder, place in list(zip(found, places))[places.index(own) :] if place != own]
    return os.path.join(found[0] if found else "/usr/bin", name)


def main() -> None:
    """Become the program that was asked for, unless it could not show its window."""
    window = asked_for(sys.argv)
    problem = missing_display(x11_only=window == "rviz") if window else None
    if problem:
        sys.exit(f"{window}: {problem}")
    choose_platform(os.environ)
    supply_python(os.environ)
    program, words = next_on_path(sys.argv[0]), in_working_order(sys.argv)
    if program == programs.DEBIANS:
        programs.run(words)
    try:
        if os.path.basename(words[0]) == "rviz":
            rviz_start.run([program, *words[1:]])
        os.execv(program, [program, *words[1:]])
    except OSError as error:
        sys.exit(f"{program}: {error.strerror}; scripts/setup installs it")
