"""Simulated robot hardware in C++: classes that packages export for pluginlib."""
from __future__ import annotations

import os
from typing import Any, List, Optional

import compiled_plugins
from controller_interface import NodeHandle
from gazebo_ros import compiled
from hardware_interface.compiled import CompiledRobotHW, Robot
from plugin_loader import PluginClass, PluginError
from transmission_interface import TransmissionInfo

try:
    from . import _compiled
except ImportError:  # built without compiled plugins, or on a system that lacks what they need
    _compiled = None  # type: ignore[assignment]


class CompiledSimClass:
    """What makes hardware of a C++ class.

    :raises PluginError: it cannot be loaded
    """

    def __init__(self, plugin: PluginClass):
        what = f"'{plugin.name}' of package {plugin.package}"
        if _compiled is None:
            raise PluginError(f"{what} is compiled C++; gazebo_ros_control was built without it")
        base = "gazebo_ros_control::RobotHWSim"
        if plugin.base != base:
            raise PluginError(f"{what} is no simulated hardware: {plugin.file} gives it base_class_type=\"{plugin.base}\", that has {base}")
        library = compiled.find_library(os.path.basename(plugin.path))
        if library is None:
            raise PluginError(f"{what}: its library {os.path.basename(plugin.path)}.so is not found in "
                              f"{', '.join(compiled.folders())}; is the package built, and was its workspace sourced here?")
        problem = compiled_plugins.why_not(library)
        if problem:
            raise PluginError(f"{what}: {problem}")
        self._library, self._type = library, plugin.type
        self.label = f"{plugin.type} ({library})"

    def __call__(self, server: Any) -> "CompiledRobotHWSim":
        """:param server: the simulator's, or a plugin's view of it"""
        clock = compiled_plugins.start_roscpp()
        server.call(lambda: compiled.bridge(server, clock))  # what it sees of the world
        try:
            return CompiledRobotHWSim(_compiled.Sim(self._library, self._type, f"robot hardware {self.label}", clock))
        except RuntimeError as error:
            raise PluginError(str(error)) from error


class CompiledRobotHWSim(CompiledRobotHW):
    """Hardware in C++, as a :class:`RobotHWSim`; what it throws is a PluginError, which ends the control of its robot."""

    def __init__(self, sim: Any):
        super().__init__(Robot(sim.address, sim))
        self._sim = sim

    def init_sim(self, robot_namespace: str, model_nh: NodeHandle, model: Any, urdf: Optional[str],
                 transmissions: List[TransmissionInfo]) -> bool:
        """See :meth:`RobotHWSim.init_sim`; it reads the transmissions itself."""
        try:
            return self._sim.init(robot_namespace, model.name, urdf or "")
        except RuntimeError as error:
            raise PluginError(str(error)) from error

    def read_sim(self, time: float, period: float) -> None:
        _told(self._sim.read, time, period)

    def write_sim(self, time: float, period: float) -> None:
        _told(self._sim.write, time, period)

    def e_stop_active(self, active: bool) -> None:
        _told(self._sim.stop, active)

    def reset_sim(self) -> None:
        """The base class of C++ is told nothing of it."""


def _told(f: Any, *arguments: Any) -> None:
    try:
        f(*arguments)
    except RuntimeError as error:
        raise PluginError(str(error)) from error
