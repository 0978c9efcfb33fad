"""A world that steps: models, joints, contacts, ray casts, snapshots. No ROS, no wall clock."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from ode_sim import _core
from ode_sim.attachment import Attachment
from ode_sim.builder import Builder
from ode_sim.core_numbers import flat, unit_pose
from ode_sim.description import model as d
from ode_sim.handles import CollisionHandle, JointHandle, LinkHandle, ModelHandle
from ode_sim.math3 import compose
from ode_sim.physics import PhysicsSettings, check_gravity, check_physics, usable_physics
from ode_sim.random_streams import RandomStreams
from ode_sim.saved_state import apply_state

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from ode_sim.actors.puppet import Puppet
    from ode_sim.description.finder import ResourceFinder

Entity = ModelHandle | LinkHandle | CollisionHandle
_MOST_STEPS = 1_000_000  # in one call into the core


@dataclass(frozen=True)
class Snapshot:
    """The whole state of a world at one moment. Two snapshots are equal exactly if every bit of the state is."""

    models: tuple[str, ...]
    state: bytes
    generators: bytes  # seed and state of World.rng, what actors play; JSON
    welds: tuple[int, ...] = field(default=(), compare=False)  # by which Attachment objects find theirs; no part of the state

    def __bytes__(self) -> bytes:
        return b"".join((repr(self.models).encode(), self.state, self.generators))


def _put_to_zero(joint: JointHandle) -> None:
    """All axes of a joint at 0, or at the limit that is next to it."""
    for axis in range(joint.axis_count):
        joint.set_position(0.0, axis)


class World:
    """:param description: what to start with; models of it are spawned in file order.
    :param seed: of every random number drawn in this world.
    :param finder: of ``model://`` and ``package://``, for :meth:`spawn_urdf` and :meth:`spawn_sdf`.
    :param problems: what was noticed while ``description`` was read; more is added to them.
    """

    def __init__(
        self, description: d.World | None = None, seed: int = 0, finder: ResourceFinder | None = None, problems: Iterable[d.Problem] = ()
    ) -> None:
        description = description or d.World()
        self.description = description
        self.name = description.name
        self.finder = finder
        self.core = _core.World()
        self.problems: list[d.Problem] = list(problems)
        physics, limited = usable_physics(description.physics)
        self.problems += [d.Problem("warning", line, description.source) for line in limited]
        self.physics = PhysicsSettings(self.core, physics)
        self.gravity = self._usable_gravity(description)
        self.magnetic_field = description.magnetic_field
        self.scene = description.scene
        self.lights: dict[str, d.Light] = {}
        self.models: dict[str, ModelHandle] = {}
        self.actors: dict[str, Puppet] = {}  # those of the models that are actors
        self.messages: list[str] = []
        self.before_step: list[Callable[[World], None]] = []
        self.after_step: list[Callable[[World], None]] = []
        self.on_spawn: list[Callable[[ModelHandle], None]] = []
        self.on_remove: list[Callable[[ModelHandle], None]] = []
        self._collisions: dict[int, CollisionHandle] = {}
        self.seed = seed
        for light in description.lights:
            self.lights.setdefault(light.name, light)
        deleted = set(description.state.deletions) if description.state else set()
        for model in description.models:
            if model.name in self.models:
                self.problems.append(d.Problem("warning", f"a second model '{model.name}' is left out; names must differ", model.source))
            elif model.name not in deleted:
                try:
                    self.spawn(model)
                except d.DescriptionError as error:
                    self.problems.append(d.Problem("error", f"model '{model.name}' is left out: {error}", model.source))
        if description.state:
            apply_state(self, description.state)

    @classmethod
    def load(cls, source: str, seed: int = 0, finder: ResourceFinder | None = None) -> World:
        """A world from ``source``: a path, a ``model://`` or world name, or XML text; ``seed`` and ``finder`` as in the class.

        :raises DescriptionError: one line that says what cannot be read; smaller trouble goes to ``problems``.
        """
        from ode_sim.description import load_world

        description, problems = load_world(source, finder=finder)
        return cls(description, seed=seed, finder=finder, problems=problems)

    # ------------------------------------------------------------------------------------------ time and settings

    @property
    def time_ns(self) -> int:
        """Simulated time in nanoseconds."""
        return self._time_ns if self._time_ns is not None else self.core.time_ns

    _time_ns: int | None = None  # set while callbacks run before the core has stepped

    @property
    def time(self) -> float:
        """Simulated time, s."""
        return self.time_ns * 1e-9

    @property
    def iterations(self) -> int:
        return self.core.iterations

    @property
    def dt(self) -> float:
        """Step, s."""
        return self.core.dt

    @property
    def gravity(self) -> d.Vec3:
        """m/s^2, world axes."""
        return self.core.gravity

    @gravity.setter
    def gravity(self, g: d.Vec3) -> None:
        self.core.gravity = check_gravity(g)

    def set_physics(self, physics: d.Physics, gravity: d.Vec3 | None = None) -> None:
        """Take over all settings, and gravity if given - or nothing at all. :attr:`physics` has them one by one.

        :raises ValueError: one line that names the setting that no world can run with.
        """
        checked = check_physics(physics, gravity)
        self.physics.update(checked)
        if gravity is not None:
            self.gravity = gravity

    def _usable_gravity(self, description: d.World) -> d.Vec3:
        try:
            return check_gravity(description.gravity)
        except ValueError as error:
            self.problems.append(d.Problem("warning", f"{error}; 0 0 -9.8 is used", description.source))
            return d.World().gravity

    @property
    def seed(self) -> int:
        return self._random.seed

    @seed.setter
    def seed(self, seed: int) -> None:
        self._random = RandomStreams(seed)
        self.core.seed = self._random.seed & 0xFFFFFFFFFFFFFFFF

    def rng(self, name: str) -> np.random.Generator:
        """The random generator of that name: its numbers depend on the seed and the name alone."""
        return self._random.stream(name)

    # ------------------------------------------------------------------------------------------ models

    def spawn(self, model: d.Model, name: str | None = None, pose: d.Pose | None = None) -> ModelHandle:
        """Put a described model into the world.

        :param name: takes the place of the model's own.
        :param pose: X_WM, takes the place of the model's own.
        What fails leaves nothing behind, in the world or in the core.

        :raises DescriptionError: the name is taken, or nothing of the model can be simulated.
        """
        name = name or model.name
        if name in self.models:
            raise d.DescriptionError(f"a model named '{name}' is in the world already; choose another name or remove it first")
        pose = model.pose if pose is None else pose
        builder = Builder(self.core)
        try:
            flat(pose, f"pose of model '{name}'")
            pose = unit_pose(pose)
            handle = builder.build(self, model, name, pose)
        except d.DescriptionError:
            raise
        except (ValueError, TypeError, OverflowError, RuntimeError) as error:  # a number that no world can hold
            raise d.DescriptionError(f"model '{name}' cannot be simulated: {error}") from error
        self.models[name] = handle
        if model.actor is not None:
            from ode_sim.actors.puppet import Puppet  # here: few worlds have actors, and all would wait for it

            self.actors[name] = Puppet(handle, self.time_ns)
            builder.problems += [d.Problem("warning", f"actor '{name}': {line}", model.source) for line in self.actors[name].problems]
        for link in handle.links.values():
            for collision in link.collisions.values():
                self._collisions[collision.id] = collision
        try:
            for callback in list(self.on_spawn):
                callback(handle)
        except BaseException:
            self.remove(name)
            raise
        self.problems += builder.problems
        return handle

    def spawn_urdf(self, text: str, name: str | None = None, pose: d.Pose | None = None) -> ModelHandle:
        """Spawn URDF text at ``pose`` composed with the model's own origin; ``name`` takes the place of the text's."""
        from ode_sim.description import read_urdf

        return self._spawn_text(read_urdf(text, name=name, finder=self.finder), pose)

    def spawn_sdf(self, text: str, name: str | None = None, pose: d.Pose | None = None) -> ModelHandle:
        """Spawn the first model of SDF text at ``pose`` composed with the model's own pose; ``name`` takes the place of the text's."""
        from ode_sim.description import read_sdf_model

        return self._spawn_text(read_sdf_model(text, name=name, finder=self.finder), pose)

    def _spawn_text(self, read: tuple[d.Model, list[d.Problem]], pose: d.Pose | None) -> ModelHandle:
        model, problems = read
        handle = self.spawn(model, pose=compose(pose or d.Pose(), model.pose))
        self.problems += problems
        return handle

    def remove(self, name: str) -> None:
        """Take the model ``name`` out of the world. :raises KeyError: there is none."""
        if name not in self.models:
            raise KeyError(f"there is no model '{name}' in the world")
        handle = self.models[name]
        try:
            for callback in list(self.on_remove):
                callback(handle)
        finally:
            del self.models[name]
            self.actors.pop(name, None)
            for link in handle.links.values():
                for collision in link.collisions.values():
                    self._collisions.pop(collision.id, None)
            self.core.remove_model(handle.core)

    def attach(self, parent: LinkHandle | None, child: LinkHandle) -> Attachment:
        """Hold ``child`` where it is now relative to ``parent``, a link of any model (None: the world).

        They do not collide until :meth:`Attachment.detach`. Ends when either model is removed and at every reset.

        :raises ValueError: neither can move, or one is not in this world.
        """
        if parent is child or (parent or child).model.static and child.model.static:
            raise ValueError(
                f"{child.scoped_name} cannot be attached to {parent.scoped_name if parent else 'the world'}: "
                "it takes two links of which at least one can move"
            )
        return Attachment(self.core, parent, child)

    def find_entity(self, name: str) -> Entity | None:
        """The first model, link or collision, depth first, whose scoped or unscoped name this is."""
        for model in self.models.values():
            if model.name == name:
                return model
            for link in model.links.values():
                if name in (link.name, link.scoped_name):
                    return link
                for collision in link.collisions.values():
                    if name in (collision.name, collision.scoped_name):
                        return collision
        return None

    def find_link(self, name: str) -> LinkHandle | None:
        """The first link of that scoped or unscoped name."""
        for model in self.models.values():
            for link in model.links.values():
                if name in (link.name, link.scoped_name):
                    return link
        return None

    def find_joint(self, name: str) -> JointHandle | None:
        """The first joint of that scoped or unscoped name."""
        for model in self.models.values():
            for joint in model.joints.values():
                if name in (joint.name, joint.scoped_name):
                    return joint
        return None

    # ------------------------------------------------------------------------------------------ stepping

    def step(self, n: int = 1) -> None:
        """Advance by ``n`` steps. Without callbacks all of them are one call into the core."""
        if n < 0:
            raise ValueError(f"cannot step {n} times")
        done, told = 0, False
        while done < n:
            if not self.before_step and not self.after_step and not self.actors:
                many = min(n - done, _MOST_STEPS)
                told |= self.core.step(many)
                done += many
            else:
                # Sim time is advanced first: a controller sees the time of the state that it produces.
                self._time_ns = self.core.next_time_ns
                try:
                    for callback in list(self.before_step):
                        callback(self)
                    for actor in self.actors.values():
                        actor.advance(self._time_ns, self.core.dt)
                finally:
                    self._time_ns = None
                told |= self.core.step(1)
                done += 1
                for callback in list(self.after_step):
                    callback(self)
        if told:
            self.messages += self.core.take_messages()

    def reset(self) -> None:
        """Time 0, every model with its joints as it was spawned, everything at rest, random numbers from the start. What is attached as
        it stood then stays so; the rest lets go."""
        for model in self.models.values():
            if model.flown_apart:  # joints far off cannot be set
                model.pose = model.initial_pose
                model.put_together()
            for joint in model.joints.values():
                _put_to_zero(joint)
            model.put_together()
        self.core.time_ns = 0
        self.core.iterations = 0
        self.reset_poses()
        self._random.restart()

    def reset_time(self) -> None:
        """Time 0, as :meth:`set_time`."""
        self.set_time(0)

    def set_time(self, time_ns: int) -> None:
        """Another time; where everything is, how it moves and how many steps were taken stays.

        :param time_ns: the time that it is then
        """
        for actor in self.actors.values():
            actor.shift(time_ns - self.core.time_ns)
        self.core.time_ns = time_ns

    def reset_poses(self) -> None:
        """Models back to where they were spawned, at rest. Time goes on and joints stay at their angles, but for those by which the first
        link of a model hangs on the world: where it is, the model is. Attachments whose links come to stand otherwise let go."""
        for model in self.models.values():
            if not model.flown_apart:  # joints far off cannot be set
                for joint in model.joints.values():
                    if joint.parent is None and joint.child is model.canonical_link:
                        _put_to_zero(joint)
            model.pose = model.initial_pose
            model.core.zero_velocities()
        self.core.detach_strained()
        for actor in self.actors.values():
            actor.restart(self.core.time_ns)

    def save(self) -> Snapshot:
        """The whole state: continuing from it gives the same bits as going on without saving."""
        kept = {**self._random.state(), "actors": [actor.state() for actor in self.actors.values()]}
        return Snapshot(tuple(self.models), self.core.save(), json.dumps(kept).encode(), tuple(self.core.welds()))

    def restore(self, snapshot: Snapshot) -> None:
        """Back to a saved state of a world with the same models.

        :raises ValueError: models were added or removed since, or the snapshot is damaged; nothing is changed.
        """
        if snapshot.models != tuple(self.models):
            raise ValueError(
                f"the snapshot holds the models {', '.join(snapshot.models) or 'none'}; the world has {', '.join(self.models) or 'none'}"
            )
        try:
            saved = json.loads(snapshot.generators)
            random = RandomStreams.read(saved)
            if len(saved["actors"]) != len(self.actors):
                raise ValueError("it is of other actors")
            actors = [actor.read_state(state) for actor, state in zip(self.actors.values(), saved["actors"])]
        except (ValueError, TypeError, KeyError) as error:
            raise ValueError(f"the snapshot cannot be restored: its random numbers or actors are damaged ({error})") from None
        self.core.restore(snapshot.state, snapshot.welds)
        self._random = random
        for actor, state in zip(self.actors.values(), actors):
            actor.set_state(state)

    # ------------------------------------------------------------------------------------------ state, contacts, rays

    @property
    def joint_positions(self) -> np.ndarray:
        """(J,) rad or m, a view of the core's memory, read-only.

        Take it anew after each spawn or remove: one taken before goes on showing what was then.
        """
        return self.core.joint_positions

    @property
    def joint_velocities(self) -> np.ndarray:
        """(J,) rad/s or m/s, a view as :attr:`joint_positions`."""
        return self.core.joint_velocities

    @property
    def link_poses(self) -> np.ndarray:
        """(L, 7) x y z qx qy qz qw of each link in the world, a view as :attr:`joint_positions`."""
        return self.core.link_poses

    def contacts(self) -> np.ndarray:
        """Contacts of the last step: fields ``collision1``, ``collision2`` (ids), ``position`` (3,) m, ``normal`` (3,)
        into the first, ``depth`` m, ``force`` (3,) N and ``torque`` (3,) N m about its centre of mass on the first
        collision's link. Force and torque are known only where :meth:`watch_contacts` asked for them."""
        return self.core.contacts()

    def watch_contacts(self, collision: CollisionHandle, on: bool = True) -> None:
        """Have the forces of this ``collision``'s contacts measured, until as many as asked for it (``on``) need them no more (False)."""
        collision.watchers = max(0, collision.watchers + (1 if on else -1))
        collision.core.watched = collision.watchers > 0

    def collision(self, collision_id: int) -> CollisionHandle | None:
        """By ``collision_id``, the id that contacts and ray hits carry."""
        return self._collisions.get(int(collision_id))

    def cast_rays(
        self, origins: ArrayLike, directions: ArrayLike, max_range: float, ignore: Iterable[CollisionHandle] = ()
    ) -> tuple[np.ndarray, np.ndarray]:
        """Cast N rays against every collision shape.

        :param origins: (N, 3) m, world.
        :param directions: (N, 3), world, any length.
        :param max_range: m.
        :param ignore: collisions that rays pass through.
        :returns: ranges (N,) m, ``inf`` where nothing is hit; collision ids (N,) int32, -1 where nothing is hit.
        """
        origins = np.ascontiguousarray(origins, dtype=float).reshape(-1, 3)
        directions = np.ascontiguousarray(directions, dtype=float).reshape(-1, 3)
        if origins.shape != directions.shape:
            raise ValueError(f"{len(origins)} ray origins but {len(directions)} directions")
        return self.core.cast_rays(origins, directions, float(max_range), [c.id for c in ignore])
