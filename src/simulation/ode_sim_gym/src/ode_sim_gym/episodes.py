"""One world that is played again and again from the same snapshot: what is commanded, what is seen."""

from __future__ import annotations

import math
import os
import pathlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from ode_sim.handles import JointHandle, LinkHandle
from ode_sim.world import World

if TYPE_CHECKING:
    from ode_sim.description.finder import ResourceFinder

KINDS = ("position", "velocity", "effort")


@dataclass(frozen=True)
class Command:
    """One number of an action.

    :param joint: scoped or unscoped name of a joint with one axis, or more: the first is commanded.
    :param kind: ``position`` (followed exactly), ``velocity`` (a motor of the joint's effort limit) or ``effort``.
    :param low, high: what an action may ask for, in rad, rad/s, N m or m, m/s, N; without them the limits of the URDF.
    """

    joint: str
    kind: str = "effort"
    low: float | None = None
    high: float | None = None


class Episodes:
    """The simulator's side of an environment; knows no Gymnasium.

    :param world: path, ``model://`` or world name, or XML text of the world; empty: gravity and nothing else.
    :param robot: path or text of a URDF that is spawned into it.
    :param commands: what an action sets, in this order.
    :param joints: whose position and velocity are seen; without it all that move, in file order.
    :param links: whose pose and velocity are seen.
    :param period: s of simulated time from one action to the next, rounded to whole steps.
    :param start: ``start(episodes, random)`` brings the robot into the state that an episode begins with; ``random`` is a
        numpy.random.Generator of the episode's seed.
    :param finder: of the files that world and robot name; None is a ResourceFinder of the environment.
    :raises ValueError: a joint or a link that is not there, a command without limits; one line.
    :raises ode_sim.DescriptionError: the world or the robot cannot be read.
    """

    def __init__(
        self,
        world: str = "",
        robot: str = "",
        commands: Sequence[Command] = (),
        joints: Sequence[str] | None = None,
        links: Sequence[str] = (),
        period: float = 0.02,
        start: Callable[[Episodes, np.random.Generator], None] | None = None,
        finder: ResourceFinder | None = None,
    ):
        self.world = World.load(world, finder=finder) if world else World(finder=finder)
        if robot:
            self.world.spawn_urdf(_text(robot))
        moving = [joint for model in self.world.models.values() for joint in model.joints.values() if joint.axis_count]
        self.joints = moving if joints is None else [self.joint(name) for name in joints]
        self.links = [self.link(name) for name in links]
        self.commands = tuple(commands)
        if not commands:
            raise ValueError(f"no joint is commanded; give commands=[Command(JOINT, KIND)] with a joint of {_names(moving)}")
        self._commanded = [self.joint(command.joint) for command in self.commands]
        self.bounds = [_bounds(command, joint) for command, joint in zip(self.commands, self._commanded)]
        if not (math.isfinite(period) and period > 0.0):
            raise ValueError(f"the period must be more than 0 s, not {period}")
        self.steps_per_action = max(1, round(period / self.world.dt))
        self._start = start
        self._efforts: list[tuple[JointHandle, float]] = []
        self._begin = self.world.save()
        self._begin_time = self.world.time
        self.random = np.random.default_rng(0)

    def joint(self, name: str) -> JointHandle:
        """By scoped or unscoped name.

        :raises ValueError: it is not there, or does not move.
        """
        joint = self.world.find_joint(name)
        if joint is None or not joint.axis_count:
            here = [j for model in self.world.models.values() for j in model.joints.values() if j.axis_count]
            raise ValueError(f"no joint '{name}' that moves is in the world; there are: {_names(here)}")
        return joint

    def link(self, name: str) -> LinkHandle:
        """By scoped or unscoped name.

        :raises ValueError: it is not there.
        """
        link = self.world.find_link(name)
        if link is None:
            here = [link for model in self.world.models.values() for link in model.links.values()]
            raise ValueError(f"no link '{name}' is in the world; there are: {_names(here)}")
        return link

    @property
    def time(self) -> float:
        """s of simulated time since the episode began."""
        return self.world.time - self._begin_time

    def position(self, joint: str) -> float:
        """Of ``joint``: rad (multi-turn) or m."""
        return self.joint(joint).position()

    def velocity(self, joint: str) -> float:
        """Of ``joint``: rad/s or m/s."""
        return self.joint(joint).velocity()

    @property
    def size(self) -> int:
        """Of an observation."""
        return 2 * len(self.joints) + 13 * len(self.links)

    def observe(self) -> np.ndarray:
        """(size,) positions of the joints (rad, m), their velocities; then of each link x y z qx qy qz qw, velocity of its origin
        and angular velocity, all in world axes (m, rad/s)."""
        seen = [joint.position() for joint in self.joints] + [joint.velocity() for joint in self.joints]
        for link in self.links:
            pose = link.pose
            seen += [*pose.p, *pose.q, *link.linear_velocity(), *link.angular_velocity()]
        return np.array(seen)

    def begin(self, seed: int) -> None:
        """A new episode: the world as it was made, its random numbers those of the seed, then ``start``."""
        self.world.restore(self._begin)
        self.world.seed = seed
        self.world.messages.clear()
        self._efforts = []
        self.random = self.world.rng("gym.start")
        if self._start is not None:
            self._start(self, self.random)

    def advance(self, action: np.ndarray) -> None:
        """One period with this action, cut to the bounds.

        :raises ValueError: it has another size, or holds what is no number.
        """
        action = np.asarray(action, dtype=float)
        if action.shape != (len(self.commands),):
            raise ValueError(f"an action has {len(self.commands)} numbers, one for each command; this one has the shape {action.shape}")
        if not np.isfinite(action).all():
            raise ValueError(f"an action must be of finite numbers, not {action.tolist()}")
        self._efforts = []
        for value, (low, high), command, joint in zip(action.tolist(), self.bounds, self.commands, self._commanded):
            value = min(max(value, low), high)
            if command.kind == "position":
                joint.drive_to(value)
            elif command.kind == "velocity":
                joint.set_motor(value, joint.effort_limit if joint.effort_limit >= 0.0 else math.inf)
            else:
                self._efforts.append((joint, value))
        if not self._efforts:
            self.world.step(self.steps_per_action)
            return
        for _ in range(self.steps_per_action):  # a force lasts for one step
            for joint, value in self._efforts:
                joint.add_force(value)
            self.world.step()


