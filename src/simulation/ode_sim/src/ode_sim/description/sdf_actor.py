"""``<actor>`` of SDF: a model whose links are the bones of a skin, moved by a script."""

from __future__ import annotations

import os
import xml.etree.ElementTree as ET
from dataclasses import replace

import numpy as np

from ode_sim import math3
from ode_sim.description.model import (
    Actor,
    ActorAnimation,
    ActorScript,
    Box,
    Collision,
    DescriptionError,
    Inertial,
    Link,
    Mesh,
    Model,
    Pose,
    Surface,
    Trajectory,
    Visual,
    Waypoint,
    quoted,
)
from ode_sim.description.sdf_model import SdfModels
from ode_sim.description.xmlsource import source_of, text_of

_LONGEST_SCRIPT = 1e6  # s
_MOST_WAYPOINTS = 100_000
_LARGEST_SCALE = 1e6
_THICK = 0.02  # m, of the boxes that a plugin may let collide
_MOMENT = 2.0 * 1.0 * 0.01**2 / 5.0  # kg m^2, of the ball that is a bone to physics
_BONE = Inertial(1.0, Pose(), ixx=_MOMENT, iyy=_MOMENT, izz=_MOMENT)
_TOUCHES_NOTHING = Surface(collide_bitmask=0)


