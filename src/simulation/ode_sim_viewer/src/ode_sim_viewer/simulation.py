"""What the page wants of a simulator, in this process or in another one."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from ode_sim.description import model as d
from ode_sim.description.exchange import register
from ode_sim.errors import Refused  # noqa: F401  (what a simulation answers)
from ode_sim.math3 import Pose, compose, inverse

if TYPE_CHECKING:
    from ode_sim.handles import ModelHandle
    from ode_sim.world import World


@register
@dataclass(frozen=True)
class ModelRecord:
    """One model of the world.

    :ivar links: link name -> row of :attr:`Frame.poses`. :ivar joints: joint name -> row of its first axis in
        :attr:`Frame.joints`; only joints that have an axis.
    """

    name: str
    description: d.Model
    static: bool = False
    links: dict[str, int] = field(default_factory=dict)
    joints: dict[str, int] = field(default_factory=dict)

    def pose(self, frame: Frame) -> Pose:
        """X_WM: the model frame, fixed to the first link."""
        if not self.links:
            return self.description.pose
        name, row = next(iter(self.links.items()))
        first = next((link for link in self.description.links if link.name == name), d.Link(name))
        return compose(frame.pose(row), inverse(first.pose))


@register
@dataclass(frozen=True)
class WorldRecord:
    """What is in the world; what moves in it is in :class:`Frame`.

    :ivar revision: changes with every change of what is here.
    :ivar view: X_WE of the eye at first, which looks along its x axis; None where the world does not say it.
    """

    revision: int = 0
    name: str = ""
    models: tuple[ModelRecord, ...] = ()
    lights: tuple[d.Light, ...] = ()
    scene: d.Scene = d.Scene()
    view: Pose | None = None

    def model(self, name: str) -> ModelRecord | None:
        """The model ``name``, or None."""
        return next((model for model in self.models if model.name == name), None)


@dataclass(frozen=True)
class Frame:
    """One moment. ``poses`` (L,7) x y z qx qy qz qw of each link in the world, ``joints`` (J,) rad or m of each axis,
    both in the rows of the :class:`WorldRecord` of that ``revision``. ``real_time``: s of wall time that the simulation
    has run."""

    revision: int
    sim_time: float
    real_time: float
    iterations: int
    paused: bool
    real_time_factor: float
    poses: np.ndarray
    joints: np.ndarray

    def pose(self, row: int) -> Pose:
        """X_WL of a row."""
        values = [float(v) for v in self.poses[row]]
        x, y, z, qx, qy, qz, qw = values
        return Pose((x, y, z), (qx, qy, qz, qw))


@dataclass(frozen=True)
class LinkProperties:
    """``mass`` kg, ``com`` m in the link frame, ``inertia`` ixx ixy ixz iyy iyz izz kg m^2 about it, link axes."""

    mass: float
    com: tuple[float, float, float]
    inertia: tuple[float, float, float, float, float, float]
    gravity: bool


@dataclass(frozen=True)
class SurfaceProperties:
    """``mu`` and ``mu2``: Coulomb friction in the two directions; ``restitution`` 0 to 1."""

    mu: float
    mu2: float
    restitution: float


@dataclass(frozen=True)
class KeptMoment:
    """One that :meth:`Simulation.go_back` may be given; ``time`` s of sim time."""

    number: int
    time: float


#: Link name -> its visuals; of these only the material and the transparency count.
Looks = dict[str, tuple[d.Visual, ...]]
#: How a joint is commanded: nothing, a force (N m or N), a position (rad or m) or velocity held by a PID of effort.
JOINT_MODES = ("none", "force", "position", "velocity")


class Simulation(ABC):
    """Every method may be called from any thread; those that act return when it is done.

    :raises Refused: all of them but :meth:`frame`.
    """

    @property
    def problems(self) -> tuple[str, ...]:
        """Lines about what of the world had to be left out, if nobody else has said them."""
        return ()

    #: what :meth:`insert` may be given, by the name that a person sees -> URI or file
    def model_names(self) -> dict[str, str]:
        """Models of the model path: name -> path of the SDF file."""
        return {}

    def finder(self) -> Any:
        """What finds ``model://`` and other names of files (:class:`ode_sim.description.ResourceFinder`), or None."""
        return None

    @abstractmethod
    def frame(self) -> Frame | None:
        """The newest moment; None before the first one and while the simulator is away."""

    @abstractmethod
    def describe(self) -> WorldRecord:
        """What is in the world now."""

    def look(self, on: bool) -> None:
        """Somebody looks from now on, or nobody: frames need not come."""

    @abstractmethod
    def pause(self, on: bool) -> None:
        """Let the clock stand still (``on``), or go on."""

    @abstractmethod
    def step(self, count: int) -> None:
        """Take ``count`` steps; the simulation is paused for it."""

    @abstractmethod
    def reset(self, what: str) -> None:
        """:param what: ``time`` (to 0), ``models`` (to where they were put), ``all`` (both, and joints to how they were)"""

    @abstractmethod
    def set_pose(self, model: str, pose: Pose) -> None:
        """Put ``model`` at X_WM ``pose``, at rest."""

    @abstractmethod
    def insert(self, name: str, text: str, pose: Pose) -> None:
        """A model or light ``name`` from SDF or URDF ``text``, at X_W ``pose``."""

    @abstractmethod
    def delete(self, name: str) -> None:
        """Take the model, or the light of the world, ``name`` out."""

    @abstractmethod
    def set_joint_position(self, model: str, joint: str, position: float) -> None:
        """Teleport ``joint`` of ``model`` to ``position``, rad or m."""

    @abstractmethod
    def command_joint(self, model: str, joint: str, mode: str, value: float, gains: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> None:
        """Command ``joint`` of ``model`` from now on, until another command or a reset.

        :param mode: see :data:`JOINT_MODES`. :param value: in its unit. :param gains: p, i, d, for the modes that have them
        """

    @abstractmethod
    def link_properties(self, model: str, link: str) -> LinkProperties:
        """Mass, inertia and gravity of ``link`` of ``model``."""

    @abstractmethod
    def set_link_properties(self, model: str, link: str, properties: LinkProperties) -> None:
        """Give ``link`` of ``model`` the mass, inertia and gravity of ``properties``."""

    @abstractmethod
    def physics(self) -> tuple[d.Physics, d.Vec3]:
        """Settings and gravity."""

    @abstractmethod
    def set_physics(self, physics: d.Physics, gravity: d.Vec3) -> None:
        """Step with the settings ``physics`` and with ``gravity``, m/s^2, from now on."""

    @abstractmethod
    def set_light(self, light: d.Light) -> None:
        """A light of the world, by its name."""

    @abstractmethod
    def push(self, model: str, link: str, force: d.Vec3, torque: d.Vec3, duration: float) -> None:
        """``force`` N and ``torque`` N m at the centre of mass of ``link`` of ``model``, world axes, for ``duration`` s of sim time.

        A new one on the same link takes the place of the one before.
        """

    @abstractmethod
    def surface(self, model: str, link: str) -> SurfaceProperties:
        """Of the first collision of ``link`` of ``model``."""

    @abstractmethod
    def set_surface(self, model: str, link: str, surface: SurfaceProperties) -> None:
        """Give ``surface`` to all collisions of ``link`` of ``model``."""

    @abstractmethod
    def paint(self, model: str, link: str, rgba: d.Rgba) -> None:
        """All visuals of ``link`` ('' = of the whole ``model``) in one colour, ``rgba``, 0 to 1."""

    @abstractmethod
    def set_looks(self, model: str, looks: Looks) -> None:
        """The visuals of these links of ``model`` look as ``looks`` says they did."""

    @abstractmethod
    def watch_contacts(self, on: bool) -> None:
        """Somebody wants :meth:`contacts` from now on, or nobody."""

    @abstractmethod
    def contacts(self) -> np.ndarray:
        """(N, 6) float32 of the newest moment: place m, force N on the body that can move, world axes."""

    @abstractmethod
    def moments(self) -> tuple[KeptMoment, ...]:
        """In the order of time."""

    @abstractmethod
    def keep(self) -> None:
        """Keep this moment."""

    @abstractmethod
    def record(self, period: float) -> None:
        """Keep a moment every ``period`` s of sim time; 0: no more."""

    @abstractmethod
    def go_back(self, number: int) -> None:
        """To the moment ``number``, which was kept; paused from then on."""

    @abstractmethod
    def save(self) -> str:
        """The world as it is now, as SDF."""

    def close(self) -> None:
        """The page has ended."""


def record_world(world: World, revision: int) -> WorldRecord:
    """Of a running :class:`ode_sim.World`, ``world``, as its ``revision``; in the thread that steps it."""
    models: list[ModelRecord] = []
    for model in world.models.values():
        models.append(
            ModelRecord(
                model.name,
                _with_lights(model),
                model.static,
                {link.name: link.index for link in model.links.values()},
                {joint.name: joint.index for joint in model.joints.values() if joint.axis_count},
            )
        )
    return WorldRecord(revision, world.name, tuple(models), tuple(world.lights.values()), world.scene)


def _with_lights(model: ModelHandle) -> d.Model:
    """The description with the lights that the links carry now."""
    now = {link.name: tuple(link.lights.values()) for link in model.links.values()}
    if all(now.get(link.name, link.lights) == link.lights for link in model.description.links):
        return model.description
    links = tuple(replace(link, lights=now.get(link.name, link.lights)) for link in model.description.links)
    return replace(model.description, links=links)