def _text(robot: str) -> str:
    if robot.lstrip().startswith("<"):
        return robot
    try:
        return pathlib.Path(os.path.expanduser(robot)).read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise ValueError(f"the robot {robot} cannot be read: {getattr(error, 'strerror', None) or error}") from None


def _names(handles: Sequence[JointHandle | LinkHandle]) -> str:
    return ", ".join(handle.name for handle in handles[:30]) or "none"


def _bounds(command: Command, joint: JointHandle) -> tuple[float, float]:
    if command.kind not in KINDS:
        raise ValueError(f"joint {joint.name} cannot be commanded by '{command.kind}', only by {', '.join(KINDS)}")
    if command.kind == "position":
        low, high = joint.limits()
    else:
        limit = joint.velocity_limit if command.kind == "velocity" else joint.effort_limit
        low, high = (-limit, limit) if limit >= 0.0 else (-math.inf, math.inf)
    low = low if command.low is None else float(command.low)
    high = high if command.high is None else float(command.high)
    if not (math.isfinite(low) and math.isfinite(high)):
        raise ValueError(f"joint {joint.name} has no {command.kind} limit; give Command('{command.joint}', '{command.kind}', low, high)")
    if not low < high:
        raise ValueError(f"joint {joint.name}: nothing is between low {low:g} and high {high:g} of its {command.kind} command")
    return low, high
