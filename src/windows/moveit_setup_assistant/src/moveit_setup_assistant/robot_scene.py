"""A robot's shapes for drawing: one row of poses per link, highlighted links in a colour of their own."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Iterable
from dataclasses import replace

import lenient_xml
import numpy as np
from motion.files import resolve
from ode_sim.description import model as d
from ode_sim.math3 import from_rpy
from ode_sim_rendering.scene import WORLD_FRAME, SceneDescription, SceneLight, SceneVisual

from moveit_setup_assistant.robot_source import Robot

Colour = tuple[float, float, float, float]  # red, green, blue, alpha, 0 to 1
HIGHLIGHT = (0.9, 0.1, 0.1, 1.0)
_PLAIN = (0.6, 0.6, 0.65, 1.0)


class RobotScene:
    """What :class:`ode_sim_rendering.Renderer` draws of a robot; links keep the order of ``links``.

    :param visual, collision: which of the links' shapes are drawn.
    """

    def __init__(self, robot: Robot, visual: bool = True, collision: bool = False) -> None:
        root = lenient_xml.fromstring(robot.urdf)
        colours = {m.get("name"): _colour(m) for m in root.findall("material")}
        self.links: tuple[str, ...] = tuple(robot.model.links)
        self._visuals: list[SceneVisual] = []
        for element in root.findall("link"):
            name = element.get("name")
            if name in self.links:
                row = self.links.index(name)
                # a link that shows nothing shows what it collides with
                tags = ["visual" if element.find("visual") is not None else "collision"] * visual
                tags += ["collision"] * (collision and "collision" not in tags)
                self._visuals += [seen for tag in tags for seen in _shapes_of(element, tag, row, colours)]
        sun = d.Light("sun", "directional", direction=(-0.4, 0.3, -0.9), diffuse=(0.7, 0.7, 0.7, 1.0))
        self._lights = (SceneLight(WORLD_FRAME, sun),)
        self._background = d.Scene(ambient=(0.5, 0.5, 0.5, 1.0), background=(0.94, 0.95, 0.97, 1.0))

    def description(self, highlighted: Iterable[str] = ()) -> SceneDescription:
        """The scene with the links of these names in :data:`HIGHLIGHT`."""
        rows = {self.links.index(name) for name in highlighted if name in self.links}
        red = d.Material(ambient=HIGHLIGHT, diffuse=HIGHLIGHT)
        visuals = tuple(replace(seen, visual=replace(seen.visual, material=red)) if seen.link in rows else seen for seen in self._visuals)
        return SceneDescription(self.links, visuals, self._lights, self._background)

    def poses(self, state) -> np.ndarray:
        """(L, 7) x y z qx qy qz qw of the links in a ``motion`` state, model frame, m."""
        found = state.poses(list(self.links))
        return np.array([[*found[name].position, *found[name].quaternion] for name in self.links])


def _shapes_of(link: ET.Element, tag: str, row: int, colours: dict[str | None, Colour | None]) -> Iterable[SceneVisual]:
    """The link's shapes below ``tag``, visual or collision."""
    for index, element in enumerate(link.findall(tag)):
        shape = _shape(element.find("geometry"))
        if shape is None:
            continue
        material = element.find("material")
        colour = None
        if material is not None:
            colour = _colour(material) or colours.get(material.get("name"))
        if colour is None and not isinstance(shape, d.Mesh):
            colour = _PLAIN
        look = d.Material(ambient=colour, diffuse=colour) if colour else None
        name = f"{link.get('name')}::{tag}_{index}"
        yield SceneVisual(row, f"robot::{name}", d.Visual(name, _origin(element), shape, look))


def _numbers(text: str | None, default: tuple[float, ...]) -> tuple[float, ...]:
    try:
        values = tuple(float(word) for word in (text or "").split())
    except ValueError:
        return default
    return values if len(values) == len(default) and np.isfinite(values).all() else default


def _origin(element: ET.Element) -> d.Pose:
    origin = element.find("origin")
    if origin is None:
        return d.Pose()
    return from_rpy(*_vector(origin.get("xyz"), 0.0), *_vector(origin.get("rpy"), 0.0))


def _colour(material: ET.Element) -> Colour | None:
    colour = material.find("color")
    if colour is None:
        return None
    red, green, blue, alpha = _numbers(colour.get("rgba"), _PLAIN)
    return red, green, blue, alpha


def _vector(text: str | None, default: float) -> d.Vec3:
    x, y, z = _numbers(text, (default,) * 3)
    return x, y, z


def _shape(geometry: ET.Element | None):
    for element in geometry if geometry is not None else ():
        if element.tag == "box":
            return d.Box(_vector(element.get("size"), 0.1))
        if element.tag == "sphere":
            return d.Sphere(_numbers(element.get("radius"), (0.05,))[0])
        if element.tag == "cylinder":
            return d.Cylinder(_numbers(element.get("radius"), (0.05,))[0], _numbers(element.get("length"), (0.1,))[0])
        if element.tag == "mesh":
            uri = element.get("filename") or ""
            path = resolve(uri)
            return d.Mesh(path, uri, _vector(element.get("scale"), 1.0)) if path else None
    return None
