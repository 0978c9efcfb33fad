"""Debian's roslaunch and rostest without what they wait for before their first node.

Import this module before ``roslaunch``, then call `prepare()`. Nothing that a launch file sees is different: the same packages are
found, in the same order, and the same values come back; they are read once, and in this process. A workspace whose packages
come and go while it runs must not use it.
"""

from __future__ import annotations

import contextlib
import functools
import io
import os
import runpy
import shlex
import sys
from typing import Any, NamedTuple
from xml.etree import ElementTree

import rospkg.rospack
import rospkg.rosversion
from catkin_pkg.packages import DEFAULT_IGNORE_MARKERS, find_packages

from node_signals.display import next_on_path


def _distutils_of_python() -> None:
    """rosclean asks distutils for the path of ``du``. Debian's setuptools puts its own distutils first, half a second of imports."""
    hack = sys.modules.get("_distutils_hack")
    if hack is not None and sys.version_info < (3, 12):  # later Pythons have no distutils but that of setuptools
        hack.remove_shim()


class _Named(NamedTuple):
    """What catkin's search wants to know of a package."""

    name: str


@functools.cache
def packages_below(folder: str) -> dict[str, object]:
    """`catkin_pkg.packages.find_packages` of ``folder``: {path below it: something with a ``name``}.

    catkin tools lists each package of a workspace as a folder of its own, and a launch file asks for all of them at each
    ``$(find package)/file`` and at each node. A folder that is a package is asked for its name alone, and once.
    """
    with contextlib.suppress(OSError, ElementTree.ParseError):
        name = ElementTree.parse(os.path.join(folder, "package.xml")).findtext("name")
        if name and not any(os.path.exists(os.path.join(folder, marker)) for marker in DEFAULT_IGNORE_MARKERS):
            return {os.curdir: _Named(name.strip())}
    return find_packages(folder)


def _remembering(list_by_path):
    """rospkg's search of one folder for packages; each ``RosPack()`` of roslaunch begins it anew."""
    known: dict[tuple, tuple] = {}

    def listed(manifest_name, path, cache):
        if (manifest_name, path) not in known:
            places: dict[str, str] = {}
            known[manifest_name, path] = list_by_path(manifest_name, path, places), places
        names, places = known[manifest_name, path]
        if cache is not None:
            cache.update(places)
        return list(names)

    return listed


def version_asked_for(command: str | None) -> str | None:
    """What ``rosversion ...`` prints, as the master's parameters want it; None if ``command`` is another one or fails."""
    words = shlex.split(command or "")
    if not words or words[0] != "rosversion":
        return None
    printed, arguments = io.StringIO(), sys.argv
    try:
        sys.argv = words
        with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(io.StringIO()):
            rospkg.rosversion.main()
    except SystemExit as end:
        if end.code:
            return None
    finally:
        sys.argv = arguments
    return printed.getvalue()


def _answering_versions(param_value, convert_value):
    def read(loader, verbose, name, ptype, value, textfile, binfile, command):
        version = version_asked_for(command) if value is None and textfile is None and binfile is None else None
        if version is not None:
            return convert_value(version, ptype)  # with the end of its line, as upstream
        return param_value(loader, verbose, name, ptype, value, textfile, binfile, command)

    return read


def _configuration_of_logs() -> None:
    """For all nodes that are started from here: rospy looks for this file among all packages although it stands before them."""
    if os.environ.get("ROS_PYTHON_LOG_CONFIG_FILE"):
        return
    for folder in (os.path.join(rospkg.get_ros_home(), "config"), rospkg.get_etc_ros_dir()):
        for ending in ("conf", "yaml"):
            file = os.path.join(folder, f"python_logging.{ending}")
            if os.path.isfile(file):
                os.environ["ROS_PYTHON_LOG_CONFIG_FILE"] = file
                return


def prepare() -> None:
    """Once, in a program that goes on as roslaunch, rostest or the like."""
    _distutils_of_python()
    _configuration_of_logs()
    import roslaunch.loader

    _searching_once()
    rospkg.rospack.list_by_path = _remembering(rospkg.rospack.list_by_path)
    roslaunch.loader.Loader.param_value = _answering_versions(roslaunch.loader.Loader.param_value, roslaunch.loader.convert_value)


def _searching_once() -> Any:
    """catkin's module that searches the workspaces, whose search for packages is `packages_below` from here on."""
    import catkin.find_in_workspaces  # noqa: F401  the package's attribute of that name is a function in some releases

    module: Any = sys.modules["catkin.find_in_workspaces"]
    module.find_packages = packages_below
    return module


def find_in_workspaces(*arguments, **named) -> list[str]:
    """catkin's function of that name: folders or files of a package in the workspaces."""
    return _searching_once().find_in_workspaces(*arguments, **named)


def become(command: str) -> None:
    """Run the Python program called as ``command`` which PATH would give without this package's: Debian's, in this process."""
    runpy.run_path(next_on_path(command), run_name="__main__")
