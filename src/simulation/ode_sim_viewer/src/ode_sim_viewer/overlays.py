"""What is drawn on top of the models on request: collisions, centres of mass, inertias, joints, frames, labels."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from ode_sim.description import model as d
from ode_sim.math3 import Pose, compose, quat_from_matrix, vec3
from ode_sim_rendering.assets import Assets

from ode_sim_viewer.arrows import Forces
from ode_sim_viewer.drawing import take_away, wxyz
from ode_sim_viewer.simulation import Frame, ModelRecord, WorldRecord

_ORANGE = (255, 140, 0)
_PINK = (230, 60, 200)
_AXES = ((220, 40, 40), (230, 200, 0))  # of a joint: first and second


class Overlays:
    """Each kind is drawn below the frames of the links, so that it moves without being sent again.

    :ivar shown: kinds that are on
    """

    KINDS = ("collisions", "centres of mass", "inertias", "joints", "link frames", "labels")

    def __init__(self, page: Any):
        self._page = page
        self._scene = page.server.scene
        self._assets = Assets()
        self._nodes: dict[str, list[Any]] = {}
        self.shown: set = set()
        self._contacts: Forces | None = None
        self.force_scale = 0.01  # m of an arrow for each N

    def contacts(self, on: bool) -> None:
        """Show where bodies touch, and with what force, or do not (``on``). Drawing thread."""
        if on == (self._contacts is not None):
            return
        self._page.simulation.watch_contacts(on)
        if self._contacts is None:
            self._contacts = Forces(self._scene, "/contacts", (20, 160, 60), dots=True)
        else:
            self._contacts.hide()
            self._contacts = None

    def show(self, kind: str, on: bool) -> None:
        """Draw ``kind``, or do not any more (``on`` is False). Drawing thread."""
        if on:
            self.shown.add(kind)
        else:
            self.shown.discard(kind)
        self._draw(kind, self._page.world)

    def update(self, world: WorldRecord) -> None:
        """The world has changed."""
        for kind in self.KINDS:
            if kind in self.shown or self._nodes.get(kind):
                self._draw(kind, world)

    def move(self, frame: Frame) -> None:
        """Draw the contacts anew with each ``frame``: all else hangs on the links' frames."""
        if self._contacts is not None:
            found = self._page.simulation.contacts()
            with self._page.server.atomic():
                self._contacts.show(found[:, :3], found[:, 3:], self.force_scale)

    def _draw(self, kind: str, world: WorldRecord) -> None:
        for node in self._nodes.pop(kind, ()):
            take_away(node)
        if kind not in self.shown:
            return
        draw = getattr(self, "_" + kind.replace(" ", "_"))
        made: list[Any] = []
        with self._page.server.atomic():
            for record in world.models:
                drawn = self._page.drawing.model_root(record.name)
                if drawn is not None:
                    frames = {name: drawn.links[row].name for name, row in record.links.items() if row in drawn.links}
                    made += draw(record, frames)
        self._nodes[kind] = made

    # ------------------------------------------------------------------------------------------ kinds

    def _collisions(self, record: ModelRecord, frames: dict[str, str]) -> list[Any]:
        made = []
        for link in record.description.links:
            for number, collision in enumerate(link.collisions):
                if isinstance(collision.geometry, d.Plane):  # it has no end
                    continue
                visual = d.Visual(collision.name, collision.pose, collision.geometry)
                scoped = f"{record.name}::{link.name}::{collision.name}"
                for part_number, part in enumerate(self._assets.parts(visual, scoped)):
                    mesh = self._assets.meshes[part.key]
                    made.append(
                        self._scene.add_mesh_simple(
                            f"{frames[link.name]}/c{number}_{part_number}",
                            np.asarray(mesh.vertices, np.float32),
                            np.asarray(mesh.triangles, np.uint32),
                            color=_ORANGE,
                            opacity=0.45,
                            side="double",
                            scale=tuple(float(s) for s in part.scale),
                            position=part.pose.p,
                            wxyz=wxyz(part.pose.q),
                            cast_shadow=False,
                            receive_shadow=False,
                        )
                    )
        self._assets.problems.clear()  # said already when the world was loaded
        return made

    def _centres_of_mass(self, record: ModelRecord, frames: dict[str, str]) -> list[Any]:
        made = []
        for link in record.description.links if not record.static else ():
            radius = min(0.15, max(0.01, 0.5 * (3 * max(link.inertial.mass, 0.0) / (4 * math.pi * 11340.0)) ** (1 / 3)))
            made.append(
                self._scene.add_icosphere(  # of lead, as Gazebo sizes it
                    f"{frames[link.name]}/com", radius=radius, color=_PINK, position=link.inertial.pose.p, cast_shadow=False
                )
            )
            made.append(
                self._scene.add_frame(
                    f"{frames[link.name]}/com_axes",
                    axes_length=2.5 * radius,
                    axes_radius=0.12 * radius,
                    position=link.inertial.pose.p,
                    wxyz=wxyz(link.inertial.pose.q),
                )
            )
        return made

    def _inertias(self, record: ModelRecord, frames: dict[str, str]) -> list[Any]:
        made = []
        for link in record.description.links if not record.static else ():
            box = inertia_box(link.inertial)
            if box is not None:
                pose, size = box
                made.append(
                    self._scene.add_box(
                        f"{frames[link.name]}/inertia",
                        dimensions=size,
                        color=_PINK,
                        opacity=0.4,
                        position=pose.p,
                        wxyz=wxyz(pose.q),
                        cast_shadow=False,
                    )
                )
        return made

    def _joints(self, record: ModelRecord, frames: dict[str, str]) -> list[Any]:
        made = []
        size = 0.12
        for number, joint in enumerate(record.description.joints):
            if joint.child not in frames:
                continue
            node = f"{frames[joint.child]}/j{number}"
            made.append(
                self._scene.add_frame(node, axes_length=size, axes_radius=size / 25, position=joint.pose.p, wxyz=wxyz(joint.pose.q))
            )
            for which, axis in enumerate(joint.axes):
                tip = tuple(1.6 * size * v for v in axis.xyz)
                made.append(
                    self._scene.add_arrows(
                        f"{node}/axis{which}",
                        points=np.array([[(0.0, 0.0, 0.0), tip]], np.float32),
                        colors=_AXES[which],
                        shaft_radius=size / 18,
                        head_radius=size / 8,
                        head_length=size / 4,
                    )
                )
        return made

    def _link_frames(self, record: ModelRecord, frames: dict[str, str]) -> list[Any]:
        return [self._scene.add_frame(f"{frame}/axes", axes_length=0.15, axes_radius=0.005) for frame in frames.values()]

    def _labels(self, record: ModelRecord, frames: dict[str, str]) -> list[Any]:
        many = len(frames) > 1
        return [
            self._scene.add_label(f"{frame}/label", f"{record.name}::{name}" if many else record.name) for name, frame in frames.items()
        ]


def inertia_box(inertial: d.Inertial) -> tuple[Pose, tuple[float, float, float]] | None:
    """Pose X_LB and size, m, of the box of even density that has this ``inertial``; None where no box has it."""
    i = inertial
    tensor = np.array([[i.ixx, i.ixy, i.ixz], [i.ixy, i.iyy, i.iyz], [i.ixz, i.iyz, i.izz]])
    if not (np.isfinite(tensor).all() and i.mass > 0.0):
        return None
    moments, axes = np.linalg.eigh(tensor)
    squares = 6.0 / i.mass * (moments.sum() - 2.0 * moments)
    if (squares <= 0.0).any() or (squares > 1e6).any():
        return None
    if np.linalg.det(axes) < 0.0:
        axes[:, 0] = -axes[:, 0]
    turned = compose(inertial.pose, Pose(q=quat_from_matrix([row.tolist() for row in axes])))
    return turned, vec3(np.sqrt(squares))
