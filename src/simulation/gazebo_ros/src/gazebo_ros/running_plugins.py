"""The plugins and sensors of one world: imported, started, reset and ended."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import Any

from ode_sim.description import model as d
from ode_sim.handles import ModelHandle

from gazebo_ros import protocols
from gazebo_ros.plugin import ModelPlugin, PluginError, SensorPlugin, WorldPlugin
from gazebo_ros.plugin_host import PluginHost, PluginInstance, ResolvedPlugin, plugin_sdf
from gazebo_ros.sensors import Sensor


class ResolvedModel:
    """Plugin classes of a model that is about to be spawned, imported outside the physics thread."""

    def __init__(self, model: d.Model, host: PluginHost):
        where = f"model {model.name}"
        self.plugins = [host.resolve(plugin, where) for plugin in model.plugins]
        self.sensor_plugins = {
            (type(part), part.name, sensor.name): [host.resolve(plugin, where) for plugin in sensor.plugins]
            for part in model.parts
            for sensor in part.sensors
        }


@dataclass
class _OfModel:  # in load order
    sensors: list[Sensor] = field(default_factory=list)
    plugins: list[PluginInstance] = field(default_factory=list)


class RunningPlugins:
    """All but :meth:`resolve` and :meth:`resolve_of_world` is the physics thread's.

    :param world: its name, for messages
    :param view: gives the server as a plugin sees it
    :param disconnect: ends what a plugin had called in steps
    """

    def __init__(
        self, host: PluginHost, world: str, view: Callable[[PluginInstance], protocols.Server], disconnect: Callable[[PluginInstance], None]
    ):
        self._host, self._world, self._view, self._disconnect = host, world, view, disconnect
        self._of_world: list[PluginInstance] = []
        self._of_models: dict[str, _OfModel] = {}
        self.sensors: tuple[Sensor, ...] = ()  # all that have a plugin, in load order

    def resolve(self, model: d.Model) -> ResolvedModel:
        """Import the plugin classes of ``model``. Any thread but the physics one: imports may take long."""
        return ResolvedModel(model, self._host)

    def resolve_of_world(self, plugin: d.Plugin) -> ResolvedPlugin | None:
        """What ``plugin`` of the world means, ready to be started; None, with an ERROR line, where nothing can be."""
        return self._host.resolve(plugin, f"world {self._world}")

    def load(self, plugins: Iterable[d.Plugin], models: Iterable[ModelHandle]) -> None:
        """Import and start ``plugins`` of the world, then those of ``models``."""
        of_world = [self.resolve_of_world(plugin) for plugin in plugins]
        of_models = [(handle, self.resolve(handle.description)) for handle in models]
        for plugin in filter(None, of_world):
            self.start_of_world(plugin)
        for handle, resolved in of_models:
            self.start(handle, resolved)

    def start_of_world(self, plugin: ResolvedPlugin) -> None:
        self._start(plugin, WorldPlugin, self._of_world)

    def start(self, handle: ModelHandle, resolved: ResolvedModel) -> None:
        """Start those of the model ``handle``, ``resolved`` before.

        Of sensors on links first, then on joints, then its own, in file order, as Gazebo.
        """
        mine = self._of_models[handle.name] = _OfModel()
        for part in handle.parts:
            for description in part.description.sensors:
                plugins = resolved.sensor_plugins.get((type(part.description), part.name, description.name), [])
                sensor = Sensor(description, part, PluginInstance.report)
                for plugin in filter(None, plugins):
                    self._start(plugin, SensorPlugin, mine.plugins, sensor)
                if any(plugins):
                    mine.sensors.append(sensor)
                    self.sensors += (sensor,)
        for plugin in filter(None, resolved.plugins):
            self._start(plugin, ModelPlugin, mine.plugins, handle)

    def _start(
        self, resolved: ResolvedPlugin, base: type[Any], started: list[PluginInstance], *subject: ModelHandle | protocols.Sensor
    ) -> None:
        """Load one plugin; a failure leaves it out with one line.

        :param subject: what the plugin is attached to: a model handle, a Sensor, or nothing for the world
        """
        instance = PluginInstance(resolved)
        if not isinstance(instance.plugin, base):
            instance.report(PluginError(f"is no {base.__name__}: it cannot be used in this place of the file"))
            return
        for thing in subject:
            if isinstance(thing, Sensor):
                thing.owner = instance
        if instance.attempt(instance.plugin.load, self._view(instance), *subject, plugin_sdf(resolved)):
            started.append(instance)
        else:
            self._disconnect(instance)
            for thing in subject:
                if isinstance(thing, Sensor):
                    thing.disconnect_owner(instance)

    def reset(self, *, of_world: bool) -> None:
        """Tell those of models that the world was reset, and those ``of_world``."""
        for instance in (*(self._of_world if of_world else ()), *(each for mine in self._of_models.values() for each in mine.plugins)):
            instance.attempt(instance.plugin.reset)

    def end(self, model: str) -> None:
        """Those of ``model``, which leaves the world."""
        mine = self._of_models.pop(model, None)
        if mine:
            gone = set(map(id, mine.sensors))
            self.sensors = tuple(sensor for sensor in self.sensors if id(sensor) not in gone)
            self._end(mine.plugins)

    def end_all(self) -> None:
        for mine in self._of_models.values():
            self._end(mine.plugins)
        self._end(self._of_world)
        self._of_models.clear()

    def _end(self, instances: list[PluginInstance]) -> None:
        for instance in instances:
            self._disconnect(instance)
            instance.attempt(instance.plugin.shutdown)
