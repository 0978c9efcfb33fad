"""A world of this process as a simulation: stepped in a thread of its own, in real time."""

from __future__ import annotations

import queue
import threading
import time
from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import replace
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np
from ode_sim import math3
from ode_sim.description import DescriptionError, Entity
from ode_sim.description import model as d
from ode_sim.description.sdf_writer import world_text
from ode_sim.timeline import Timeline
from ode_sim_rendering.watch import SceneWatch

from ode_sim_viewer.contacts import ContactWatch
from ode_sim_viewer.saving import describe_now
from ode_sim_viewer.simulation import (
    Frame,
    KeptMoment,
    LinkProperties,
    Looks,
    Refused,
    Simulation,
    SurfaceProperties,
    WorldRecord,
    record_world,
)
from ode_sim_viewer.surfaces import paint, set_looks

if TYPE_CHECKING:
    from ode_sim.handles import CollisionHandle, ModelHandle
    from ode_sim.world import World

Answer = TypeVar("Answer")

_FRAME = 1.0 / 60.0  # wall s between two frames
_LATE = 0.1  # s that may be made up for


class LocalSimulation(Simulation):
    """Takes over ``world``: from now on only functions given to :meth:`call` may touch it.

    :param world: :class:`ode_sim.World`
    """

    def __init__(self, world: World, paused: bool = False):
        self._world = world
        self._paused = paused
        self._watch = SceneWatch(world)
        self._calls: queue.SimpleQueue = queue.SimpleQueue()
        self._frame: Frame | None = None
        self._revision = 1
        self._real_time = 0.0
        self._factor = 0.0
        self._commands: dict[str, tuple] = {}
        self._pushes: list = []
        self._ended = False
        self._contacts = ContactWatch(world)
        self._newest_contacts: np.ndarray | None = None  # None: nobody wants them
        self._timeline = Timeline(world)
        world.before_step.append(self._drive)
        world.after_step.append(lambda world: self._timeline.after_step())
        self._thread = threading.Thread(target=self._run, name="physics", daemon=True)
        self._thread.start()

    @property
    def problems(self) -> tuple[str, ...]:
        return tuple(str(problem) for problem in self._world.problems if problem.severity != "note")

    def call(self, f: Callable[[World], Answer]) -> Answer:
        """``f(world)`` between two steps, and its result."""
        future: Future[Answer] = Future()
        self._calls.put((f, future))
        try:
            return future.result()
        except (DescriptionError, ValueError, KeyError) as error:
            raise error if isinstance(error, Refused) else Refused(str(error)) from error

    def close(self) -> None:
        self._ended = True
        self._calls.put((lambda world: None, Future()))
        self._thread.join(2.0)

    # ------------------------------------------------------------------------------------------ the loop

    def _run(self) -> None:
        due = last = time.monotonic()
        sim = self._world.time
        while not self._ended:
            now = time.monotonic()
            if now - last >= _FRAME or self._frame is None:
                self._publish(now - last, self._world.time - sim)
                last, sim = now, self._world.time
            wait = last + _FRAME - now
            if not self._paused:
                rate = self._world.physics.real_time_update_rate
                due = max(due, now - _LATE)
                wait = min(wait, due - now) if rate > 0 else 0.0
                if rate <= 0 or due <= now:
                    self._world.step(1)
                    self._world.messages.clear()
                    due += 1.0 / rate if rate > 0 else 0.0
                    wait = 0.0
            else:
                due = now
            self._answer(wait)

    def _answer(self, wait: float) -> None:
        try:
            f, future = self._calls.get(timeout=wait) if wait > 0.0 else self._calls.get_nowait()
        except queue.Empty:
            return
        try:
            future.set_result(f(self._world))
        except Exception as error:  # raised again where it was asked for
            future.set_exception(error)
        self._frame = None  # what was done is seen at once

    def _publish(self, wall: float, sim: float) -> None:
        if self._watch.changed():
            self._revision += 1
        if not self._paused:
            self._real_time += wall
            self._factor += 0.05 * ((sim / wall if wall > 0 else 0.0) - self._factor)
        world = self._world
        if self._newest_contacts is not None:
            self._newest_contacts = self._contacts.read()
        self._frame = Frame(
            self._revision,
            world.time,
            self._real_time,
            world.iterations,
            self._paused,
            0.0 if self._paused else self._factor,
            np.array(world.link_poses, np.float32),
            np.array(world.joint_positions, np.float32),
        )

    def _drive(self, world: World) -> None:
        for joint, mode, value, gains, memory in self._commands.values():
            if mode == "force":
                joint.add_force(value)
                continue
            error = value - (joint.position() if mode == "position" else joint.velocity())
            slope = (error - memory[1]) / world.dt if memory[1] is not None else 0.0
            memory[0] += error * world.dt
            memory[1] = error
            joint.add_force(gains[0] * error + gains[1] * memory[0] + gains[2] * slope)
        self._pushes = [push for push in self._pushes if push[3] > world.time]
        for link, force, torque, _ in self._pushes:
            link.add_force(force)
            link.add_torque(torque)

    # ------------------------------------------------------------------------------------------ Simulation

    def model_names(self) -> dict[str, str]:
        return self._world.finder.models() if self._world.finder is not None else {}

    def finder(self) -> Any:
        return self._world.finder

    def frame(self) -> Frame | None:
        return self._frame

    def describe(self) -> WorldRecord:
        return self.call(lambda world: record_world(world, self._revision))

    def pause(self, on: bool) -> None:
        def do(world: World) -> None:
            self._paused = on

        self.call(do)

    def step(self, count: int) -> None:
        def do(world: World) -> None:
            self._paused = True
            world.step(count)

        self.call(do)

    def reset(self, what: str) -> None:
        def do(world: World) -> None:
            self._commands.clear()
            self._pushes.clear()
            if what != "models":
                self._real_time = 0.0
            {"time": world.reset_time, "models": world.reset_poses, "all": world.reset}[what]()

        self.call(do)

    def set_pose(self, model: str, pose: d.Pose) -> None:
        def do(world: World) -> None:
            handle = _model(world, model)
            handle.pose = pose
            handle.set_twist((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))

        self.call(do)

    def insert(self, name: str, text: str, pose: d.Pose) -> None:
        def do(world: World) -> None:
            entity = Entity(text, world.finder)
            if entity.kind == "light":
                light, _ = entity.light(name)
                if name in world.lights:
                    raise Refused(f"a light named '{name}' is there already")
                world.lights[name] = replace(light, pose=pose)
                return
            model, problems = entity.model(name)
            world.problems += problems
            world.spawn(model, pose=math3.compose(pose, model.pose))

        self.call(do)

    def delete(self, name: str) -> None:
        def do(world: World) -> None:
            if name in world.lights and name not in world.models:
                del world.lights[name]
                return
            for key in [key for key, entry in self._commands.items() if entry[0].model.name == name]:
                del self._commands[key]
            self._pushes = [push for push in self._pushes if push[0].model.name != name]
            _model(world, name)
            world.remove(name)

        self.call(do)

    def set_joint_position(self, model: str, joint: str, position: float) -> None:
        self.call(lambda world: _model(world, model).joints[joint].set_position(position))

    def command_joint(self, model: str, joint: str, mode: str, value: float, gains: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> None:
        def do(world: World) -> None:
            handle = _model(world, model).joints[joint]
            self._commands.pop(handle.scoped_name, None)
            if mode != "none":
                self._commands[handle.scoped_name] = (handle, mode, value, gains, [0.0, None])

        self.call(do)

    def link_properties(self, model: str, link: str) -> LinkProperties:
        def do(world: World) -> LinkProperties:
            handle = _model(world, model).links[link]
            ixx, iyy, izz, ixy, ixz, iyz = (float(v) for v in handle.inertia)
            com = math3.transform(math3.inverse(handle.pose), handle.com())
            return LinkProperties(handle.mass, com, (ixx, ixy, ixz, iyy, iyz, izz), bool(handle.gravity))

        return self.call(do)

    def set_link_properties(self, model: str, link: str, properties: LinkProperties) -> None:
        def do(world: World) -> None:
            handle = _model(world, model).links[link]
            handle.set_inertial(d.Inertial(properties.mass, d.Pose(properties.com), *properties.inertia))
            handle.gravity = properties.gravity

        self.call(do)

    def physics(self) -> tuple[d.Physics, d.Vec3]:
        return self.call(lambda world: (world.physics.record(), world.gravity))

    def set_physics(self, physics: d.Physics, gravity: d.Vec3) -> None:
        self.call(lambda world: world.set_physics(physics, gravity))

    def set_light(self, light: d.Light) -> None:
        def do(world: World) -> None:
            if light.name not in world.lights:
                raise Refused(f"there is no light '{light.name}'")
            world.lights[light.name] = light

        self.call(do)

    def push(self, model: str, link: str, force: d.Vec3, torque: d.Vec3, duration: float) -> None:
        def do(world: World) -> None:
            handle = _model(world, model).links[link]
            self._pushes = [push for push in self._pushes if push[0] is not handle]  # the last one asked for wins
            self._pushes.append((handle, force, torque, world.time + duration))

        self.call(do)

    def surface(self, model: str, link: str) -> SurfaceProperties:
        def do(world: World) -> SurfaceProperties:
            surface = _collisions(world, model, link)[0].surface
            return SurfaceProperties(surface.mu, surface.mu2, surface.restitution)

        return self.call(do)

    def set_surface(self, model: str, link: str, surface: SurfaceProperties) -> None:
        def do(world: World) -> None:
            for collision in _collisions(world, model, link):
                for name, value in vars(surface).items():
                    setattr(collision.surface, name, value)

        self.call(do)

    def paint(self, model: str, link: str, rgba: d.Rgba) -> None:
        self.call(lambda world: [paint(other, rgba) for name, other in _model(world, model).links.items() if link in ("", name)])

    def set_looks(self, model: str, looks: Looks) -> None:
        self.call(lambda world: set_looks(_model(world, model), looks))

    def watch_contacts(self, on: bool) -> None:
        def do(world: World) -> None:
            self._contacts.watch(on)
            self._newest_contacts = self._contacts.read() if on else None

        self.call(do)

    def contacts(self) -> np.ndarray:
        newest = self._newest_contacts
        return newest if newest is not None else np.zeros((0, 6), np.float32)

    def moments(self) -> tuple[KeptMoment, ...]:
        return self.call(lambda world: tuple(KeptMoment(moment.number, moment.time_ns * 1e-9) for moment in self._timeline.moments))

    def keep(self) -> None:
        self.call(lambda world: self._timeline.keep())

    def record(self, period: float) -> None:
        self.call(lambda world: self._timeline.record(period))

    def go_back(self, number: int) -> None:
        def do(world: World) -> None:
            moment = self._timeline.find(number)
            world.restore(moment.snapshot)
            self._paused = True
            self._timeline.went_back(moment)

        self.call(do)

    def save(self) -> str:
        return world_text(self.call(describe_now))


def _model(world: World, name: str) -> ModelHandle:
    if name not in world.models:
        raise Refused(f"there is no model '{name}' any more")
    return world.models[name]


def _collisions(world: World, model: str, link: str) -> list[CollisionHandle]:
    found = list(_model(world, model).links[link].collisions.values())
    if not found:
        raise Refused(f"{model}::{link} has no collision")
    return found
