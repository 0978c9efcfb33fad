"""The model in the page: its links, to be clicked and moved by a gizmo, and its joints."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from ode_sim.description import model as d
from ode_sim_rendering.assets import Assets
from ode_sim_viewer.drawing import rgb255, take_away, wxyz

_PICKED = (255, 170, 0)
_AXIS = 0.3  # m


@dataclass(frozen=True)
class _Drawn:
    """``nodes``: that of the link's frame, those below it. ``painted``: what is seen of it, and its colour."""

    link: d.Link
    nodes: list[Any]
    painted: list[tuple[Any, tuple[int, int, int]]]

    def pick(self, on: bool) -> None:
        self.nodes[0].show_axes = on
        for node, colour in self.painted:
            node.color = _PICKED if on else colour


class ModelSketch:
    """Drawing thread. ``on_click(event, link)``; ``on_move(event, link, position, wxyz, phase)`` of the gizmo."""

    def __init__(self, scene: Any, on_click: Callable, on_move: Callable):
        self._scene = scene
        self._on_click = on_click
        self._assets = Assets()
        self._links: dict[str, _Drawn] = {}
        self._joints: list[Any] = []
        self._serial = 0
        self._picked = ""
        self._gizmo = scene.add_transform_controls("/model_gizmo", scale=0.5, visible=False, depth_test=False)

        async def moved(event: Any) -> None:
            on_move(event, self._picked, tuple(map(float, event.target.position)), tuple(map(float, event.target.wxyz)))

        self._gizmo.on_update(moved)
        self._grid = scene.add_grid(
            "/model_grid",
            width=10.0,
            height=10.0,
            cell_size=0.25,
            section_size=1.0,
            cell_color=(205, 212, 224),
            section_color=(160, 172, 190),
            shadow_opacity=0.0,
        )

    def close(self) -> None:
        self.show(d.Model(""), "")
        for node in (self._gizmo, self._grid):
            take_away(node)

    def place(self, link: str, pose: d.Pose) -> None:
        """Put the ``link`` at ``pose``, X_ML, while a hand moves it."""
        if link in self._links:
            node = self._links[link].nodes[0]
            node.position, node.wxyz = pose.p, wxyz(pose.q)

    def show(self, model: d.Model, picked: str, movable: bool = True) -> None:
        """What has changed of ``model`` since the last call.

        :param picked: name of the link that is marked; '' for none
        :param movable: by the gizmo; it would be in the way of a click on the link.
        """
        wanted = {link.name: link for link in model.links}
        for name in [name for name, drawn in self._links.items() if wanted.get(name) != drawn.link]:
            for node in reversed(self._links.pop(name).nodes):
                take_away(node)
        for name, link in wanted.items():
            if name not in self._links:
                self._links[name] = self._draw(link)
        for name in {picked, self._picked} & set(self._links):  # drawn anew they would miss the next click
            self._links[name].pick(name == picked)
        self._show_joints(model)
        self._picked = picked
        self._gizmo.visible = movable and picked in wanted
        if picked in wanted:
            pose = wanted[picked].pose
            self._gizmo.position, self._gizmo.wxyz = pose.p, wxyz(pose.q)

    def _draw(self, link: d.Link) -> _Drawn:
        self._serial += 1
        root = self._scene.add_frame(
            f"/model/{self._serial}", show_axes=False, axes_length=_AXIS, axes_radius=0.006, position=link.pose.p, wxyz=wxyz(link.pose.q)
        )
        drawn = _Drawn(link, [root], [])
        for number, visual in enumerate(link.visuals):
            for part_number, part in enumerate(self._assets.parts(visual, link.name)):
                mesh, colour = self._assets.meshes[part.key], rgb255(part.look.diffuse)
                node = self._scene.add_mesh_simple(
                    f"{root.name}/{number}_{part_number}",
                    np.asarray(mesh.vertices, np.float32),
                    np.asarray(mesh.triangles, np.uint32),
                    side="double",
                    position=part.pose.p,
                    wxyz=wxyz(part.pose.q),
                    color=colour,
                    scale=tuple(map(float, part.scale)),
                    opacity=part.look.alpha if part.look.alpha < 0.995 else None,
                )
                node.on_click(lambda event, name=link.name: self._on_click(event, name))
                drawn.nodes.append(node)
                drawn.painted.append((node, colour))
        drawn.nodes.append(self._scene.add_label(f"{root.name}/name", link.name))
        return drawn

    def _show_joints(self, model: d.Model) -> None:
        for node in self._joints:
            take_away(node)
        self._joints = []
        poses = {link.name: link.pose for link in model.links}
        lines = [(poses[joint.parent].p, poses[joint.child].p) for joint in model.joints if joint.parent in poses and joint.child in poses]
        if lines:
            self._joints.append(
                self._scene.add_line_segments("/model_joints", np.array(lines, np.float32), colors=(40, 40, 40), thickness=0.01)
            )
        for number, joint in enumerate(model.joints):
            if joint.child in self._links and joint.axes:
                node = self._links[joint.child].nodes[0].name
                begin = np.asarray(joint.pose.p)
                tips = np.array([(begin, begin + 1.5 * _AXIS * np.asarray(axis.xyz)) for axis in joint.axes])
                self._joints.append(
                    self._scene.add_arrows(
                        f"{node}/joint{number}",
                        tips.astype(np.float32),
                        (230, 60, 30),
                        shaft_radius=0.012,
                        head_radius=0.03,
                        head_length=0.07,
                    )
                )
