"""Simulated robot hardware in C++, as the plugin and its controllers see it. Imports compiled code."""

from __future__ import annotations

from typing import Any

from controller_interface import NodeHandle
from hardware_interface.compiled import CompiledRobotHW, Robot
from plugin_loader import PluginError
from transmission_interface import TransmissionInfo

from . import _compiled
from .robot_hw_sim import RobotHWSim


def make(library: str, type_name: str, label: str, clock: bool) -> CompiledRobotHWSim:
    """The hardware ``type_name`` of ``library``, a path.

    :param label: for messages
    :param clock: the clock of roscpp is to be moved by the steps
    :raises PluginError: its constructor failed
    """
    try:
        return CompiledRobotHWSim(_compiled.Sim(library, type_name, label, clock))
    except RuntimeError as error:
        raise PluginError(str(error)) from error


class CompiledRobotHWSim(CompiledRobotHW, RobotHWSim):
    """Hardware in C++, as a :class:`RobotHWSim`; what it throws is a PluginError, which ends the control of its robot."""

    def __init__(self, sim: Any):
        super().__init__(Robot(sim.address, sim))
        self._sim = sim

    def init_sim(
        self, robot_namespace: str, model_nh: NodeHandle, model: Any, urdf: str | None, transmissions: list[TransmissionInfo]
    ) -> bool:
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
