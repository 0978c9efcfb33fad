"""Points of scans, with what is known of each. No ROS."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .base import Scan

#: Optional columns in their order, and the names of their fields.
FIELDS = {
    "intensity": ("intensity",),
    "index": ("index",),
    "distance": ("distances",),
    "timestamp": ("stamps",),
    "viewpoint": ("vp_x", "vp_y", "vp_z"),
}


@dataclass(frozen=True)
class Pose:
    """Of the sensor in another frame: ``place`` (3,) m, ``turn`` x, y, z, w."""

    place: np.ndarray
    turn: np.ndarray


def slerped(start: np.ndarray, end: np.ndarray, ratios: np.ndarray) -> np.ndarray:
    """(N, 4) rotations between ``start`` and ``end`` (x, y, z, w), at ``ratios`` (N,) of the way."""
    dot = float(start @ end)
    end, dot = (-end, -dot) if dot < 0 else (end, dot)
    angle = np.arccos(min(dot, 1.0))
    if angle < 1e-6:
        mixed = start + ratios[:, None] * (end - start)
    else:
        mixed = (np.sin((1 - ratios) * angle)[:, None] * start + np.sin(ratios * angle)[:, None] * end) / np.sin(angle)
    return mixed / np.linalg.norm(mixed, axis=1, keepdims=True)


def turned(points: np.ndarray, turns: np.ndarray) -> np.ndarray:
    """``points`` (N, 3), each turned by its own of ``turns`` (N, 4)."""
    axis, w = turns[:, :3], turns[:, 3:]
    twice = 2 * np.cross(axis, points)
    return points + w * twice + np.cross(axis, twice)


def columns(scan: Scan, start: Pose, end: Pose, farthest: float, wanted: set[str]) -> np.ndarray:
    """A table of the points of ``scan``: x, y, z in the other frame, and the fields of what is ``wanted``.

    :param start: of the sensor at the first ray. :param end: at the last one; it moves evenly.
    :param farthest: m, from which on nothing was met, if that is less than the scan's range_max. :param wanted: keys of FIELDS.
    """
    limit = min(farthest, scan.range_max) if farthest >= 0 else scan.range_max
    with np.errstate(invalid="ignore"):
        rays = np.flatnonzero((scan.ranges >= scan.range_min) & (scan.ranges < limit))
    away, angle = scan.ranges[rays].astype(float), scan.angles[rays]
    ratios = rays / max(len(scan.ranges) - 1, 1)
    turns = slerped(start.turn, end.turn, ratios)
    places = start.place + ratios[:, None] * (end.place - start.place)
    points = turned(np.column_stack((away * np.cos(angle), away * np.sin(angle), np.zeros(len(rays)))), turns) + places
    names = ["x", "y", "z"] + [name for what, fields in FIELDS.items() if what in wanted for name in fields]
    if not len(scan.intensities):
        names = [name for name in names if name != "intensity"]
    table = np.zeros(len(rays), [(name, "<i4" if name == "index" else "<f4") for name in names])
    values = dict(zip(("x", "y", "z"), points.T), index=rays, distances=away, stamps=rays * scan.time_increment)
    values.update(zip(FIELDS["viewpoint"], places.T))
    lit = rays < len(scan.intensities)
    for name in names:
        if name == "intensity":
            table[name][lit] = scan.intensities[rays[lit]]
        else:
            table[name] = values[name]
    return table