class SdfActors(SdfModels):
    """Reads ``<actor>``. What of it cannot be had is left out with a line, as in Gazebo: it walks without skin, or stands."""

    def model(self, element: ET.Element) -> Model:
        """The model of ``element``, a ``<model>`` or an ``<actor>``."""
        return self.actor(element) if element.tag == "actor" else super().model(element)

    def actor(self, element: ET.Element) -> Model:
        """The model of ``element``, an ``<actor>``: its links are the bones."""
        parts = self._parts(element)
        name = parts.name
        skin, scale = self._skin(element, name)
        animations = self._animations(element, skin, name)
        script = self._script(element)
        links = [Link(f"{name}_pose", inertial=_BONE, gravity=False, source=source_of(element))]
        if skin:
            played = next((trajectory.type for trajectory in script.trajectories), "")
            bent_by = next((one.path for one in animations if one.name == played), animations[0].path if animations else "")
            links += self._bones(element, skin, scale, bent_by)
        taken = {link.name for link in links}
        links += [
            replace(
                link,
                gravity=False,
                collisions=tuple(replace(shape, surface=replace(shape.surface, collide_bitmask=0)) for shape in link.collisions),
            )
            for link in parts.links
            if link.name not in taken
        ]
        return Model(
            name=name,
            pose=parts.pose,
            links=tuple(links),
            plugins=tuple(parts.plugins),
            static=True,
            actor=Actor(skin, scale, animations, script, element),
            source=source_of(element),
        )

    # ------------------------------------------------------------------ skin

    def _skin(self, element: ET.Element, name: str) -> tuple[str, float]:
        """The file, '' if there is none that can be used, and what it is multiplied by."""
        from ode_sim.actors.skeleton import load_skeleton

        skin = element.find("skin")
        if skin is None:
            return "", 1.0
        path = self._actor_file(skin, f"actor '{quoted(name)}' has no skin")
        if path:
            try:
                load_skeleton(path)
            except DescriptionError as error:
                self.warn(skin, f"actor '{quoted(name)}' has no skin: {error}")
                path = ""
        return path, self._scale(skin)

    def _actor_file(self, element: ET.Element, consequence: str) -> str:
        uri = text_of(element.find("filename"))
        found = self.finder.find(uri, os.path.dirname(getattr(element, "file", "")) or self.base) if uri else None
        if found and os.path.isfile(found):
            return found
        self.warn_missing(element, uri, consequence)
        return ""

    def _scale(self, element: ET.Element) -> float:
        scale = self.number(element, "scale", 1.0, most=_LARGEST_SCALE)
        if scale > 0.0:
            return scale
        self.warn(element.find("scale"), f"scale {scale:g} must be positive; using 1")
        return 1.0

    def _bones(self, element: ET.Element, path: str, scale: float, bent_by: str) -> list[Link]:
        """A link for each bone, where it is at rest as seen from the root."""
        from ode_sim.actors.quaternions import from_matrices
        from ode_sim.actors.skeleton import load_skeleton
        from ode_sim.actors.skin import load_pieces, piece_name

        skeleton, skin = load_skeleton(path), element.find("skin")
        source = source_of(element if skin is None else skin)
        try:
            pieces = load_pieces(path, bent_by)
        except DescriptionError as error:
            self.warn(skin, f"actor '{quoted(element.get('name'))}' is not drawn: {error}")
            pieces = {}
        frames = skeleton.model_frames()
        turned = [_quat(q) for q in from_matrices(frames[:, :3, :3])]
        root = Pose(math3.vec3(frames[0, :3, 3]), turned[0])
        links, names = [], set()
        for index, bone in enumerate(skeleton.bones):
            if bone.name in names:
                continue
            names.add(bone.name)
            pose = math3.relative(root, Pose(math3.vec3(frames[index, :3, 3]), turned[index]))
            visuals: tuple[Visual, ...] = ()
            shapes: list[Collision] = []
            if bone.name in pieces:
                uri = text_of(skin.find("filename")) if skin is not None else path
                mesh = Mesh(path, uri, (scale,) * 3, piece_name(bone.name, bent_by))
                visuals = (Visual(f"{bone.name}_skin", Pose(), mesh, source=source),)
                shapes.append(Collision(f"{bone.name}_skin", Pose(), mesh, _TOUCHES_NOTHING, source=source))
            for child in skeleton.children(index):
                shapes += _bone_box(
                    bone.name, skeleton.bones[child].name, frames[index], frames[child], turned[index], skeleton.rest[child, :3, 3] * scale
                )
            links.append(
                Link(bone.name, Pose(math3.scale(pose.p, scale), pose.q), _BONE, tuple(shapes), visuals, gravity=False, source=source)
            )
        return links

    # ------------------------------------------------------------------ animations and script

    def _animations(self, element: ET.Element, skin: str, name: str) -> tuple[ActorAnimation, ...]:
        from ode_sim.actors.animation import animation_for
        from ode_sim.actors.skeleton import load_skeleton

        if not skin:
            return ()
        written = element.findall("animation")
        if not written:
            kind = element.find("script/trajectory")
            name_of_it = (kind.get("type") or "__default__") if kind is not None else "__default__"
            wanted = [(element.find("skin"), name_of_it, skin, 1.0, False)]
        else:
            wanted = [
                (
                    entry,
                    entry.get("name") or "__default__",
                    self._actor_file(entry, f"actor '{quoted(name)}' has no animation '{quoted(entry.get('name'))}'"),
                    self._scale(entry),
                    self.boolean(entry, "interpolate_x", False),
                )
                for entry in written
            ]
        found: dict[str, ActorAnimation] = {}
        skeleton = load_skeleton(skin)
        for entry, called, path, scale, along in wanted:
            if not path:
                continue
            try:
                animation_for(path, skeleton)
                found[called] = ActorAnimation(called, path, scale, along)
            except DescriptionError as error:
                if written:
                    self.warn(entry, f"actor '{quoted(name)}' has no animation '{quoted(called)}': {error}")
        return tuple(found.values())

    def _script(self, element: ET.Element) -> ActorScript:
        script = element.find("script")
        if script is None:
            return ActorScript()
        return ActorScript(
            loop=self.boolean(script, "loop", True),
            delay_start=self.between(script, "delay_start", 0.0, 0.0, _LONGEST_SCRIPT),
            auto_start=self.boolean(script, "auto_start", True),
            trajectories=tuple(self._trajectory(entry) for entry in script.findall("trajectory")),
        )

    def _trajectory(self, entry: ET.Element) -> Trajectory:
        try:
            number = int((entry.get("id") or "0").strip())
        except ValueError:
            number = 0
            self.warn(entry, f"id '{quoted(entry.get('id'))}' is no whole number; using 0")
        try:
            tension = min(max(float(entry.get("tension") or 0.0), 0.0), 1.0)
        except ValueError:
            tension = 0.0
            self.warn(entry, f"tension '{quoted(entry.get('tension'))}' is no number; using 0")
        points = entry.findall("waypoint")
        if len(points) > _MOST_WAYPOINTS:
            self.warn(entry, f"has {len(points)} waypoints; the first {_MOST_WAYPOINTS} are used")
        return Trajectory(
            number,
            entry.get("type") or "__default__",
            tuple(
                Waypoint(self.between(point, "time", 0.0, 0.0, _LONGEST_SCRIPT), self.pose(point.find("pose")))
                for point in points[:_MOST_WAYPOINTS]
            ),
            0.0 if np.isnan(tension) else tension,
        )


def _quat(values: np.ndarray) -> math3.Quat:
    x, y, z, w = map(float, values)
    return x, y, z, w


def _bone_box(
    bone: str, child: str, frame: np.ndarray, child_frame: np.ndarray, turned: math3.Quat, between: np.ndarray
) -> list[Collision]:
    """Between two bones, as upstream has it: how it is turned about its own length shows when a plugin makes it thicker."""
    way = child_frame[:3, 3] - frame[:3, 3]
    length = float(np.linalg.norm(way))
    size = float(np.linalg.norm(between))
    if length < 1e-6 or size < 1e-6:
        return []
    upright = math3.quat_from_rpy(0.0, float(np.arccos(np.clip(way[2] / length, -1.0, 1.0))), float(np.arctan2(way[1], way[0])))
    pose = Pose(math3.vec3(0.5 * between), math3.quat_multiply(math3.quat_inverse(turned), upright))
    return [Collision(f"{bone}_{child}_collision", pose, Box((_THICK, _THICK, size)), _TOUCHES_NOTHING)]
