"""Boxes, turned parts and convex hulls."""

import numpy as np
import trimesh

_TURN_FROM_Z = {"x": [0, 1, 0], "y": [-1, 0, 0]}  # axis of the quarter turn that takes z to the named axis


def _along(mesh, axis, centre):
    """Turns a mesh made along z to `axis` and moves its origin to `centre`, (3,)."""
    if axis in _TURN_FROM_Z:
        mesh.apply_transform(trimesh.transformations.rotation_matrix(np.pi / 2, _TURN_FROM_Z[axis]))
    mesh.apply_translation(centre)
    return mesh


def _middle(axis, start, end, centre):
    point = np.array(centre, dtype=float)
    point["xyz".index(axis)] = (start + end) / 2
    return point


def box(low, high):
    """A box from corner `low` to corner `high`, (3,) each."""
    return trimesh.creation.box(bounds=[low, high])


def rod(axis, radius, start, end, centre=(0, 0, 0), sections=32):
    """A cylinder of `radius` along `axis` from coordinate `start` to `end`; `centre` (3,) gives the other two coordinates.

    :param sections: of the circle.
    """
    mesh = trimesh.creation.cylinder(radius, end - start, sections=sections)
    return _along(mesh, axis, _middle(axis, start, end, centre))


def ring(axis, inner, outer, start, end, centre=(0, 0, 0), sections=32):
    """A hollow cylinder from radius `inner` to `outer`; `axis`, `start`, `end`, `centre`, `sections` as for `rod`."""
    mesh = trimesh.creation.annulus(inner, outer, end - start, sections=sections)
    return _along(mesh, axis, _middle(axis, start, end, centre))


def turned(axis, profile, centre=(0, 0, 0), sections=32):
    """A part turned on a lathe.

    :param profile: (N, 2) points (coordinate along `axis`, radius), along the axis; both ends are closed.
    :param centre: (3,) origin of the profile.
    :param sections: of the circle.
    """
    outline = [(radius, along) for along, radius in profile]
    outline = [(0, profile[0][0]), *outline, (0, profile[-1][0])]
    mesh = trimesh.creation.revolve(np.array(outline, dtype=float), sections=sections)
    return _along(mesh, axis, centre)


def hull(*parts):
    """The convex hull of several parts: plates with round ends, tapering bodies."""
    return trimesh.convex.convex_hull(np.vstack([part.vertices for part in parts]))


def mirrored(part, axis):
    """The part and its mirror image in the plane through the origin normal to `axis`, as a list."""
    scale = np.ones(3)
    scale["xyz".index(axis)] = -1
    twin = part.copy()
    twin.apply_transform(np.diag([*scale, 1.0]))
    return [part, twin]
