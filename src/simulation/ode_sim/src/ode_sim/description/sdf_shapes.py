"""Shapes, looks and lights of SDF."""

from __future__ import annotations

import math
import os
import xml.etree.ElementTree as ET
from dataclasses import replace
from typing import Any

from ode_sim import math3
from ode_sim.description import materials
from ode_sim.description.model import (
    FARTHEST,
    Box,
    Capsule,
    Cylinder,
    Geometry,
    GroundLayer,
    Heightmap,
    Light,
    Material,
    Mesh,
    Plane,
    Polyline,
    Pose,
    Ribbon,
    Sphere,
    Visual,
    quoted,
)
from ode_sim.description.sdf_values import LONGEST, Numbers, SdfValues
from ode_sim.description.xmlsource import fault, source_of, text_of

_MOST_CORNERS = 1000  # of a polyline; to cut one into triangles takes a time that grows with the square of their number
_MOST_POINTS = 100_000  # of a road
_MOST_LAYERS = 8  # of pictures on a height map
#: mean colours of Gazebo's own pictures of ground, which are not Debian's
_GROUNDS = {
    "dirt_diffusespecular.png": (0.56, 0.47, 0.38),
    "grass_diffusespecular.png": (0.48, 0.56, 0.31),
    "fungus_diffusespecular.png": (0.51, 0.51, 0.41),
}
_ABOVE_GROUND = 0.005  # m, so that a road on the ground is seen; files have both at 0
_FAR_LIGHT = 1e16  # of numbers that graphics take, in single precision


