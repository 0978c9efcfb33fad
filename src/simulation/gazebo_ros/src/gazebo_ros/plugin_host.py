"""Plugins by library name: finding the class, starting it, and saying in one line what went wrong."""

from __future__ import annotations

import difflib
import os
import traceback
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import rospkg
import rospy
from ode_sim.description import model as d
from plugin_loader import PluginClass, PluginError, find_plugins

from gazebo_ros import compiled
from gazebo_ros.sdf_element import SdfElement


def library_key(filename: str) -> str:
    """What is compared of a library's ``filename``: no directory, no ``lib``, no ``.so``, no blanks.

    >>> library_key(" /opt/gazebo/libgazebo_ros_camera.so ")
    'gazebo_ros_camera'
    """
    name = os.path.basename(filename.strip())
    name = name[:-3] if name.endswith(".so") else name
    return name[3:] if name.startswith("lib") else name


@dataclass(frozen=True)
class ResolvedPlugin:
    """A ``<plugin>`` element with the class that its library name stands for."""

    description: d.Plugin
    cls: Callable[[], Any]
    label: str  # for messages: <plugin name> (<library>) of model <m>


class PluginInstance:
    """A started plugin."""

    def __init__(self, resolved: ResolvedPlugin):
        self.label = resolved.label
        self.plugin = resolved.cls()

    def report(self, error: Exception) -> None:
        """One ERROR line for ``error``; the traceback goes to the log file only."""
        reason = str(error) if isinstance(error, PluginError) else f"{type(error).__name__}: {error}"
        rospy.logerr("%s: %s", self.label, reason)
        rospy.logdebug("%s", "".join(traceback.format_exception(error)))

    def attempt(self, f: Callable[..., Any], *args: Any) -> bool:
        """Call ``f(*args)`` of the plugin; an exception is reported. Returns whether it went well."""
        try:
            f(*args)
        except Exception as error:  # a plugin may raise anything; it must not take the world down
            self.report(error)
            return False
        return True


class PluginHost:
    """The plugin classes that packages export for ``gazebo_ros``.

    :param builtin: library names that the server itself stands for, accepted silently
    """

    def __init__(self, rospack: rospkg.RosPack | None = None, builtin: Sequence[str] = ()):
        found, problems = find_plugins("gazebo_ros", rospack=rospack)
        for line in problems:
            rospy.logwarn("%s", line)
        self._classes: dict[str, PluginClass] = {library_key(name): plugin for name, plugin in found.items()}
        self._libraries = {library_key(name): name for name in sorted(found)}
        self._builtin = {library_key(name) for name in builtin}

    def _unknown(self, filename: str) -> str:
        """Why a library is left out, and the names it may have been meant to be."""
        if not filename:
            return 'left out: it names no library; write filename="libgazebo_ros_....so"'
        if not self._libraries:
            return "left out: no plugins are known; is a workspace with gazebo_plugins sourced?"
        close = [self._libraries[key] for key in difflib.get_close_matches(library_key(filename), self._libraries, n=3, cutoff=0.75)]
        return "not known here and is left out. " + (
            f"Did you mean {' or '.join(close)}?"
            if close
            else f"It is none of the {len(self._libraries)} that packages export (rospack plugins --attrib=plugin gazebo_ros), "
            "nor a library in GAZEBO_PLUGIN_PATH, LD_LIBRARY_PATH or a sourced workspace's lib"
        )

    def resolve(self, plugin: d.Plugin, where: str) -> ResolvedPlugin | None:
        """Import the class of a ``<plugin>``. Unknown or broken ones are one WARN or ERROR line, and None.

        May take long (imports): not for the physics thread.

        :param where: ``model 'arm'`` or ``world 'default'``, for messages
        """
        key = library_key(plugin.filename)
        label = f"plugin {plugin.name} ({plugin.filename or 'no filename'}) of {where}"
        if key in self._builtin:
            return None
        library = compiled.find_library(plugin.filename)
        if library:  # of a workspace on top of this one; a Python class of that name would be ours
            try:
                return ResolvedPlugin(plugin, compiled.resolve(library, plugin, label), label)
            except PluginError as error:
                rospy.logerr("%s: %s", label, error)
        if key not in self._classes:
            if library:
                return None
            rospy.logwarn("%s is %s", label, self._unknown(plugin.filename))
            return None
        try:
            return ResolvedPlugin(plugin, self._classes[key].load(), label)
        except PluginError as error:
            rospy.logerr("%s: %s", label, error)
            return None


def plugin_sdf(resolved: ResolvedPlugin) -> SdfElement:
    """The ``<plugin>`` element of ``resolved``; values that cannot be read are warned about in the plugin's name."""
    return SdfElement(resolved.description.element, lambda line: rospy.logwarn("%s: %s", resolved.label, line))
