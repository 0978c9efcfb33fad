"""Plugins of Gazebo that others compiled: finding their libraries, and what their code sees of the world.

The C++ half is the package gazebo_cpp: it mirrors the models of the world and calls plugins within the step, without Python's lock.
"""

from __future__ import annotations

import os
import threading
import xml.etree.ElementTree as ET
from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import replace
from typing import Any

import ode_sim._core
import rospy
from ode_sim.description import DescriptionError, read_model, sdf_writer
from ode_sim.description import model as d
from plugin_loader import PluginError, exported_values

from gazebo_ros.plugin import ModelPlugin, SensorPlugin, WorldPlugin
from gazebo_ros.sensors import Sensor

try:
    from gazebo_cpp import _core
except ImportError:  # built without compiled plugins, or on a system that lacks what they need
    _core = None  # type: ignore[assignment]  # the usual form for a module that may not be there

_OF_ANOTHER_CORE = (
    ""
    if _core is None or _core.layout == ode_sim._core.layout
    else ("gazebo_cpp was not built with this ode_sim and would read its world wrongly; build both: catkin build ode_sim gazebo_cpp")
)
_bridge: Bridge | None = None
_searched: list[str] | None = None


def folders() -> list[str]:
    """Where libraries of plugins are looked for, in order."""
    global _searched
    if _searched is None:
        paths = os.environ.get("GAZEBO_PLUGIN_PATH", "").split(":")
        paths += exported_values("gazebo_ros", "plugin_path")
        paths += [os.path.join(prefix, "lib") for prefix in os.environ.get("CMAKE_PREFIX_PATH", "").split(":") if prefix]
        paths += os.environ.get("LD_LIBRARY_PATH", "").split(":")
        _searched = list(dict.fromkeys(path for path in paths if path))
    return _searched


def find_library(filename: str) -> str | None:
    """The file of the library ``filename`` of a ``<plugin>``, with or without ``lib`` and ``.so``; None if there is none or none can be
    loaded.
    """
    name = filename.strip()
    if _core is None or not name:
        return None
    folder, base = os.path.split(name)
    names = [base] if base.endswith(".so") else [base + ".so", f"lib{base}.so", base]
    if names[0].endswith(".so") and not base.startswith("lib"):
        names.append("lib" + names[0])
    absolute = os.path.isabs(folder)  # of another machine, maybe: Gazebo's own folder, a workspace that has moved
    for place in [folder, *folders()] if absolute else [os.path.join(path, folder) for path in folders()]:
        for each in names:
            path = os.path.join(place, each)
            if os.path.isfile(path):
                return path
    return None


def resolve(library: str, plugin: d.Plugin, label: str) -> Callable[[], CompiledPlugin]:
    """What makes the plugin. Takes its time: not for the physics thread.

    :param label: for messages
    :raises PluginError: the library cannot be loaded
    """
    import compiled_plugins

    _core.share_tf()
    problem = compiled_plugins.why_not(library)
    if problem:
        raise PluginError(problem)
    clock = compiled_plugins.start_roscpp()
    return lambda: CompiledPlugin(library, plugin, label, clock)


class CompiledPlugin(ModelPlugin, SensorPlugin, WorldPlugin):
    """A plugin in C++.

    :param library: path of its shared library
    :param plugin: ``<plugin>``
    :param label: for messages
    :param clock: the clock of roscpp is to be moved by the steps
    """

    def __init__(self, library: str, plugin: d.Plugin, label: str, clock: bool):
        self._clock = clock
        self._library, self._plugin, self._label = library, plugin, label
        self._core: Any = None

    def load(self, server, *subject_and_sdf) -> None:
        subject = subject_and_sdf[0] if len(subject_and_sdf) > 1 else None
        bridge(server, self._clock)
        text = sdf_writer.element_text(self._plugin.element)
        try:
            self._core = _core.Plugin(self._library, self._plugin.filename, self._plugin.name, self._label)
            if isinstance(subject, Sensor):
                name = f"{server.description.name}::{subject.scoped_name}"
                self._core.load_sensor(name, _index(self._plugin, subject.description.plugins), text)
            elif subject is None:
                self._core.load_world(_index(self._plugin, server.description.plugins), text)
            else:
                self._core.load_model(subject.name, _index(self._plugin, subject.description.plugins), text)
        except RuntimeError as error:
            self.shutdown()
            raise PluginError(str(error)) from error

    def load_system(self, server, arguments: list[str]) -> None:
        """Load it as a system plugin of ``server``, with ``arguments``, the words of the command line.

        :raises PluginError: one line
        """
        try:
            self._core = _core.Plugin(self._library, self._plugin.filename, self._plugin.name, self._label)
            self._core.load_system(arguments)
        except RuntimeError as error:
            self.shutdown()
            raise PluginError(str(error)) from error
        server.starting.connect(lambda: bridge(server, self._clock))
        server.went_back.connect(lambda: _told(self._core.reset))

    def reset(self) -> None:
        _told(self._core.reset)

    def shutdown(self) -> None:
        core, self._core = self._core, None
        if core is not None:
            _told(core.destroy)