class SdfShapes(SdfValues):
    """Reads ``<geometry>``, ``<material>`` and ``<light>``."""

    def geometry(self, parent: ET.Element) -> Geometry:
        """The shape in the ``<geometry>`` of ``parent``; None where there is none, or one that is not known.

        :raises DescriptionError: a size that no shape has.
        """
        element = parent.find("geometry")
        shape = next((child for child in element if child.tag != "empty"), None) if element is not None else None
        if shape is None:
            return None
        if shape.tag == "box":
            return Box(self._sizes(shape, self.vector(shape, "size", (1.0, 1.0, 1.0))))
        if shape.tag == "sphere":
            return Sphere(*self._sizes(shape, (self.number(shape, "radius", 1.0),)))
        if shape.tag in ("cylinder", "capsule"):
            kind = Cylinder if shape.tag == "cylinder" else Capsule
            return kind(*self._sizes(shape, (self.number(shape, "radius", 1.0), self.number(shape, "length", 1.0))))
        if shape.tag == "plane":
            normal = math3.unit(self.vector(shape, "normal", (0.0, 0.0, 1.0), most=LONGEST))
            return Plane(normal if any(normal) else (0.0, 0.0, 1.0), self.vector(shape, "size", (1.0, 1.0), most=FARTHEST))
        if shape.tag == "mesh":
            return self._mesh(shape)
        if shape.tag == "heightmap":
            uri = text_of(shape.find("uri"))
            x, y, z = self.vector(shape, "size", (1.0, 1.0, 1.0))
            self._sizes(shape, (x, y, abs(z)))
            return Heightmap(
                self._file(shape, uri),
                uri,
                (x, y, z),
                self.vector(shape, "pos", (0.0, 0.0, 0.0), most=FARTHEST),
                self.whole(shape, "sampling", 2, 0, 1000),
                self._ground(shape) if parent.tag == "visual" else (),
            )
        if shape.tag == "polyline":
            return self._polyline(shape)
        self.warn(shape, "this kind of geometry is not known here; left out")
        return None

    def _ground(self, shape: ET.Element) -> tuple[GroundLayer, ...]:
        """The pictures of ``shape``, a ``<heightmap>``: its n-th ``<blend>`` is where the one above the n-th begins."""
        layers: list[GroundLayer] = []
        blends = shape.findall("blend")[: _MOST_LAYERS - 1]
        for number, texture in enumerate(shape.findall("texture")[: len(blends) + 1]):
            uri = text_of(texture.find("diffuse"))
            found = self.finder.find(uri, os.path.dirname(getattr(texture, "file", "")) or self.base) if uri else None
            stock = _GROUNDS.get(os.path.basename(uri))
            if not found and stock is None:
                self.warn_missing(texture, uri, "this ground is white")
            low, fade = (self.number(blends[number - 1], tag, 0.0) for tag in ("min_height", "fade_dist")) if number else (0.0, 0.0)
            layers.append(GroundLayer(found or "", self.number(texture, "size", 10.0), low, max(0.0, fade), stock or (1.0, 1.0, 1.0), uri))
        return tuple(layers)

    @staticmethod
    def _sizes(shape: ET.Element, sizes: Numbers) -> Numbers:
        """``sizes`` (m) if a shape can have them.

        :raises DescriptionError: negative, or larger than :data:`FARTHEST`.
        """
        if not all(0.0 <= size <= FARTHEST for size in sizes):
            raise fault(shape, f"size {' '.join(f'{s:g}' for s in sizes)}; sizes must be positive and finite, and at most {FARTHEST:g} m")
        return sizes

    def _polyline(self, shape: ET.Element) -> Geometry:
        corners = shape.findall("point")
        if len(corners) > _MOST_CORNERS:
            self.warn(shape, f"an outline of {len(corners)} points; it may have {_MOST_CORNERS}, this shape is left out")
            return None
        return Polyline(
            tuple(self.numbers(corner, (0.0, 0.0), most=FARTHEST) for corner in corners),
            *self._sizes(shape, (self.number(shape, "height", 1.0),)),
        )

    def _mesh(self, shape: ET.Element) -> Mesh:
        uri = text_of(shape.find("uri")) or text_of(shape.find("filename"))
        scale = self.vector(shape, "scale", (1.0, 1.0, 1.0), most=FARTHEST)
        return Mesh(
            path=self._file(shape, uri),
            uri=uri,
            scale=scale,
            submesh=text_of(shape.find("submesh/name")),
            center=self.boolean(shape, "submesh/center", False),
        )

    def _file(self, element: ET.Element, uri: str) -> str:
        """Absolute path of a mesh or image, '' with a warning if it is not there."""
        found = self.finder.find(uri, os.path.dirname(getattr(element, "file", "")) or self.base) if uri else None
        if found and os.path.isfile(found):
            return found
        self.warn_missing(element, uri, "this shape is left out")
        return ""

    def material(self, element: ET.Element | None) -> Material | None:
        """The look that ``element``, a ``<material>``, gives; None where it says nothing."""
        if element is None:
            return None
        name = text_of(element.find("script/name"))
        if name == "__default__":  # what Gazebo saves where a visual names no material
            name = ""
        known = materials.gazebo_material(name, self.finder) if name else None
        if name and known is None:
            uris = [text_of(uri) for uri in element.findall("script/uri")]
            places = [self.finder.find(uri, self.base) for uri in uris]
            known = materials.script_material(name, [place for place in places if place]) or materials.resource_material(name, self.finder)
            if known is None and name not in self._missing:
                self._missing.add(name)
                self.warn(
                    element,
                    f"there is no material '{quoted(name)}'" + (f" in {quoted(', '.join(uris), 200)}" if uris else "") + "; using white",
                )
        colours = {tag: self.rgba(element, tag) for tag in ("ambient", "diffuse", "specular", "emissive")}
        given: dict[str, Any] = {tag: colour for tag, colour in colours.items() if colour is not None}
        lit = self.boolean(element, "lighting", True)
        if known is None and not given and lit:
            return Material(name) if name else None
        base = known or Material(name)
        base = base if lit else replace(base, lighting=False)
        return replace(base, shininess=base.shininess if colours["specular"] in (None, base.specular) else 0.0, **given)

    def road(self, element: ET.Element) -> Visual:
        """The road of ``element``, a ``<road>``. :raises DescriptionError: it leads nowhere, or is no road."""
        points = element.findall("point")
        if len(points) > _MOST_POINTS:
            raise fault(element, f"a road of {len(points)} points; it may have {_MOST_POINTS}")
        places = [self.numbers(point, (0.0, 0.0, 0.0), nan=True, most=FARTHEST) for point in points]
        for point, place in zip(points, places):
            if any(math.isnan(value) for value in place):
                raise fault(point, f"'{quoted(text_of(point))}' is not a number")
        way = tuple(place for place, before in zip(places, [None, *places]) if before is None or place[:2] != before[:2])
        if len(way) < 2:
            raise fault(element, "a road needs two points that are not the same")
        (width,) = self._sizes(element, (self.number(element, "width", 1.0),))
        material = self.material(element.find("material")) if element.find("material") is not None else self._road_look()
        return Visual(
            element.get("name") or "road",
            Pose((0.0, 0.0, _ABOVE_GROUND)),
            Ribbon(way, width),
            material,
            cast_shadows=False,
            source=source_of(element),
        )

    def _road_look(self) -> Material | None:
        return materials.gazebo_material("Gazebo/Road", self.finder)

    def light(self, element: ET.Element) -> Light:
        """The light of ``element``, a ``<light>``."""
        default = Light(name="")

        def value(path: str, usual: float) -> float:
            return self.number(element, path, usual, most=_FAR_LIGHT)

        return Light(
            name=element.get("name") or "",
            type=(element.get("type") or "point").strip(),
            pose=self.pose(element.find("pose")),
            diffuse=self.rgba(element, "diffuse", default.diffuse),
            specular=self.rgba(element, "specular", default.specular),
            direction=self.vector(element, "direction", default.direction, most=_FAR_LIGHT),
            range=value("attenuation/range", default.range),
            constant=value("attenuation/constant", default.constant),
            linear=value("attenuation/linear", default.linear),
            quadratic=value("attenuation/quadratic", default.quadratic),
            spot=(value("spot/inner_angle", 0.0), value("spot/outer_angle", 0.0), value("spot/falloff", 0.0)),
            cast_shadows=self.boolean(element, "cast_shadows", False),
            source=source_of(element),
        )
