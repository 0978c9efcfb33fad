"""The ``<scale>`` that a saved world gives a model which was stretched in the simulator's window.

Gazebo saves such a model with the sizes it had before, and how it was stretched in ``<state>``. Shapes are stretched
about their own frames; poses and masses stay.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import TypeVar

from ode_sim.description.model import Box, Capsule, Collision, Cylinder, Geometry, Mesh, Model, Plane, Sphere, Vec3, Visual

Part = TypeVar("Part", Collision, Visual)


def _times(a: Vec3, b: Vec3) -> Vec3:
    return (a[0] * b[0], a[1] * b[1], a[2] * b[2])


def scaled_geometry(shape: Geometry, scale: Vec3) -> Geometry:
    """``shape`` stretched along its axes by ``scale``, three factors; what is round stays so, as wide as the larger factor makes it."""
    x, y, z = scale
    if isinstance(shape, Box):
        return Box(_times(shape.size, scale))
    if isinstance(shape, Sphere):
        return Sphere(shape.radius * max(scale))
    if isinstance(shape, (Cylinder, Capsule)):
        return replace(shape, radius=shape.radius * max(x, y), length=shape.length * z)
    if isinstance(shape, Plane):
        return replace(shape, size=(shape.size[0] * x, shape.size[1] * y))
    if isinstance(shape, Mesh):
        return replace(shape, scale=_times(shape.scale, scale))
    return shape  # terrains and polylines keep their size, as in Gazebo


def largest_size(model: Model) -> float:
    """Of all shapes of ``model``, m; a mesh counts by its scale."""

    def sizes(shape: Geometry) -> Iterator[float]:
        for name in ("size", "radius", "length", "scale"):
            value = getattr(shape, name, 0.0)
            yield from map(abs, value) if isinstance(value, tuple) else (value,)

    return max((size for link in model.links for part in link.collisions + link.visuals for size in sizes(part.geometry)), default=0.0)


def scaled_model(model: Model, scale: Vec3) -> Model:
    """``model`` with everything that is drawn or collides stretched by ``scale`` (x, y, z)."""

    def stretch(part: Part) -> Part:
        return replace(part, geometry=scaled_geometry(part.geometry, scale))

    return replace(
        model,
        links=tuple(
            replace(link, collisions=tuple(map(stretch, link.collisions)), visuals=tuple(map(stretch, link.visuals)))
            for link in model.links
        ),
    )