def load_system(server, library: str, arguments: list[str]) -> None:
    """A system plugin of the command line (``-s``), before the world's own plugins. One line where it cannot be loaded.

    :param server: that it is loaded into
    :param library: its file, or the name of one that is looked for
    :param arguments: the words of the command line
    """
    label = f"system plugin {os.path.basename(library)}"
    path = find_library(library)
    if path is None:
        rospy.logwarn("%s is not found and is left out; looked for in %s", label, ", ".join(folders()) or "no folder")
        return
    try:
        plugin = resolve(path, d.Plugin(label, library, ET.Element("plugin")), label)()
        plugin.load_system(server, arguments)
    except PluginError as error:
        rospy.logerr("%s: %s", label, error)


def _told(f: Callable[[], None]) -> None:
    try:
        f()
    except RuntimeError as error:
        raise PluginError(str(error)) from error


def _index(plugin: d.Plugin, plugins: tuple[d.Plugin, ...]) -> int:
    """Which of the ``<plugin>`` elements it is; beyond their number where it is none of them."""
    return next((i for i, each in enumerate(plugins) if each is plugin), len(plugins))


def bridge(server, clock: bool) -> Bridge:
    """That of the process, made when the first plugin needs it. Physics thread.

    :param server: a Server, or a plugin's view of it
    :param clock: the clock of roscpp is to be moved by the steps
    """
    global _bridge
    if _OF_ANOTHER_CORE:
        raise PluginError(_OF_ANOTHER_CORE)
    if _bridge is None:
        _bridge = Bridge(getattr(server, "_server", server))
    if clock:
        _core.follow_clock()
    return _bridge


def offer_transport(server) -> None:
    """Let other processes reach Gazebo's own topics (``gz topic``, programs that are its clients) of ``server``, at GAZEBO_MASTER_URI.

    The mirror of the world, which publishes them, is made when the first of them asks.
    """
    if _core is None:
        return
    if _OF_ANOTHER_CORE:
        rospy.logwarn("Gazebo's transport: %s", _OF_ANOTHER_CORE)
        return
    problem = _core.serve(server.description.name, lambda: server._calls.put((lambda: bridge(server, False), Future())))
    if problem:  # with the port that all have, a second simulator of a machine is nothing that anybody need read of
        log = rospy.logwarn if os.environ.get("GAZEBO_MASTER_URI") else rospy.logdebug
        log("Gazebo's transport: %s", problem)


