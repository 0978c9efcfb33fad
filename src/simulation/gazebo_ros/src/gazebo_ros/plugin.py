"""Base classes of simulator plugins.

A plugin is found by the library file name that URDF and SDF files carry; a package exports it with ::

    <export><gazebo_ros plugin="${prefix}/gazebo_plugins.xml"/></export>

    <library path="src">
      <class name="libmy_plugin.so" type="my_pkg.my_module.MyPlugin" base_class_type="gazebo_ros.ModelPlugin"/>
    </library>

``load`` runs in the physics thread, once, between two steps. It connects what it needs: ``server.before_step(f)`` and
``server.after_step(f)`` call ``f()`` in every step (the server disconnects them when the model is deleted), and ROS
publishers, subscribers and services are made as in any node. ROS callbacks run in other threads: they store a value, or
use ``server.call(f)``. Raise :class:`PluginError` with one line for the user when a parameter is wrong: the plugin
stays inactive, everything else goes on.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from plugin_loader import PluginError

if TYPE_CHECKING:  # a plugin's own annotations may name them, too: from gazebo_ros.protocols import Server
    from ode_sim.handles import ModelHandle

    from gazebo_ros.protocols import Sensor, Server
    from gazebo_ros.sdf_element import SdfElement

__all__ = ["ModelPlugin", "PluginError", "SensorPlugin", "WorldPlugin"]


class _Plugin:
    def reset(self) -> None:
        """The simulation was reset (``reset_world``, ``reset_simulation``); called between two steps."""

    def shutdown(self) -> None:
        """The model is deleted or the server ends: unregister publishers, services and subscribers.

        Callbacks given to ``server.before_step`` and ``after_step`` are already disconnected.
        """


class ModelPlugin(_Plugin):
    def load(self, server: Server, model: ModelHandle, sdf: SdfElement) -> None:
        """Start.

        :param server: :class:`gazebo_ros.protocols.Server`
        :param model: ``ode_sim.handles.ModelHandle`` the plugin belongs to
        :param sdf: :class:`gazebo_ros.SdfElement` of ``<plugin>``
        """
        raise NotImplementedError


class SensorPlugin(_Plugin):
    def load(self, server: Server, sensor: Sensor, sdf: SdfElement) -> None:
        """Start.

        :param server: :class:`gazebo_ros.protocols.Server`
        :param sensor: :class:`gazebo_ros.protocols.Sensor` the plugin belongs to
        :param sdf: :class:`gazebo_ros.SdfElement` of ``<plugin>``
        """
        raise NotImplementedError


class WorldPlugin(_Plugin):
    def load(self, server: Server, sdf: SdfElement) -> None:
        """Start.

        :param server: :class:`gazebo_ros.protocols.Server`
        :param sdf: :class:`gazebo_ros.SdfElement` of ``<plugin>``
        """
        raise NotImplementedError
