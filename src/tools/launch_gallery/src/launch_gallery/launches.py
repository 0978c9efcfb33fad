"""Which launch files there are, what arguments they declare and what they bring up. Reads files only, starts nothing."""

from __future__ import annotations

import os
import shlex
from dataclasses import dataclass
from xml.etree import ElementTree

import rospkg
from roslaunch import arg_dump, core
from roslaunch.config import load_config_default

from .errors import LaunchError

#: Arguments that would open a window, set only where a launch file declares them: the gallery brings its own RViz.
WINDOWLESS = {"gui": "false", "rviz": "false", "use_rviz": "false", "open_rviz": "false"}

_PASSING = {("gazebo_ros", "spawn_model"), ("gazebo_ros", "spawn_model.py")}
_SILENT = {("gazebo_ros", "gzclient")}  # no node of ROS before somebody looks


#: What roslaunch raises about a file; catkin's RuntimeError: two packages of one name
_UNREADABLE = (core.RLException, rospkg.ResourceNotFound, ElementTree.ParseError, OSError, RuntimeError)


@dataclass(frozen=True)
class Launch:
    """A launch file: ``path``; ``name``, for people; ``words``, as typed after roslaunch."""

    path: str
    name: str
    words: tuple[str, ...]


def find(target: str) -> list[Launch]:
    """Launch files of ``PACKAGE``, the one of ``PACKAGE/FILE``, or the file at a path.

    :raises LaunchError: there is none.
    """
    if os.path.isfile(target):
        return [Launch(os.path.abspath(target), os.path.basename(target), (os.path.abspath(target),))]
    package, _, wanted = target.partition("/")
    try:
        folder = rospkg.RosPack().get_path(package)
    except rospkg.ResourceNotFound:
        raise LaunchError(f"{target}: neither a file nor a package; is its workspace sourced?") from None
    found = []
    for base, folders, files in os.walk(folder):
        folders[:] = sorted(name for name in folders if not name.startswith("."))
        found += [
            Launch(os.path.join(base, name), f"{package}/{name}", (package, name))
            for name in sorted(files)
            if name.endswith(".launch") and wanted in ("", name, os.path.relpath(os.path.join(base, name), folder))
        ]
    if not found:
        raise LaunchError(f"package {package} has no launch file{' ' + wanted if wanted else ''} (folder {folder})")
    return found


def arguments(launch: Launch, given: dict[str, str]) -> dict[str, str]:
    """Values for the arguments that the launch file declares: ``given``, and no windows.

    :raises LaunchError: the file cannot be read, or an argument without default has no value.
    """
    try:
        declared = arg_dump.get_args([launch.path])
        settled = {entry.get("name") for entry in ElementTree.parse(launch.path).getroot().iter("arg") if "value" in entry.attrib}
    except _UNREADABLE as error:
        raise LaunchError(_one_line(error)) from error
    wanted = {**WINDOWLESS, **given}
    # roslaunch says of <arg name="x" value=""/> as well that it has no default
    missing = [name for name, (_, default) in declared.items() if default is None and name not in wanted and name not in settled]
    if missing:
        raise LaunchError(f"needs a value for argument {', '.join(missing)}: add {missing[0]}:=...")
    return {name: value for name, value in wanted.items() if name in declared}


@dataclass(frozen=True)
class Content:
    """What a launch file brings up: names of the nodes that stay, and of the ``passing`` ones, which end when their work is done.

    ``rviz``: path of the RViz set-up of its RViz, also of one that is switched off; '' without one.
    """

    nodes: tuple[str, ...]
    passing: tuple[str, ...]
    rviz: str


def content(launch: Launch, values: dict[str, str]) -> Content:
    """What ``launch`` brings up with ``values``, arguments by name. :raises LaunchError: the launch file cannot be read."""
    switched_on = {name: "true" if name in WINDOWLESS and name != "gui" else value for name, value in values.items()}
    nodes = _load(launch, values)
    passing = {_name(node) for node in nodes if (node.package, node.type) in _PASSING}
    silent = {_name(node) for node in nodes if (node.package, node.type) in _SILENT}
    return Content(
        tuple(sorted({_name(node) for node in nodes} - passing - silent)),
        tuple(sorted(passing)),
        next(filter(None, map(_rviz_config, _load(launch, switched_on))), ""),
    )


def _load(launch: Launch, values: dict[str, str]) -> list:
    typed = [f"{name}:={value}" for name, value in values.items()]
    try:
        return load_config_default([(launch.path, typed)], None, verbose=False, assign_machines=False).nodes
    except _UNREADABLE as error:
        raise LaunchError(_one_line(error)) from error


def _one_line(error: Exception) -> str:
    if isinstance(error, rospkg.ResourceNotFound):  # its text goes on with every folder that was searched
        return f"package {error.args[0]} is not here: is its workspace built and sourced?"
    return " ".join(str(error).split())


def _name(node) -> str:
    return f"{node.namespace.rstrip('/')}/{node.name}"


def _rviz_config(node) -> str:
    words = shlex.split(node.args or "")
    if (node.package, node.type) != ("rviz", "rviz") or not words:
        return ""
    for option, value in zip(words, words[1:]):
        if option in ("-d", "--display-config"):
            return value
    return words[0] if words[0].endswith(".rviz") else ""
