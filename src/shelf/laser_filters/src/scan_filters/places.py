"""Filters that look at where points lie in some frame of tf."""

from __future__ import annotations

import math

import numpy as np

from .base import Filter, FilterError, Scan, Setting, number


class _PlaceFilter(Filter):
    """Hides the points for which ``inside`` holds, or all others."""

    frame = ""

    def inside(self, points: np.ndarray) -> np.ndarray:
        """(N,) of points (N, 3) in ``frame``; what is NaN is not inside."""
        raise NotImplementedError

    def _moved(self, points: np.ndarray, to: str, whence: str, stamp: float) -> np.ndarray:
        assert self.transform is not None  # only a chain without tf, for scans in the frames of its filters, has none
        return self.transform(points, to, whence, stamp)

    def apply(self, scan: Scan) -> None:
        points = scan.points()
        if self.frame != scan.frame:
            points = self._moved(points, self.frame, scan.frame, scan.stamp)
        with np.errstate(invalid="ignore"):
            inside = self.inside(points)
        hidden = ~inside & ~np.isnan(points[:, 0]) if self.values.get("invert") else inside
        scan.ranges[hidden] = np.nan


class BoxFilter(_PlaceFilter):
    """Points in a box."""

    settings = (
        Setting("box_frame", str, "base_link"),
        *(Setting(f"{end}_{axis}", float, value, -100.0, 100.0) for end, value in (("min", -1.0), ("max", 1.0)) for axis in "xyz"),
        Setting("invert", bool, False),
    )

    def prepare(self, given) -> None:
        self.frame = self.values["box_frame"]
        self._low, self._high = ([self.values[f"{end}_{axis}"] for axis in "xyz"] for end in ("min", "max"))

    def inside(self, points):
        return ((points > self._low) & (points < self._high)).all(axis=1)


class FootprintFilter(_PlaceFilter):
    """Points over a square round base_link."""

    settings = (Setting("inscribed_radius", float, live=False),)
    frame = "base_link"

    def inside(self, points):
        return (np.abs(points[:, :2]) <= self.values["inscribed_radius"]).all(axis=1)


class PolygonFilter(_PlaceFilter):
    """Points over a polygon, given as [[x, y], ...]."""

    remembers = False
    settings = (
        Setting("polygon_frame", str, live=False),
        Setting("polygon", object),
        Setting("polygon_padding", float, 0.0, 0.0, 100.0),
        Setting("invert", bool, False),
    )

    def prepare(self, given) -> None:
        self.frame = self.values["polygon_frame"]
        corners = self.values["polygon"]
        if not isinstance(corners, list) or len(corners) in (1, 2) or not all(isinstance(c, list) and len(c) == 2 for c in corners):
            raise FilterError(f"filter '{self.name}': polygon has to be a list of at least three [x, y], not {corners!r}")
        corners = np.array([[number(x, "a corner of the polygon") for x in corner] for corner in corners]).reshape(-1, 2)
        self.corners = corners + np.sign(corners) * self.values["polygon_padding"]

    def inside(self, points):
        x, y = points[:, 0], points[:, 1]
        within = np.zeros(len(points), bool)
        for (ax, ay), (bx, by) in zip(self.corners, np.roll(self.corners, 1, axis=0)):
            if ay != by:
                within ^= ((ay > y) != (by > y)) & (x < (bx - ax) * (y - ay) / (by - ay) + ax)
        return within & ~np.isnan(x)


class StaticPolygonFilter(PolygonFilter):
    """The same, where the sensor never moves against the polygon's frame: the transform is asked for once."""

    def prepare(self, given) -> None:
        super().prepare(given)
        self._placed = False

    def apply(self, scan: Scan) -> None:
        if not self._placed:
            flat = np.column_stack((self.corners, np.zeros(len(self.corners))))
            if self.frame != scan.frame:
                flat = self._moved(flat, scan.frame, self.frame, math.nan)
            self.corners, self._placed = flat[:, :2], True
        with np.errstate(invalid="ignore"):
            points = scan.points()
            inside = self.inside(points)
        scan.ranges[inside != self.values["invert"]] = np.nan
