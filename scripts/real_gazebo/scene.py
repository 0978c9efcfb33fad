"""A scene: a world file, what is done in it, and the rows of the parity page that are measured in its record."""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from dataclasses import dataclass, field

REST = "0 0 0 0 0 0"


@dataclass(frozen=True)
class Row:
    """One quantity of a scene.

    :param quantity: in words, with its unit.
    :param measure: takes it from a :class:`records.Record`.
    :param law: its value on paper, if there is one.
    :param gazebo: what `solver: gazebo` may be away from real Gazebo: part of the value, and absolutely.
    :param default: the same of the default solver, from the law where there is one, else from real Gazebo.
    """

    quantity: str
    measure: Callable
    law: float | None = None
    gazebo: tuple[float, float] = (1e-4, 1e-5)
    default: tuple[float, float] = (1e-3, 1e-4)


@dataclass(frozen=True)
class Deed:
    """What is done in a scene; kinds: effort, push, torque, pd, velocity (in each step), motor, pose, twist, position, reset,
    reset_poses, remove, gravity, world_gravity, kinematic, spawn (once). `recorder.cc` and `ours.py` both know them."""

    kind: str
    on: str
    value: str = ""
    start: float = 0.0
    end: float = 1e9


@dataclass(frozen=True)
class Scene:
    """:param law: the law that decides it, in words.
    :param files: further files by their names, which the world and `spawn` deeds name as `file://{folder}/NAME` or NAME.
    :param server: the scene needs sensors, so that our server runs it, with the recorder as a compiled plugin."""

    name: str
    family: str
    what: str
    law: str
    world: str
    rows: tuple[Row, ...]
    seconds: float = 1.0
    every: float = 0.01
    deeds: tuple[Deed, ...] = ()
    files: dict[str, object] = field(default_factory=dict)
    contacts: bool = False
    wrenches: bool = False
    links: bool = False
    server: bool = False

    def plugin(self) -> str:
        """The recorder's element, which real Gazebo reads."""
        switches = "".join(f"<{name}>1</{name}>" for name in ("contacts", "wrenches", "links") if getattr(self, name))
        switches += "<sensors>1</sensors>" if self.server else ""
        deeds = "".join(f"<do kind='{d.kind}' on='{d.on}' value='{d.value}' from='{d.start:.9g}' until='{d.end:.9g}'/>" for d in self.deeds)
        return (
            f"<plugin name='recorder' filename='librecorder.so'><seconds>{self.seconds:.9g}</seconds><every>{self.every:.9g}</every>"
            f"{switches}{deeds}</plugin>"
        )

    def world_for(self, folder: str) -> str:
        return self.world.replace("{folder}", folder)

    def digest(self) -> str:
        """Of all that real Gazebo was given: a record of another digest is of another scene."""
        text = repr((self.world, self.plugin(), sorted((n, b if isinstance(b, bytes) else b.encode()) for n, b in self.files.items())))
        return hashlib.sha256(text.encode()).hexdigest()[:16]


SCENES: list[Scene] = []


def add(scene: Scene) -> Scene:
    if any(other.name == scene.name for other in SCENES):
        raise ValueError(f"two scenes are called {scene.name}")
    SCENES.append(scene)
    return scene
