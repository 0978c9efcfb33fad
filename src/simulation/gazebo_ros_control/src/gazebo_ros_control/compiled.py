"""Simulated robot hardware in C++: classes that packages export for pluginlib."""

from __future__ import annotations

import os
from typing import Any

from gazebo_ros import compiled
from plugin_loader import PluginClass, PluginError

from .robot_hw_sim import RobotHWSim


class CompiledSimClass:
    """What makes hardware of a C++ class.

    :raises PluginError: it cannot be loaded
    """

    def __init__(self, plugin: PluginClass):
        what = f"'{plugin.name}' of package {plugin.package}"
        try:
            import compiled_plugins

            from . import compiled_sim
        except ImportError as error:  # built without compiled plugins, or on a system that lacks what they need
            raise PluginError(f"{what} is compiled C++, and gazebo_ros_control was built without what that needs ({error})") from error
        base = "gazebo_ros_control::RobotHWSim"
        if plugin.base != base:
            raise PluginError(f'{what} is no simulated hardware: {plugin.file} gives it base_class_type="{plugin.base}", that has {base}')
        library = compiled.find_library(os.path.basename(plugin.path))
        if library is None:
            raise PluginError(
                f"{what}: its library {os.path.basename(plugin.path)}.so is not found in "
                f"{', '.join(compiled.folders())}; is the package built, and was its workspace sourced here?"
            )
        problem = compiled_plugins.why_not(library)
        if problem:
            raise PluginError(f"{what}: {problem}")
        self._library, self._type = library, plugin.type
        self._start, self._make = compiled_plugins.start_roscpp, compiled_sim.make
        self.label = f"{plugin.type} ({library})"

    def __call__(self, server: Any) -> RobotHWSim:
        """:param server: the simulator's, or a plugin's view of it"""
        clock = self._start()
        server.call(lambda: compiled.bridge(server, clock))  # what it sees of the world
        return self._make(self._library, self._type, f"robot hardware {self.label}", clock)
