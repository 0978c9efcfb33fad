"""Polylines: an outline extruded along z to a closed surface."""

from __future__ import annotations

import numpy as np

from ode_sim.description.model import DescriptionError, Polyline

Point = tuple[float, ...]  # x, y


def extrude(polyline: Polyline) -> tuple[np.ndarray, np.ndarray]:
    """Vertices (V, 3) m and triangles (T, 3) of the solid between z = 0 and ``height`` that ``polyline`` is.

    :raises DescriptionError: fewer than three corners, or an outline that crosses itself.
    """
    outline = [tuple(map(float, p)) for p in polyline.points]
    if len(outline) > 1 and outline[0] == outline[-1]:
        outline.pop()
    if len(outline) < 3:
        raise DescriptionError("a polyline needs at least three points")
    if _area(outline) < 0.0:
        outline.reverse()
    n = len(outline)
    lid = _triangulate(outline)
    vertices = np.array([(x, y, 0.0) for x, y in outline] + [(x, y, polyline.height) for x, y in outline])
    triangles = [(a, c, b) for a, b, c in lid] + [(a + n, b + n, c + n) for a, b, c in lid]
    for i in range(n):
        j = (i + 1) % n
        triangles += [(i, j, j + n), (i, j + n, i + n)]
    return vertices, np.array(triangles, dtype=np.int32)


def _area(points: list[Point]) -> float:
    return 0.5 * sum(x0 * y1 - x1 * y0 for (x0, y0), (x1, y1) in zip(points, points[1:] + points[:1]))


def _cross(o: Point, a: Point, b: Point) -> float:
    return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0])


def _triangulate(points: list[Point]) -> list[tuple[int, int, int]]:
    """Ear clipping of a counter-clockwise outline."""
    left, triangles = list(range(len(points))), []
    while len(left) > 3:
        for k, b in enumerate(left):
            a, c = left[k - 1], left[(k + 1) % len(left)]
            if _cross(points[a], points[b], points[c]) <= 0.0:
                continue
            others = (points[i] for i in left if i not in (a, b, c))
            if any(
                _cross(points[a], points[b], p) >= 0.0 and _cross(points[b], points[c], p) >= 0.0 and _cross(points[c], points[a], p) >= 0.0
                for p in others
            ):
                continue
            triangles.append((a, b, c))
            left.pop(k)
            break
        else:
            raise DescriptionError("the outline of a polyline crosses itself")
    return triangles + [(left[0], left[1], left[2])]