class Bridge:
    """Keeps the mirror of the world up to date, and does for C++ what only the server can do."""

    def __init__(self, server):
        self._server = server
        world, description = server.world, server.description
        _core.set_reporter(lambda error, line: (rospy.logerr if error else rospy.logwarn)("%s", line))
        _core.set_verbose(rospy.get_param("/gazebo/verbose", False) is True)
        _core.set_host(self._insert, self._remove, self._order, self._step, self._parameter, self._plugin)
        _core.start(
            world.core.address,
            description.name,
            sdf_writer.world_text(description),
            world.physics.real_time_update_rate,
            description.magnetic_field,
            description.spherical_coordinates,
        )
        from gazebo_ros.compiled_cameras import CompiledCameras

        CompiledCameras(server)
        for model in world.models.values():
            self._add(model)
        world.on_spawn.append(self._add)
        world.on_remove.append(lambda model: _core.remove_model(model.name))
        server.stepped.connect(lambda: _core.set_paused(server.paused))
        server.went_back.connect(lambda: self._went_back(world))
        _core.set_paused(server.paused)
        server.between_steps = _core.WorldLock()  # threads of plugins take it to change the world
        _core.ready()

    # -- from the server to C++

    @staticmethod
    def _add(model) -> None:
        links = [
            (
                link.name,
                link.core.id,
                [_collision(c) for c in link.collisions.values()],
                [sensor.name for sensor in link.description.sensors],
            )
            for link in model.links.values()
        ]
        joints = [(joint.name, joint.description.type, joint.core.id) for joint in model.joints.values()]
        pose, actor = model.initial_pose, model.world.actors.get(model.name)
        _core.add_model(
            model.name,
            sdf_writer.model_text(model.description),
            model.core.id,
            (*pose.p, *pose.q),
            links,
            joints,
            None if actor is None else list(actor.lengths.items()),
        )
        if actor is not None:
            actor.direct(Director(model.name))

    @staticmethod
    def _went_back(world) -> None:
        _core.was_reset(True)
        if world.iterations == 0:  # not the clock alone
            _core.was_reset(False)

    # -- from C++ to the server; any thread, so that all is done between two steps

    def _later(self, f: Callable[[], Any], what: str) -> None:
        def attempt() -> None:
            try:
                f()
            except (ValueError, KeyError, DescriptionError) as error:
                rospy.logerr("%s, asked for by a compiled plugin: %s", what, str(error).strip("'\""))

        self._server._calls.put((attempt, Future()))

    def _insert(self, text: str, pose: list[float]) -> None:
        """:param pose: x y z qx qy qz qw instead of that of the text, or nothing."""
        threading.Thread(target=self._read_and_spawn, args=(text, pose), name="insert model", daemon=True).start()

    def _read_and_spawn(self, text: str, pose: list[float]) -> None:
        """Meshes and plugins take their time; the world goes on."""
        server = self._server
        try:
            model, problems = read_model(text, finder=server.finder)
        except DescriptionError as error:
            rospy.logerr("inserting a model, asked for by a compiled plugin: %s", error)
            return
        for problem in problems:
            rospy.logwarn("model %s: %s", model.name, problem)
        if pose:
            x, y, z, *q = pose
            model = replace(model, pose=d.Pose((x, y, z), (q[0], q[1], q[2], q[3])))
        resolved = server.plugins.resolve(model)
        self._later(lambda: server.spawn(model, resolved), f"inserting model '{model.name}'")

    def _plugin(self, filename: str, name: str, text: str) -> None:
        element = ET.fromstring(text) if text else ET.Element("plugin", name=name, filename=filename)
        plugin = d.Plugin(name, filename, element)
        threading.Thread(target=self._resolve_and_start, args=(plugin,), name="load plugin", daemon=True).start()

    def _resolve_and_start(self, plugin: d.Plugin) -> None:
        resolved = self._server.plugins.resolve_of_world(plugin)
        if resolved is not None:
            self._later(lambda: self._server.plugins.start_of_world(resolved), f"loading plugin {plugin.name}")

    def _remove(self, name: str) -> None:
        self._later(lambda: self._server.remove(name), f"removing model '{name}'")

    def _order(self, what: str) -> None:
        server = self._server
        orders = {
            "pause": server.pause,
            "unpause": server.unpause,
            "reset": server.reset_simulation,
            "reset_time": server.reset_time,
            "reset_poses": server.reset_world,
        }
        _, _, time_ns = what.partition("set_time ")
        self._later((lambda: server.set_time(int(time_ns))) if time_ns else orders[what], what)

    def _step(self, steps: int) -> None:
        self._later(lambda: self._server.request_steps(steps), f"{steps} steps")

    def _parameter(self, name: str, value: float) -> None:
        physics = self._server.world.physics
        whole = isinstance(getattr(physics, name), int)
        self._later(lambda: setattr(physics, name, int(value) if whole else value), f"{name} = {value:g}")


class Director:
    """Plugins in C++ direct an actor: the simulator asks what they want and tells what it plays."""

    def __init__(self, name: str):
        self._name = name

    def wanted(self) -> tuple[str | None, float, bool, int, bool]:
        """Animation in place of the script, script time s, whether it plays, since when ns, whether it collides."""
        return _core.actor_wanted(self._name)

    def plays(self, script_time: float, active: bool, started_ns: int, anew: bool) -> None:
        """Tell what the simulator plays.

        :param script_time: s, of the actor's script
        :param active: whether the script runs
        :param started_ns: simulated ns at which it started
        :param anew: it has just started
        """
        _core.actor_plays(self._name, script_time, active, started_ns, anew)


def _collision(handle) -> tuple[str, int, str, list[float], str, float]:
    geometry = handle.description.geometry
    kind = type(geometry).__name__.lower()
    numbers = {
        "box": lambda g: g.size,
        "sphere": lambda g: (g.radius,),
        "cylinder": lambda g: (g.radius, g.length),
        "capsule": lambda g: (g.radius, g.length),
        "plane": lambda g: (*g.normal, *g.size),
        "mesh": lambda g: g.scale,
        "polyline": lambda g: (g.height, *(number for point in g.points for number in point)),
        "heightmap": lambda g: (*g.size, *g.pos, g.sampling),
    }
    return (
        handle.name,
        handle.core.id,
        kind,
        list(numbers.get(kind, lambda g: ())(geometry)),
        getattr(geometry, "uri", ""),
        handle.laser_retro,
    )
